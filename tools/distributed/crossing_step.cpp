// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles are in the order of their smallest points. A block has those whose smallest point
// it owns. It needs all triangles whose boxes overlap one of its own, before it or behind: for the
// pairs, and for the fans around its corners. The boxes of every so many consecutive triangles, and
// those of every so many of these, tell where they are.
#include "crossing_step.h"

#include "core/parallel.h"
#include "mesh/box_tree.h"
#include "mesh/triangle_order.h"
#include "stored_cloud.h"

#include <xxhash.h>

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
// Triangles. Each block reads the boxes of all groups of them, 0.023 bytes for each point of the
// mesh, the buckets of those near it, and some 5 % more triangles than it has.
constexpr std::size_t BUCKET = 64;

// In a run, at most: before crossing triangles are moved apart, and after.
constexpr std::size_t SEARCHES = 2;

static_assert (sizeof (Triangle) == 3 * sizeof (Index) &&
                   sizeof (CrossingPair) == 2 * sizeof (Index),
               "they are written and read as plain numbers");

std::string
meshFile (std::size_t search)
{
  return blockFile ("crossing_mesh", search);
}

// Tells one mesh from another one.
std::uint64_t
identify (const std::vector<Triangle>& triangles)
{
  return XXH3_64bits (triangles.data (), triangles.size () * sizeof (Triangle));
}

// Places where the triangles of each block begin, and one behind the last.
std::vector<std::uint64_t>
firstPlaces (const std::vector<Triangle>& sorted, const BlockRanges& ranges)
{
  std::vector<std::uint64_t> firsts;
  for (std::size_t block = 0; block < ranges.blocks (); ++block)
    firsts.push_back (static_cast<std::uint64_t> (
        std::partition_point (sorted.begin (), sorted.end (),
                              [&] (const Triangle& triangle) {
                                return *std::min_element (triangle.begin (), triangle.end ()) <
                                       ranges.first (block);
                              }) -
        sorted.begin ()));
  firsts.push_back (sorted.size ());
  return firsts;
}

std::vector<Box>
makeBuckets (const std::vector<Triangle>& sorted, const std::vector<Eigen::Vector3d>& positions,
             const RunContext& run)
{
  std::vector<Box> buckets ((sorted.size () + BUCKET - 1) / BUCKET);
  parallelRanges (run, buckets.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t t = first * BUCKET; t < std::min (last * BUCKET, sorted.size ()); ++t)
      buckets[t / BUCKET].extend (boxOf (sorted[t], positions));
  });
  return buckets;
}

void
writeMesh (Store& store, const std::string& name, const Plan& plan, std::uint64_t mesh,
           const std::vector<Triangle>& sorted, const std::vector<Box>& buckets,
           const BlockRanges& ranges)
{
  const std::vector<std::uint64_t> firsts = firstPlaces (sorted, ranges);
  ArrayWriter writer;
  writer.add ("mesh", &mesh, 1);
  writer.add ("firsts", firsts);
  const std::vector<Box> groups = BlockCutter::makeGroups (buckets);
  addBoxes ("buckets", buckets, writer);
  addBoxes ("groups", groups, writer);
  writer.add ("corners", reinterpret_cast<const Index*> (sorted.data ()), 3 * sorted.size ());
  store.put (name, writer, plan.id);
}

// The triangles of a block, with those around.
struct Part
{
  std::vector<Index> places;       // in the order of the whole mesh, ascending
  std::vector<Index> corners;      // three of each
  std::size_t first = 0, last = 0; // the own ones
};

// Calls visit for all buckets, ascending, whose boxes overlap one of the block.
template <typename Visit>
void
forBucketsAround (ArrayFile& file, std::size_t own_first, std::size_t own_last,
                  const RunContext& run, Visit&& visit)
{
  const std::vector<Box> own_boxes = readBoxes (file, "buckets", own_first, own_last);
  Box all;
  for (const Box& box : own_boxes)
    all.extend (box);
  const BoxTree own (
      own_boxes.size (), [&] (std::size_t i) { return own_boxes[i]; }, run);
  const auto isNear = [&] (const Box& box) {
    bool overlaps = false;
    if (all.intersects (box))
      own.forOverlaps (box, [&overlaps] (std::size_t /*i*/) { overlaps = true; });
    return overlaps;
  };
  const std::size_t count = file.count ("buckets") / BOX;
  const std::vector<Box> groups = readBoxes (file, "groups", 0, file.count ("groups") / BOX);
  for (std::size_t group = 0; group < groups.size (); ++group) {
    const std::size_t first = group * BlockCutter::GROUP;
    const std::size_t last = std::min (first + BlockCutter::GROUP, count);
    if (!(first < own_last && own_first < last) && !isNear (groups[group]))
      continue;
    const std::vector<Box> boxes = readBoxes (file, "buckets", first, last);
    for (std::size_t bucket = first; bucket < last; ++bucket)
      if ((bucket >= own_first && bucket < own_last) || isNear (boxes[bucket - first]))
        visit (bucket);
  }
}

