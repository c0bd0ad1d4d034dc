// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_steps.h"

#include "cloud_geometry.h"
#include "local/planes.h"
#include "options/check_options.h"
#include "points/neighbors.h"
#include "points/outliers.h"
#include "stored_cloud.h"
#include "view/ray_evidence.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl::floater {
namespace {
constexpr double HALO = 1.0; // width, see BlockCutter: neighbours are nearer
constexpr std::size_t POINTS_OF_APART = 20, REACH_OF = 6; // neighbours that findApart looks at

// Writes what a block has found. Without arrays: it has no points.
void
put (const StepContext& context, const char* step, std::size_t block,
     const ArrayWriter& writer = {})
{
  context.store.put (blockFile (step, block), writer, context.plan.id);
}

// Whether points lie apart. The reach of the points around is needed, and these may be of other
// blocks.
std::vector<std::uint8_t>
findOwnApart (const std::vector<Index>& own, const CsrLists& neighbors, BlockSearch& search,
              const StepContext& context)
{
  struct Other
  {
    Index point, owner; // a point of another block, and an own one that it is a neighbour of
  };
  std::vector<Other> others;
  for (std::size_t i = 0; i < own.size (); ++i)
    for (const Index q : neighbors.first (i, POINTS_OF_APART))
      if (q < own.front () || q > own.back ())
        others.push_back ({q, own[i]});
  std::stable_sort (others.begin (), others.end (),
                    [] (const Other& a, const Other& b) { return a.point < b.point; });
  others.erase (std::unique (others.begin (), others.end (),
                             [] (const Other& a, const Other& b) { return a.point == b.point; }),
                others.end ());
  std::vector<Index> rows = own;
  for (const Other& other : others)
    rows.push_back (other.point);
  sortUnique (rows);
  CsrLists lists;
  lookUntilInside (search, [&] (const LocalPoints& local,
                                const std::vector<Eigen::Vector3d>& positions) {
    lists = {};
    lists.offsets.push_back (0);
    std::vector<Neighbor> found;
    auto other = others.begin ();
    for (const Index p : rows) {
      if (other == others.end () || other->point != p) {
        const Row row = neighbors.row (p - own.front ());
        lists.ids.insert (lists.ids.end (), row.begin (), row.end ());
      }
      else {
        const Eigen::Vector3d& here = positions[local.placeOf (p)];
        search.tree ().nearest (here, REACH_OF + 1, found);
        const Eigen::Vector3d& owner = positions[local.placeOf (other->owner)];
        search.watch ().looked (owner, found.size () == REACH_OF + 1
                                           ? (here - owner).norm () +
                                                 std::sqrt (found.back ().sqr_distance)
                                           : KdTree::EVERYWHERE);
        std::size_t count = 0;
        for (const Neighbor& neighbor : found)
          if (const Index q = search.block ().points[neighbor.point]; q != p && count < REACH_OF) {
            lists.ids.push_back (q);
            ++count;
          }
        ++other;
      }
      lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
    }
  });
  const LocalPoints local (search.block ().points);
  const CsrLists places = local.toPlaces (rows, lists);
  local.toPlaces (rows);
  std::vector<float> reach (local.size (), 0.0F);
  const std::vector<Eigen::Vector3d>& positions = search.block ().positions;
  findReaches (positions, places, Rows::of (rows), reach, context.run);
  return findApart (positions, places, reach, Rows::range (search.ownFirst (), search.ownLast ()),
                    context.limits.outliers, context.run);
}

} // namespace

StepContext::StepContext (Store& files, const Plan& of, const CommandLine& line,
                          const RunContext& context)
    : store (files), plan (of), options (effectiveOptions (line.options)),
      limits (effectiveLimits (line.limits, line.options)), run (context)
{
}

void
neighborsStep (const StepContext& context, std::size_t block)
{
  StoredCloud cloud (context, {}, true);
  const Index first = cloud.ranges ().first (block), last = cloud.ranges ().last (block);
  if (first == last)
    return put (context, "neighbors", block);
  BlockSearch search (cloud.cutter (), block, context.run, HALO);
  const CsrLists neighbors = findNearestOfBlock (search, Rows::range (first, last), cloud.points (),
                                                 context.options.neighbors.k, context.run);
  std::vector<std::uint8_t> apart;
  if (context.options.remove_outliers && mayHaveOutliers (cloud.points (), context.limits.outliers))
    apart = findOwnApart (pointsFrom (first, last), neighbors, search, context);
  const std::vector<std::uint64_t> count{
      static_cast<std::uint64_t> (std::count (apart.begin (), apart.end (), 1))};
  ArrayWriter writer;
  writer.add ("ids", neighbors.ids);
  writer.add ("apart", apart);
  writer.add ("apart_count", count);
  put (context, "neighbors", block, writer);
}

