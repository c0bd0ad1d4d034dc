// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "part_steps.h"

#include "core/parallel.h"
#include "part_files.h"
#include "stored_cloud.h"

#include <xxhash.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace pcl::floater {
namespace {
constexpr const char* CHANGES = "changes.bin"; // what `join` has decided of the parts

// What the blocks have found out about the points of a part.
class StoredPart
{
public:
  StoredPart (const StepContext& context, std::size_t part)
      : context_ (context), outliers_ (readOutliers (context)), cloud_ (context, outliers_, false),
        parts_ (cloud_.points (), context.limits.parts),
        first_ (part < parts_.count () ? parts_.first (part) : 0),
        last_ (part < parts_.count () ? parts_.last (part) : 0),
        neighbors_ (context, outliers_, cloud_.ranges ()),
        stars_ (context.store, context.plan, cloud_.ranges (), "stars"),
        triangles_ (context.store, context.plan, cloud_.ranges (), "triangles")
  {
  }

  bool isEmpty () const { return first_ == last_; }

  PartPoints points ()
  {
    const std::vector<Index> own = pointsFrom (first_, last_);
    return {first_,
            cloud_.gather (own),
            stars_.gather<Eigen::Vector3f> ("normals", own),
            triangles_.gather<float> ("spacing", own),
            {}};
  }

  std::vector<Eigen::Vector3f> facingNormals ()
  {
    std::vector<Eigen::Vector3f> normals;
    cloud_.file ().append ("facing_normals", first_, last_, normals);
    return normals;
  }

  std::vector<Eigen::Vector3f> smoothed ()
  {
    return triangles_.gather<Eigen::Vector3f> ("smoothed_normals", pointsFrom (first_, last_));
  }

  PartCandidates candidates ()
  {
    CandidateLists all;
    all.sure_ranks = context_.limits.surface.consensus.candidates.sure_ranks;
    const BlockRanges& ranges = cloud_.ranges ();
    for (std::size_t block = ranges.blockOf (first_); block <= ranges.blockOf (last_ - 1); ++block)
      appendCandidates (triangles_.file (block), first_, last_, cloud_.points (), all);
    return divideCandidates (
        std::move (all), first_, last_,
        triangles_.gather<std::uint8_t> ("reaches_out", pointsFrom (first_, last_)));
  }

  // Valid as long as this.
  NeighborRows neighbors ()
  {
    return [this] (const std::vector<Index>& points) {
      CsrLists rows = neighbors_.all (points);
      appendRows (triangles_.gatherLists ("far", points), rows);
      return rows;
    };
  }

  OtherPoints others ()
  {
    return [this] (const std::vector<Index>& points, std::vector<Eigen::Vector3d>& positions,
                   std::vector<Eigen::Vector3f>& normals) {
      positions = cloud_.gather (points);
      normals = stars_.gather<Eigen::Vector3f> ("normals", points);
    };
  }

  Index first () const { return first_; }
  Index last () const { return last_; }
  PartOfPoints place () const { return {first_, last_, cloud_.points ()}; }

private:
  const StepContext& context_;
  std::vector<Index> outliers_;
  StoredCloud cloud_;
  Parts parts_;
  Index first_, last_;
  StoredNeighbors neighbors_;
  Slices stars_, triangles_;
};

PartMesh
meshOf (StoredPart& stored, const PartPoints& points, const StepContext& context)
{
  return makePartMesh (points, stored.smoothed (), stored.candidates (), stored.neighbors (),
                       context.limits.surface.consensus, context.run);
}

PartRim
rimOf (StoredPart& stored, const PartPoints& points, const PartMesh& mesh, std::size_t rings,
       const StepContext& context)
{
  return findRim (points, mesh, stored.neighbors (), stored.others (), rings,
                  context.limits.surface.consensus.smallest_island);
}

// What parts need to know of the whole to be finished.
void
addWhole (const PartsSettings& settings, std::vector<double>& numbers)
{
  numbers = {settings.diagonal, settings.remove_self_intersections ? 1.0 : 0.0,
             settings.surface.facing.normals != nullptr ? 1.0 : 0.0};
  if (const std::optional<Eigen::Vector3d>& sensor = settings.surface.facing.sensor)
    numbers.insert (numbers.end (), sensor->begin (), sensor->end ());
}

PartsSettings
readWhole (ArrayFile& file, const StepContext& context, bool& has_facing_normals)
{
  const std::vector<double> numbers = file.read<double> ("whole");
  file.require (numbers.size () == 3 || numbers.size () == 6);
  PartsSettings settings;
  settings.surface.flip_edges = context.options.flip_edges;
  settings.surface.limits = context.limits.surface;
  settings.parts = context.limits.parts;
  settings.check = context.limits.check;
  settings.uncrossing = context.limits.uncrossing;
  settings.diagonal = numbers[0];
  settings.remove_self_intersections = numbers[1] != 0.0;
  has_facing_normals = numbers[2] != 0.0;
  constexpr std::size_t SENSOR = 3; // where its place begins
  if (numbers.size () > SENSOR)
    settings.surface.facing.sensor = Eigen::Vector3d (numbers.data () + SENSOR);
  return settings;
}

// Tells what was decided from what was decided in another run.
std::uint64_t
identify (const std::vector<PartChange>& changes)
{
  std::uint64_t value = 0;
  const auto add = [&value] (const auto& list) {
    const std::uint64_t count = list.size ();
    value = XXH3_64bits_withSeed (&count, sizeof (count), value);
    value = XXH3_64bits_withSeed (list.data (), list.size () * sizeof (list[0]), value);
  };
  for (const PartChange& change : changes) {
    add (change.dropped);
    add (change.turned);
    add (change.added);
    add (change.seam);
    add (change.beside);
  }
  return value;
}

} // namespace

