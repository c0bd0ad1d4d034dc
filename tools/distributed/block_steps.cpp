// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "job.h"

#include "points/neighbors.h"
#include "points/net.h"
#include "points/outliers.h"
#include "stored_cloud.h"

namespace pcl::floater {
namespace {
// Widths of the halos, see BlockSearch. Nearest neighbours are nearer than one. Stars at boundaries
// look up to 40 spacings ahead, most others no farther than two widths.
constexpr double PLANE_HALO = 2.0, STAR_HALO = 4.0;

// Writes what a block has found. Without arrays: it has no points.
void
put (const StepContext& context, const char* step, std::size_t block,
     const NamedArrays& arrays = {})
{
  context.store.put (blockFile (step, block), arrays, context.plan.id);
}

/// Replaces points by their places in a block; NONE if they are not in it.
void
toPlaces (const BlockSearch& block, std::vector<Index>& points)
{
  const std::vector<Index>& its = block.points ();
  const auto isAt = [&its] (Index place, Index point) {
    return place < its.size () && its[place] == point;
  };
  Index place = 0; // of the last one
  for (Index& point : points) {
    place += point - its[place]; // mostly, all points between are in the block
    if (!isAt (place, point))
      place = block.placeOf (point);
    const bool is_there = isAt (place, point);
    point = is_there ? place : NONE;
    place = is_there ? place : 0;
  }
}

/// Lists of places for all points of a block, of lists of points of its own. Those of the others are
/// empty.
CsrLists
toPlaces (const BlockSearch& block, CsrLists lists)
{
  lists.offsets.insert (lists.offsets.begin (), block.ownFirst (), 0);
  lists.offsets.resize (block.points ().size () + 1, lists.offsets.back ());
  toPlaces (block, lists.ids);
  return lists;
}

/// Values of all points of a block, of those of its own. Others have 0.
std::vector<float>
toPlaces (const BlockSearch& block, const std::vector<float>& own)
{
  std::vector<float> values (block.points ().size (), 0.0F);
  std::copy (own.begin (), own.end (), values.begin () + block.ownFirst ());
  return values;
}

/// The lists of the own points of a block, as points.
CsrLists
ofOwn (const BlockSearch& block, const CsrLists& lists)
{
  return makeCsrLists (block.ownLast () - block.ownFirst (), [&] (const auto& emit) {
    for (Index p = block.ownFirst (); p < block.ownLast (); ++p)
      for (const Index place : lists.row (p))
        emit (p - block.ownFirst (), block.points ()[place]);
  });
}

/// The values of the own points of a block.
template <typename Value>
std::vector<Value>
ofOwn (const BlockSearch& block, const std::vector<Value>& values)
{
  return {values.begin () + block.ownFirst (), values.begin () + block.ownLast ()};
}

} // namespace

void
neighborsStep (const StepContext& context, std::size_t block)
{
  StoredCloud cloud (context, {});
  if (!cloud.hasPoints (block))
    return put (context, "neighbors", block);
  put (context, "neighbors", block, {{"ids", cloud.findNearest (block).ids}});
}

int
outliersStep (const Job& job, const Store& store, const Plan& plan)
{
  const StepContext context{store, plan, job.line, job.join_threads};
  std::vector<Index> gross_outliers;
  Points points = readPoints (store, plan, gross_outliers);
  CsrLists neighbors = StoredCloud (context, {}).nearestOfAll ();
  chooseNet (points, neighbors, {context.options.neighbors}, context.run, nullptr);
  const std::vector<std::uint8_t> are_stacked (points.stacked.of.empty () ? 0 : 1);
  std::vector<Index> outliers;
  if (context.options.remove_outliers)
    outliers = findOutliers (points.positions, neighbors, context.run);
  if (!outliers.empty ())
    removePoints (points, outliers);
  if (!are_stacked.empty () || !outliers.empty ())
    writePoints (store, POINTS_LEFT, plan.id, points, gross_outliers);
  store.put (OUTLIERS, {{"outliers", outliers}, {"are_stacked", are_stacked}}, plan.id);
  return EXIT_OK;
}

void
planesStep (const StepContext& context, std::size_t block)
{
  const LeftOut left_out = readLeftOut (context);
  StoredCloud cloud (context, left_out);
  if (!cloud.hasPoints (block))
    return put (context, "planes", block);
  const CsrLists nearest =
      left_out.isNothing () ? cloud.nearest (cloud.own (block)) : cloud.findNearest (block);
  const StarSettings settings = starSettings (context.options);
  BlockSearch search (cloud.cutter (), block, PLANE_HALO, nearest.ids);
  LocalPlanes planes;
  do {
    Points around;
    around.positions = search.positions ();
    around.normals = cloud.given<Eigen::Vector3f> ("normals", search.points ());
    planes = beginPlanes (around, toPlaces (search, nearest), search.makeTree (context.run),
                          settings, context.run);
    planes = fitLocalPlanes (around, std::move (planes), settings, context.run);
  } while (search.widen ());
  const CsrLists beside = ofOwn (search, planes.beside);
  put (context, "planes", block,
       {{"beside", beside.ids},
        {"beside.offsets", beside.offsets},
        {"beside_reach", ofOwn (search, planes.beside_reach)},
        {"spacing", ofOwn (search, planes.spacing)},
        {"normals", ofOwn (search, planes.normals)},
        {"ids", left_out.isNothing () ? std::vector<Index> () : nearest.ids}});
}

void
starsStep (const StepContext& context, std::size_t block)
{
  StoredCloud cloud (context, readLeftOut (context));
  if (!cloud.hasPoints (block))
    return put (context, "stars", block);
  const StarSettings settings = starSettings (context.options);
  const std::vector<Index> own = cloud.own (block);
  const CsrLists beside_lists = cloud.gatherLists ("planes", "beside", own);
  CsrLists all_lists = cloud.nearest (own);
  appendRows (beside_lists, all_lists);
  const std::vector<float> own_spacing = cloud.gather<float> ("planes", "spacing", own);
  const std::vector<float> own_reach = cloud.gather<float> ("planes", "beside_reach", own);
  BlockSearch search (cloud.cutter (), block, STAR_HALO, all_lists.ids);
  Stars made;
  do {
    LocalPlanes planes;
    planes.neighbors = toPlaces (search, all_lists);
    planes.normals = cloud.gather<Eigen::Vector3f> ("planes", "normals", search.points ());
    planes.spacing = toPlaces (search, own_spacing);
    planes.beside = toPlaces (search, beside_lists);
    planes.beside_reach = toPlaces (search, own_reach);
    planes.tree = search.makeTree (context.run);
    made = makeStars (search.positions (), planes.neighbors, planes.normals,
                      Rows::range (search.ownFirst (), search.ownLast ()), settings, context.run,
                      settings.reach_beyond ? &planes : nullptr);
  } while (search.widen ());
  const CsrLists stars = ofOwn (search, made.neighbors), far = ofOwn (search, made.far_neighbors);
  put (context, "stars", block,
       {{"stars", stars.ids},
        {"stars.offsets", stars.offsets},
        {"far", far.ids},
        {"far.offsets", far.offsets},
        {"open", ofOwn (search, made.open)},
        {"normals", ofOwn (search, made.normals)},
        {"reach", ofOwn (search, made.reach)}});
}

} // namespace pcl::floater