void
chooseOutliersStep (const StepContext& context)
{
  const std::size_t n = context.plan.points;
  const BlockRanges ranges = blockRanges (context.plan, n);
  Slices found (context.store, context.plan, ranges, "neighbors");
  std::uint64_t apart_count = 0;
  for (std::size_t block = 0; block < ranges.blocks (); ++block)
    if (!ranges.isEmpty (block))
      apart_count += found.file (block).read<std::uint64_t> ("apart_count", 0, 1).front ();
  std::vector<Index> outliers;
  if (apart_count > 0) {
    const std::size_t k =
        std::min<std::size_t> (static_cast<std::size_t> (context.options.neighbors.k), n - 1);
    const std::size_t own = std::min (k, context.limits.outliers.own);
    std::vector<std::uint8_t> apart;
    apart.reserve (n);
    requireListed (n * own);
    CsrLists neighbors; // the nearest of each
    neighbors.offsets.resize (n + 1);
    for (std::size_t p = 0; p <= n; ++p)
      neighbors.offsets[p] = static_cast<Index> (p * own);
    neighbors.ids.reserve (n * own);
    for (std::size_t block = 0; block < ranges.blocks (); ++block) {
      const std::size_t points = ranges.last (block) - ranges.first (block);
      if (points == 0)
        continue;
      const auto ids = found.file (block).read<Index> ("ids", 0, points * k);
      found.file (block).requireBelow (ids, n);
      for (std::size_t i = 0; i < ids.size (); i += k)
        neighbors.ids.insert (neighbors.ids.end (), ids.begin () + static_cast<std::ptrdiff_t> (i),
                              ids.begin () + static_cast<std::ptrdiff_t> (i + own));
      const std::vector<std::uint8_t> flags =
          found.file (block).read<std::uint8_t> ("apart", 0, points);
      apart.insert (apart.end (), flags.begin (), flags.end ());
    }
    outliers = chooseOutliers (neighbors, std::move (apart), context.limits.outliers);
  }
  if (!outliers.empty ()) {
    std::vector<Index> gross_outliers;
    Points points = readPoints (context.store, POINTS, context.plan, gross_outliers);
    removePoints (points, outliers);
    writePoints (context.store, POINTS_LEFT, context.plan.id, points, gross_outliers, context.run);
  }
  ArrayWriter writer;
  writer.add ("outliers", outliers);
  context.store.put (OUTLIERS, writer, context.plan.id);
}

namespace {
constexpr double PLANE_HALO = 2.0; // width, see BlockCutter

// A point before outliers were removed, by its number after that.
Index
numberBefore (Index point, const std::vector<Index>& removed)
{
  std::size_t first = 0, last = removed.size (); // those removed up to the point are below
  while (first < last) {
    const std::size_t middle = first + (last - first) / 2;
    if (removed[middle] - middle <= point)
      first = middle + 1;
    else
      last = middle;
  }
  return point + static_cast<Index> (first);
}

CsrLists
renewOwn (const OwnBlock& own, BlockSearch& search, const StepContext& context)
{
  const BlockRanges before = blockRanges (context.plan, context.plan.points);
  StoredNeighbors found (context, {}, before);
  const Index first = numberBefore (own.first, own.outliers);
  const CsrLists lists =
      found.nearest (pointsFrom (first, numberBefore (own.last - 1, own.outliers) + 1));
  return renewRows (lists, first, context.plan.points, own.outliers, [&] (const Rows& rows) {
    return findNearestOfBlock (search, rows, own.cloud.points (), context.options.neighbors.k,
                               context.run);
  });
}

} // namespace