Parts
partsOf (const StepContext& context)
{
  return {context.plan.points - readOutliers (context).size (), context.limits.parts};
}

void
meshStep (const StepContext& context, std::size_t part)
{
  StoredPart stored (context, part);
  PartMesh mesh;
  PartRim rim;
  if (!stored.isEmpty ()) {
    const PartPoints points = stored.points ();
    mesh = meshOf (stored, points, context);
    rim = rimOf (stored, points, mesh, context.limits.parts.rim, context);
  }
  ArrayWriter writer;
  writer.add ("triangles", mesh.triangles);
  addRim (rim, writer);
  context.store.put (blockFile (MESH, part), writer, context.plan.id);
}

void
finishStep (const StepContext& context, std::size_t part)
{
  StoredPart stored (context, part);
  ArrayFile changes = openArrays (context.store, CHANGES, context.plan);
  const auto id = changes.read<std::uint64_t> ("id");
  std::vector<Triangle> triangles;
  {
    ArrayFile mesh = openArrays (context.store, blockFile (MESH, part), context.plan);
    triangles = mesh.read<Triangle> ("triangles");
    mesh.requireBelow (triangles, stored.last () - stored.first ());
  }
  if (stored.isEmpty ()) // it is one part less than was planned
    return;
  bool has_facing_normals = false;
  const PartsSettings settings = readWhole (changes, context, has_facing_normals);
  PartPoints points = stored.points ();
  if (has_facing_normals)
    points.facing_normals = stored.facingNormals ();
  const FinishedPart finished = finishPart (
      std::move (points), std::move (triangles), readChange (changes, part, stored.place ()),
      stored.neighbors (), settings.ofPart (partsOf (context)), context.run);
  ArrayWriter writer;
  writer.add ("id", id);
  addFinished (finished, writer);
  context.store.put (blockFile (FINISH, part), writer, context.plan.id);
}

PartRim
StoredParts::rim (std::size_t part, std::size_t rings)
{
  if (rings == context_.limits.parts.rim) {
    ArrayFile file = openArrays (context_.store, blockFile (MESH, part), context_.plan);
    return readRim (file, pointsOf (part));
  }
  StoredPart stored (context_, part); // more of it than is in the file
  const PartPoints points = stored.points ();
  return rimOf (stored, points, meshOf (stored, points, context_), rings, context_);
}

bool
isPartFinished (const StepContext& context, const FolderStore& folder, std::size_t part)
{
  if (!folder.has (blockFile (FINISH, part)))
    return false;
  ArrayFile file = openArrays (context.store, blockFile (FINISH, part), context.plan);
  file.verify ();
  ArrayFile changes = openArrays (context.store, CHANGES, context.plan);
  return file.read<std::uint64_t> ("id") == changes.read<std::uint64_t> ("id");
}

void
StoredParts::finish (std::vector<PartChange> changes, const RunContext& run)
{
  const std::uint64_t id = identify (changes);
  ArrayWriter writer;
  writer.add ("id", &id, 1);
  std::vector<double> whole;
  addWhole (settings_, whole);
  writer.add ("whole", whole);
  addChanges (changes, writer);
  folder_.put (CHANGES, writer, context_.plan.id);
  std::deque<std::size_t> left;
  for (std::size_t part = 0; part < parts_.count (); ++part)
    if (!isPartFinished (context_, folder_, part))
      left.push_back (part);
  if (left.empty ())
    return;
  if (deal_)
    deal_ (FINISH, std::move (left));
  else
    parallelTasks (run, left.size (), [&] (std::size_t i) {
      const RunContext one = run.withThreads (1);
      finishStep ({context_.store, context_.plan, context_.options, context_.limits, one}, left[i]);
    });
}

FinishedPart
StoredParts::finished (std::size_t part)
{
  ArrayFile file = openArrays (context_.store, blockFile (FINISH, part), context_.plan);
  return readFinished (file, pointsOf (part));
}

std::vector<Eigen::AlignedBox3d>
StoredParts::buckets (std::size_t part)
{
  ArrayFile file = openArrays (context_.store, blockFile (FINISH, part), context_.plan);
  return file.read<Box> ("buckets");
}

std::vector<Triangle>
StoredParts::triangles (std::size_t part, const Ranges& ranges)
{
  ArrayFile file = openArrays (context_.store, blockFile (FINISH, part), context_.plan);
  std::vector<Triangle> some;
  for (const auto& [first, last] : ranges)
    file.append ("triangles", first, last, some);
  file.requireBelow (some, parts_.last (part));
  return some;
}

PointValues
StoredParts::valuesOf (const std::vector<Index>& points)
{
  const std::vector<Index> outliers = readOutliers (context_);
  StoredCloud cloud (context_, outliers, false);
  Slices triangles (context_.store, context_.plan, cloud.ranges (), "triangles");
  return {cloud.gather (points), triangles.gather<float> ("spacing", points)};
}

void
removeFinished (const FolderStore& folder, const Plan& plan, bool with_triangles)
{
  folder.remove (CHANGES);
  if (!with_triangles)
    return;
  for (std::size_t part = 0; part < plan.parts; ++part)
    folder.remove (blockFile (FINISH, part));
}

} // namespace pcl::floater
