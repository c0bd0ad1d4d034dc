// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "job.h"

#include "cloud_geometry.h"
#include "local/planes.h"
#include "options/check_options.h"
#include "points/neighbors.h"
#include "points/outliers.h"
#include "stored_cloud.h"
#include "view/ray_evidence.h"

namespace pcl::floater {
namespace {
// Widths, see BlockCutter. Nearest neighbours are nearer than one. Most stars look no farther than
// two; those at boundaries look up to 40 spacings ahead, and are made again where that leaves the
// block.
constexpr double HALO = 1.0, PLANE_HALO = 2.0, STAR_HALO = 2.0;

// Writes what a block has found. Without arrays: it has no points.
void
put (const StepContext& context, const char* step, std::size_t block,
     const NamedArrays& arrays = {})
{
  context.store.put (blockFile (step, block), arrays, context.plan.id);
}

void
appendRow (const Row& row, CsrLists& all)
{
  if (all.offsets.empty ())
    all.offsets.push_back (0);
  all.ids.insert (all.ids.end (), row.begin (), row.end ());
  all.offsets.push_back (static_cast<Index> (all.ids.size ()));
}

/// Replaces points by their places in a block; NONE if they are not in it.
void
toPlaces (const PointBlock& block, std::vector<Index>& points)
{
  const auto isAt = [&block] (Index place, Index point) {
    return place < block.points.size () && block.points[place] == point;
  };
  Index place = 0; // of the last one
  for (Index& point : points) {
    place += point - block.points[place]; // mostly, all points between are in the block
    if (!isAt (place, point))
      place = block.placeOf (point);
    const bool is_there = isAt (place, point);
    point = is_there ? place : NONE;
    place = is_there ? place : 0;
  }
}

/// Lists of places for all points of a block, of lists of points of some. Those of the others are
/// empty.
/// \param rows whose lists are given, as points, ascending; all in the block
CsrLists
toPlaces (const PointBlock& block, const std::vector<Index>& rows, CsrLists lists)
{
  CsrLists places;
  places.offsets.assign (block.points.size () + 1, 0);
  for (std::size_t i = 0; i < rows.size (); ++i)
    places.offsets[block.placeOf (rows[i]) + 1] = static_cast<Index> (lists.row (i).size ());
  sumRowLengths (places.offsets);
  places.ids = std::move (lists.ids);
  toPlaces (block, places.ids);
  return places;
}

void
toPoints (const PointBlock& block, std::vector<Index>& places)
{
  for (Index& place : places)
    place = block.points[place];
}

/// Widens a block until all points of these lists are in it.
/// \param rows  own points, ascending
/// \param lists of these
void
takeIn (const std::vector<Index>& rows, const CsrLists& lists, StoredCloud& cloud,
        BlockSearch& search)
{
  do {
    const PointBlock& block = search.block ();
    for (std::size_t i = 0; i < rows.size (); ++i) {
      std::vector<Index> missing;
      for (const Index q : lists.row (i))
        if ((q < rows.front () || q > rows.back ()) &&
            !std::binary_search (block.points.begin (), block.points.end (), q))
          missing.push_back (q);
      if (missing.empty ())
        continue;
      sortUnique (missing);
      const Eigen::Vector3d& here = block.positions[block.placeOf (rows[i])];
      double farthest = 0.0;
      for (const Eigen::Vector3d& there : cloud.positions (missing))
        farthest = std::max (farthest, (there - here).norm ());
      search.watch ().looked (here, farthest);
    }
  } while (search.widen ());
}

void
appendStar (const Stars& from, std::size_t row, Stars& to)
{
  appendRow (from.neighbors.row (row), to.neighbors);
  appendRow (from.far_neighbors.row (row), to.far_neighbors);
  to.open.push_back (from.open[row]);
  to.normals.push_back (from.normals[row]);
  to.reach.push_back (from.reach[row]);
}

// Puts the stars of some of the own points in place of those that they had, if any.
void
replaceStars (const std::vector<Index>& points, const Stars& more, const std::vector<Index>& own,
              Stars& all)
{
  Stars merged;
  std::size_t next = 0;
  for (std::size_t row = 0; row < own.size (); ++row)
    if (next < points.size () && points[next] == own[row])
      appendStar (more, next++, merged);
    else
      appendStar (all, row, merged);
  all = std::move (merged);
}

} // namespace

StepContext::StepContext (Store& files, const Plan& of, const CommandLine& line,
                          const RunContext& context)
    : store (files), plan (of), options (effectiveOptions (line.options)),
      limits (effectiveLimits ({}, line.options)), run (context)
{
}

void
neighborsStep (const StepContext& context, std::size_t block)
{
  StoredCloud cloud (context, {});
  if (!cloud.hasPoints (block))
    return put (context, "neighbors", block);
  BlockSearch search (cloud.cutter (), block, context.run, HALO);
  const CsrLists neighbors =
      findNearestOfBlock (search, Rows::range (cloud.first (block), cloud.last (block)),
                          cloud.points (), context.options.neighbors.k, context.run);
  put (context, "neighbors", block, {{"ids", neighbors.ids}});
}

int
outliersStep (const Job& job, FolderStore& store, const Plan& plan)
{
  const StepContext context (store, plan, job.line, job.join_threads);
  std::vector<Index> outliers;
  if (context.options.remove_outliers) {
    std::vector<Index> gross_outliers;
    Points points = readPoints (context.store, POINTS, context.plan, gross_outliers);
    const CsrLists neighbors =
        StoredCloud (context, {}).nearest (pointsFrom (0, static_cast<Index> (points.size ())));
    outliers = findOutliers (points.positions, neighbors, context.run, context.limits.outliers);
    if (!outliers.empty ()) {
      removePoints (points, outliers);
      writePoints (context.store, POINTS_LEFT, context.plan.id, points, gross_outliers,
                   context.run);
    }
  }
  store.put (OUTLIERS, {{"outliers", outliers}}, plan.id);
  return EXIT_OK;
}

void
planesStep (const StepContext& context, std::size_t block)
{
  const std::vector<Index> outliers = readOutliers (context);
  StoredCloud cloud (context, outliers);
  if (!cloud.hasPoints (block))
    return put (context, "planes", block);
  CsrLists beside_lists;
  std::vector<float> beside_reach, spacing;
  std::vector<Eigen::Vector3f> normals;
  BlockSearch search (cloud.cutter (), block, context.run, PLANE_HALO);
  const Index first = cloud.first (block), last = cloud.last (block);
  const std::vector<Index> points = cloud.own (block);
  const CsrLists nearest =
      outliers.empty () ? cloud.nearest (points)
                        : findNearestOfBlock (search, Rows::range (first, last), cloud.points (),
                                              context.options.neighbors.k, context.run);
  takeIn (points, nearest, cloud, search);
  do {
    const PointBlock& local = search.block ();
    const std::vector<Eigen::Vector3d>& positions = local.positions;
    const Index own_first = search.ownFirst (), own_last = search.ownLast ();
    const Rows rows = Rows::range (own_first, own_last);
    CsrLists neighbors = toPlaces (local, points, nearest);
    spacing = localSpacing (positions, neighbors, rows, context.run);
    BesideLines beside;
    beside.neighbors.offsets.assign (positions.size () + 1, 0);
    beside.reach.assign (positions.size (), 0.0F);
    if (isAnyOnLine (positions, neighbors, rows, context.limits.planes.least_aspect, context.run))
      beside =
          findBesideLines (positions, neighbors, spacing, search.tree (), rows,
                           context.limits.planes.least_aspect, context.limits.reach, context.run);
    appendRows (beside.neighbors, neighbors);
    normals = fitTangentPlanes (positions, neighbors, rows, context.run, context.limits.planes);
    beside_lists = {};
    for (Index p = own_first; p < own_last; ++p)
      appendRow (beside.neighbors.row (p), beside_lists);
    toPoints (local, beside_lists.ids);
    const auto keepOwn = [&] (auto& values) {
      values.erase (values.begin () + own_last, values.end ());
      values.erase (values.begin (), values.begin () + own_first);
    };
    beside_reach = std::move (beside.reach);
    keepOwn (beside_reach);
    keepOwn (spacing);
    keepOwn (normals);
  } while (search.widen ());
  if (cloud.file ().count ("normals") > 0) {
    std::vector<Eigen::Vector3f> given;
    cloud.file ().append ("normals", first, last, given);
    for (std::size_t i = 0; i < given.size (); ++i)
      if (!given[i].isZero (0.0F))
        normals[i] = given[i];
  }
  NamedArrays arrays{{"beside", beside_lists.ids},
                     {"beside.offsets", beside_lists.offsets},
                     {"beside_reach", beside_reach},
                     {"spacing", spacing},
                     {"normals", normals}};
  if (!outliers.empty ())
    arrays.emplace_back ("ids", nearest.ids);
  put (context, "planes", block, arrays);
}

void
starsStep (const StepContext& context, std::size_t block)
{
  StoredCloud cloud (context, readOutliers (context));
  if (!cloud.hasPoints (block))
    return put (context, "stars", block);
  const StarSettings settings = starSettings ({context.options, context.limits, context.run});
  const std::vector<Index> own = cloud.own (block);
  const CsrLists beside_lists = cloud.gatherLists ("planes", "beside", own);
  CsrLists all_lists = cloud.nearest (own);
  appendRows (beside_lists, all_lists);
  const std::vector<float> own_spacing = cloud.gather<float> ("planes", "spacing", own);
  const std::vector<float> own_reach = cloud.gather<float> ("planes", "beside_reach", own);
  std::vector<Index> centres =
      areaSampleCentres (cloud.points (), context.limits.view.search.samples);
  centres.erase (std::remove_if (centres.begin (), centres.end (),
                                 [&] (Index p) { return p < own.front () || p > own.back (); }),
                 centres.end ());

  BlockSearch search (cloud.cutter (), block, context.run, STAR_HALO);
  Stars all;
  std::vector<Index> left = own; // points whose stars have to be made, at first or again
  std::vector<AreaSample> samples;
  bool are_sampled = false;
  takeIn (own, all_lists, cloud, search);
  do {
    const PointBlock& local = search.block ();
    const std::vector<Eigen::Vector3d>& positions = local.positions;
    const std::vector<Eigen::Vector3f> normals =
        cloud.gather<Eigen::Vector3f> ("planes", "normals", local.points);
    const CsrLists neighbors = toPlaces (local, own, all_lists);
    const Index own_first = search.ownFirst ();
    BesideLines beside;
    beside.neighbors = toPlaces (local, own, beside_lists);
    beside.reach.assign (positions.size (), 0.0F);
    std::copy (own_reach.begin (), own_reach.end (), beside.reach.begin () + own_first);
    std::vector<float> spacing (positions.size (), 0.0F);
    std::copy (own_spacing.begin (), own_spacing.end (), spacing.begin () + own_first);
    const BeyondNeighbors beyond{search.tree (), spacing, beside};
    std::vector<Index> left_places = left;
    toPlaces (local, left_places);
    const Stars begun = makeStars (positions, neighbors, normals, Rows::of (left_places), settings,
                                   context.run, &beyond);
    Stars made;
    for (const Index place : left_places)
      appendStar (begun, place, made);
    toPoints (local, made.neighbors.ids);
    toPoints (local, made.far_neighbors.ids);
    replaceStars (left, made, own, all);
    left = search.left ();
    if (!are_sampled) {
      search.hasLeft ();
      std::vector<Index> places = centres;
      toPlaces (local, places);
      const Stars stars =
          makeStarsOf (places, positions, neighbors, normals, settings, context.run, &beyond);
      are_sampled = !search.hasLeft ();
      if (are_sampled)
        samples = takeAreaSamples (places, positions, stars);
    }
  } while (search.widen ());
  put (context, "stars", block,
       {{"stars", all.neighbors.ids},
        {"stars.offsets", all.neighbors.offsets},
        {"far", all.far_neighbors.ids},
        {"far.offsets", all.far_neighbors.offsets},
        {"open", all.open},
        {"normals", all.normals},
        {"reach", all.reach},
        {"areas", samples}});
}

const Step*
findStep (const std::string& name)
{
  const auto* const step = std::find_if (
      STEPS.begin (), STEPS.end (), [&name] (const Step& known) { return name == known.name; });
  return step == STEPS.end () ? nullptr : step;
}

} // namespace pcl::floater