void
planesStep (const StepContext& context, std::size_t block)
{
  OwnBlock own (context, block);
  if (own.isEmpty ())
    return put (context, "planes", block);
  ArrayWriter writer;
  CsrLists renewed, beside_lists;
  std::vector<float> beside_reach, spacing;
  std::vector<Eigen::Vector3f> normals;
  StoredCloud& cloud = own.cloud;
  BlockSearch search (cloud.cutter (), block, context.run, PLANE_HALO);
  const std::vector<Index> points = own.points ();
  CsrLists nearest;
  if (own.outliers.empty ())
    nearest = StoredNeighbors (context, own.outliers, cloud.ranges ()).nearest (points);
  else
    nearest = renewed = renewOwn (own, search, context);
  takeIn (points, nearest, cloud, search);
  lookUntilInside (search, [&] (const LocalPoints& local,
                                const std::vector<Eigen::Vector3d>& positions) {
    const Index own_first = search.ownFirst (), own_last = search.ownLast ();
    const Rows rows = Rows::range (own_first, own_last);
    CsrLists neighbors = local.toPlaces (points, nearest);
    spacing = localSpacing (positions, neighbors, rows, context.run);
    BesideLines beside;
    beside.neighbors.offsets.assign (local.size () + 1, 0);
    beside.reach.assign (local.size (), 0.0F);
    if (isAnyOnLine (positions, neighbors, rows, context.limits.planes.least_aspect, context.run))
      beside =
          findBesideLines (positions, neighbors, spacing, search.tree (), rows,
                           context.limits.planes.least_aspect, context.limits.reach, context.run);
    appendRows (beside.neighbors, neighbors);
    normals = fitTangentPlanes (positions, neighbors, rows, context.run, context.limits.planes);
    beside_lists = {};
    for (Index p = own_first; p < own_last; ++p)
      appendRow (beside.neighbors.row (p), beside_lists);
    local.toPoints (beside_lists.ids);
    const auto keepOwn = [&] (auto& values) {
      values.erase (values.begin () + own_last, values.end ());
      values.erase (values.begin (), values.begin () + own_first);
    };
    beside_reach = std::move (beside.reach);
    keepOwn (beside_reach);
    keepOwn (spacing);
    keepOwn (normals);
  });
  if (cloud.file ().count<Eigen::Vector3f> ("normals") > 0) {
    std::vector<Eigen::Vector3f> given;
    cloud.file ().append ("normals", own.first, own.last, given);
    for (std::size_t i = 0; i < given.size (); ++i)
      if (!given[i].isZero (0.0F))
        normals[i] = given[i];
  }
  if (!own.outliers.empty ())
    writeLists ("renewed", renewed, writer);
  writeLists ("beside", beside_lists, writer);
  writer.add ("beside_reach", beside_reach);
  writer.add ("spacing", spacing);
  writer.add ("normals", normals);
  put (context, "planes", block, writer);
}

namespace {
// Width, see BlockCutter. Most stars look no farther than that; those at boundaries look up to 40
// spacings ahead, and are made again where that leaves the block.
constexpr double STAR_HALO = 2.0;

// The lists of some of the own points, by their numbers in the working set.
struct OwnStars
{
  CsrLists stars, far;
  std::vector<std::uint8_t> open;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> reach;
};

// \param rows places of the points whose stars are taken
OwnStars
takeStars (const Stars& stars, const Rows& rows, const LocalPoints& local)
{
  OwnStars own;
  for (auto [from, to] :
       {std::pair (&stars.neighbors, &own.stars), std::pair (&stars.far_neighbors, &own.far)}) {
    for (std::size_t i = 0; i < rows.size (); ++i)
      appendRow (from->row (rows[i]), *to);
    local.toPoints (to->ids);
  }
  for (std::size_t i = 0; i < rows.size (); ++i) {
    own.open.push_back (stars.open[rows[i]]);
    own.normals.push_back (stars.normals[rows[i]]);
    own.reach.push_back (stars.reach[rows[i]]);
  }
  return own;
}

// Puts the stars of some points in place of those that they had.
// \param first the point of the first star of `all`
void
replaceStars (const std::vector<Index>& points, const OwnStars& more, Index first, OwnStars& all)
{
  const auto replaceLists = [&] (const CsrLists& by, CsrLists& lists) {
    CsrLists merged;
    merged.ids.reserve (lists.ids.size () + by.ids.size ());
    merged.offsets.reserve (lists.offsets.size ());
    std::size_t next = 0;
    for (std::size_t r = 0; r < lists.rows (); ++r) {
      const bool is_replaced = next < points.size () && points[next] == first + r;
      appendRow (is_replaced ? by.row (next) : lists.row (r), merged);
      next += is_replaced ? 1 : 0;
    }
    lists = std::move (merged);
  };
  replaceLists (more.stars, all.stars);
  replaceLists (more.far, all.far);
  for (std::size_t i = 0; i < points.size (); ++i) {
    const std::size_t at = points[i] - first;
    all.open[at] = more.open[i];
    all.normals[at] = more.normals[i];
    all.reach[at] = more.reach[i];
  }
}

} // namespace