Part
readPart (ArrayFile& file, std::size_t block, const RunContext& run)
{
  const std::vector<std::uint64_t> firsts = file.read<std::uint64_t> ("firsts", block, block + 2);
  const std::size_t own_first = firsts[0], own_last = firsts[1];
  Part part;
  if (own_first == own_last)
    return part;
  const std::size_t count = file.count ("corners") / 3;
  std::size_t begin = 0, end = 0; // triangles of consecutive buckets, to be read at once
  const auto read = [&] {
    const std::size_t before = part.corners.size ();
    part.corners.resize (before + 3 * (end - begin));
    file.read ("corners", 3 * begin, 3 * end, part.corners.data () + before);
    for (std::size_t t = begin; t < end; ++t)
      part.places.push_back (static_cast<Index> (t));
  };
  forBucketsAround (file, own_first / BUCKET, (own_last + BUCKET - 1) / BUCKET, run,
                    [&] (std::size_t bucket) {
                      if (bucket * BUCKET != end) {
                        read ();
                        begin = bucket * BUCKET;
                      }
                      end = std::min ((bucket + 1) * BUCKET, count);
                    });
  read ();
  const auto placeOf = [&part] (std::size_t triangle) {
    return static_cast<std::size_t> (
        std::lower_bound (part.places.begin (), part.places.end (), triangle) -
        part.places.begin ());
  };
  part.first = placeOf (own_first);
  part.last = placeOf (own_last);
  return part;
}

} // namespace

void
crossingStep (const StepContext& context, std::size_t number)
{
  const std::size_t block = number % context.plan.blocks;
  ArrayFile file =
      openArrays (context.store, meshFile (number / context.plan.blocks), context.plan);
  const auto mesh = file.read<std::uint64_t> ("mesh");
  std::vector<CrossingPair> pairs;
  if (Part part = readPart (file, block, context.run); part.first < part.last) {
    OwnBlock own (context, block);
    const std::vector<Index> points = joinPoints (own.first, own.last, {&part.corners});
    const std::vector<Eigen::Vector3d> positions = own.cloud.gather (points);
    LocalPoints (points).toPlaces (part.corners);
    std::vector<Triangle> triangles (part.places.size ());
    for (std::size_t t = 0; t < triangles.size (); ++t)
      triangles[t] = {part.corners[3 * t], part.corners[3 * t + 1], part.corners[3 * t + 2]};
    std::vector<Index> ().swap (part.corners);
    pairs = findSelfIntersectionsOf (triangles, part.first, part.last, positions, context.run);
    for (CrossingPair& pair : pairs)
      pair = {part.places[pair.first], part.places[pair.second]};
  }
  ArrayWriter writer;
  writer.add ("mesh", mesh);
  writer.add ("pairs", reinterpret_cast<const Index*> (pairs.data ()), 2 * pairs.size ());
  context.store.put (blockFile (CROSSING, number), writer, context.plan.id);
}

bool
DividedCrossing::isFinished (std::size_t block, std::uint64_t mesh) const
{
  const std::string name = blockFile (CROSSING, numberOf (block));
  if (!folder_.has (name))
    return false;
  ArrayFile file = openArrays (folder_, name, context_.plan);
  file.verify ();
  return file.read<std::uint64_t> ("mesh").front () == mesh;
}

std::vector<CrossingPair>
DividedCrossing::findOnAll (const std::vector<Triangle>& triangles,
                            const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
{
  const std::uint64_t mesh = identify (triangles);
  std::deque<std::size_t> numbers;
  for (std::size_t block = 0; block < ranges_.blocks (); ++block)
    if (!isFinished (block, mesh))
      numbers.push_back (numberOf (block));
  const std::vector<Index> order = orderByPoints (triangles, positions.size ());
  if (!numbers.empty ()) {
    {
      std::vector<Triangle> sorted;
      sorted.reserve (order.size ());
      for (const Index t : order)
        sorted.push_back (triangles[t]);
      writeMesh (folder_, meshFile (search_), context_.plan, mesh, sorted,
                 makeBuckets (sorted, positions, run), ranges_);
    }
    deal_ (CROSSING, std::move (numbers));
    folder_.remove (meshFile (search_));
  }
  std::vector<CrossingPair> places;
  for (std::size_t block = 0; block < ranges_.blocks (); ++block) {
    ArrayFile file = openArrays (folder_, blockFile (CROSSING, numberOf (block)), context_.plan);
    const std::vector<Index> found = file.read<Index> ("pairs");
    for (std::size_t i = 0; i < found.size (); i += 2)
      places.push_back ({found[i], found[i + 1]});
  }
  return pairsInOrder (places, order);
}

std::vector<CrossingPair>
DividedCrossing::find (const std::vector<Triangle>& triangles,
                       const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
{
  if (search_ >= SEARCHES)
    throw std::logic_error ("more searches than have files");
  try {
    std::vector<CrossingPair> pairs = findOnAll (triangles, positions, run);
    ++search_;
    return pairs;
  }
  catch (...) {
    error_ = std::current_exception ();
    throw;
  }
}

void
removeCrossing (const FolderStore& folder, const Plan& plan)
{
  for (std::size_t search = 0; search < SEARCHES; ++search) {
    folder.remove (meshFile (search));
    for (std::size_t block = 0; block < plan.blocks; ++block)
      folder.remove (blockFile (CROSSING, search * plan.blocks + block));
  }
}

} // namespace floater
} // namespace pcl