void
starsStep (const StepContext& context, std::size_t block)
{
  OwnBlock own_block (context, block);
  if (own_block.isEmpty ())
    return put (context, "stars", block);
  StoredCloud& cloud = own_block.cloud;
  const Index first = own_block.first, last = own_block.last;
  const StarSettings settings = starSettings ({context.options, context.limits, context.run});
  StoredNeighbors stored (context, own_block.outliers, cloud.ranges ());
  const std::vector<Index> own = own_block.points ();
  const CsrLists beside_lists = stored.beside (own);
  CsrLists all_lists = stored.nearest (own);
  appendRows (beside_lists, all_lists);
  const std::vector<float> own_spacing = stored.planes ().gather<float> ("spacing", own);
  const std::vector<float> own_reach = stored.planes ().gather<float> ("beside_reach", own);
  std::vector<Index> centres =
      areaSampleCentres (cloud.points (), context.limits.view.search.samples);
  centres.erase (std::remove_if (centres.begin (), centres.end (),
                                 [&] (Index p) { return p < first || p >= last; }),
                 centres.end ());

  BlockSearch search (cloud.cutter (), block, context.run, STAR_HALO);
  OwnStars all;
  std::vector<Index> left; // points whose stars have to be made again
  std::vector<AreaSample> samples;
  bool is_first = true, are_sampled = false;
  takeIn (own, all_lists, cloud, search);
  lookUntilInside (search, [&] (const LocalPoints& local,
                                const std::vector<Eigen::Vector3d>& positions) {
    const std::vector<Eigen::Vector3f> normals =
        stored.planes ().gather<Eigen::Vector3f> ("normals", search.block ().points);
    const CsrLists neighbors = local.toPlaces (own, all_lists);
    const Index own_first = search.ownFirst ();
    BesideLines beside;
    beside.neighbors = local.toPlaces (own, beside_lists);
    beside.reach.assign (local.size (), 0.0F);
    std::copy (own_reach.begin (), own_reach.end (), beside.reach.begin () + own_first);
    std::vector<float> spacing (local.size (), 0.0F);
    std::copy (own_spacing.begin (), own_spacing.end (), spacing.begin () + own_first);
    const BeyondNeighbors beyond{search.tree (), spacing, beside, settings.reach};
    std::vector<Index> left_places = left;
    local.toPlaces (left_places);
    const Rows rows =
        is_first ? Rows::range (own_first, search.ownLast ()) : Rows::of (left_places);
    const OwnStars made =
        takeStars (beginStars (positions, neighbors, normals, rows, settings, context.run, &beyond),
                   rows, local);
    if (is_first)
      all = made;
    else
      replaceStars (left, made, first, all);
    is_first = false;
    left = search.left ();
    if (!are_sampled) {
      search.hasLeft ();
      std::vector<Index> places = centres;
      local.toPlaces (places);
      const Stars stars =
          makeStarsOf (places, positions, neighbors, normals, settings, context.run, &beyond);
      are_sampled = !search.hasLeft ();
      if (are_sampled)
        samples = takeAreaSamples (places, positions, stars);
    }
  });
  ArrayWriter writer;
  writeLists ("stars", all.stars, writer);
  writeLists ("far", all.far, writer);
  writer.add ("open", all.open);
  writer.add ("normals", all.normals);
  writer.add ("reach", all.reach);
  writer.add ("areas", samples);
  put (context, "stars", block, writer);
}

const Step*
findStep (const std::string& name)
{
  const auto* const step = std::find_if (
      STEPS.begin (), STEPS.end (), [&name] (const Step& known) { return name == known.name; });
  return step == STEPS.end () ? nullptr : step;
}

} // namespace pcl::floater
