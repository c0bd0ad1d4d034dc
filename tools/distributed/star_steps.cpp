// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_steps.h"
#include "part_steps.h"

#include "cloud_geometry.h"
#include "known_stages.h"
#include "local/planes.h"
#include "stored_cloud.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl::floater {
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

void
writeStars (const StepContext& context, std::size_t block, const OwnStars& own,
            const std::vector<AreaSample>& samples)
{
  ArrayWriter writer;
  writeLists ("stars", own.stars, writer);
  writeLists ("far", own.far, writer);
  writer.add ("open", own.open);
  addVectors ("normals", own.normals, writer);
  writer.add ("reach", own.reach);
  std::vector<double> areas; // position, normal, area
  for (const AreaSample& sample : samples) {
    areas.insert (areas.end (), sample.position.data (), sample.position.data () + 3);
    areas.insert (areas.end (), sample.normal.data (), sample.normal.data () + 3);
    areas.push_back (sample.area);
  }
  writer.add ("areas", areas);
  context.store.put (blockFile ("stars", block), writer, context.plan.id);
}

void
writeTriangles (const StepContext& context, std::size_t block, const CandidateLists& candidates,
                const std::vector<Eigen::Vector3f>& smoothed, const std::vector<float>& spacing,
                const CsrLists& stars, const std::vector<std::uint8_t>& open, const CsrLists& far,
                const std::vector<std::uint8_t>& reaches_out)
{
  ArrayWriter writer;
  std::vector<Index> sure_corners, doubtful_corners;
  std::vector<std::uint8_t> sure_marks, doubtful_marks;
  std::vector<float> doubtful_values;
  for (const SureTriangle& sure : candidates.sure) {
    sure_corners.insert (sure_corners.end (), sure.corners.begin (), sure.corners.end ());
    sure_marks.push_back (sure.clockwise);
    sure_marks.push_back (sure.rank);
  }
  for (const Candidate& doubtful : candidates.doubtful) {
    doubtful_corners.insert (doubtful_corners.end (), doubtful.corners.begin (),
                             doubtful.corners.end ());
    doubtful_marks.push_back (doubtful.votes);
    doubtful_marks.push_back (doubtful.clockwise);
    doubtful_values.push_back (doubtful.circumradius_ratio);
    doubtful_values.push_back (doubtful.normal_agreement);
  }
  writer.add ("sure.corners", sure_corners);
  writer.add ("sure.marks", sure_marks);
  writer.add ("doubtful.corners", doubtful_corners);
  writer.add ("doubtful.marks", doubtful_marks);
  writer.add ("doubtful.values", doubtful_values);
  addVectors ("smoothed_normals", smoothed, writer);
  writer.add ("spacing", spacing);
  writeLists ("stars", stars, writer);
  writer.add ("open", open);
  writeLists ("far", far, writer);
  writer.add ("reaches_out", reaches_out);
  context.store.put (blockFile ("triangles", block), writer, context.plan.id);
}

StarSettings
settingsOf (const StepContext& context)
{
  return starSettings ({context.options, context.limits, context.run});
}

} // namespace

void
starsStep (const StepContext& context, std::size_t block)
{
  OwnBlock own_block (context, block);
  if (own_block.isEmpty ()) {
    writeStars (context, block, {}, {});
    return;
  }
  StoredCloud& cloud = own_block.cloud;
  const Index first = own_block.first, last = own_block.last;
  const StarSettings settings = settingsOf (context);
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
        gatherVectors (stored.planes (), "normals", search.block ().points);
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
    const OwnStars made = takeStars (
        endStars (beginStars (positions, neighbors, normals, rows, settings, context.run, &beyond),
                  rows, settings),
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
        samples = takeAreaSamples (places, positions, stars, context.run);
    }
  });
  writeStars (context, block, all, samples);
}

void
trianglesStep (const StepContext& context, std::size_t block)
{
  OwnBlock own_block (context, block);
  if (own_block.isEmpty ()) {
    writeTriangles (context, block, {}, {}, {}, {}, {}, {}, {});
    return;
  }
  StoredCloud& cloud = own_block.cloud;
  const Index first = own_block.first, last = own_block.last;
  const StarSettings settings = settingsOf (context);
  StoredNeighbors stored (context, own_block.outliers, cloud.ranges ());
  Slices stars_before (context.store, context.plan, cloud.ranges (), "stars");

  // Candidates are judged by the stars and normals of their corners; a star without neighbours
  // across holes, by the reach at both ends of its edges; and that is the largest around each.
  const std::vector<Index> own = own_block.points ();
  const CsrLists own_rows = stored.all (own), own_far = stars_before.gatherLists ("far", own);
  const std::vector<Index> corners = joinPoints (first, last, {&own_rows.ids, &own_far.ids});
  CsrLists far = stars_before.gatherLists ("far", corners);
  const std::vector<Index> with_rows = joinPoints (first, last, {&corners, &far.ids});
  CsrLists rows = stored.all (with_rows);
  const std::vector<Index> points = joinPoints (first, last, {&with_rows, &rows.ids});

  const LocalPoints local (points);
  const std::vector<Eigen::Vector3d> positions = cloud.gather (points);
  const std::vector<Eigen::Vector3f> normals = gatherVectors (stored.planes (), "normals", points);
  std::vector<float> spacing = stored.planes ().gather<float> ("spacing", points);
  CsrLists neighbors = local.toPlaces (with_rows, std::move (rows));
  Stars begun;
  begun.neighbors = local.toPlaces (corners, stars_before.gatherLists ("stars", corners));
  begun.far_neighbors = local.toPlaces (corners, std::move (far));
  begun.open = stars_before.gather<std::uint8_t> ("open", points);
  begun.normals = gatherVectors (stars_before, "normals", points);
  begun.reach = stars_before.gather<float> ("reach", points);
  std::vector<Index> corner_places = corners;
  local.toPlaces (corner_places);
  const Rows corner_rows = Rows::of (corner_places);
  StarsInMaking made = resumeStars (std::move (begun), corner_rows);
  leaveOutAcrossHoles (positions, neighbors, normals, corner_rows, settings,
                       settings.reach.gap_ratio, made, context.run);
  const Stars stars = endStars (std::move (made), corner_rows, settings);
  appendRows (stars.far_neighbors, neighbors);
  takeReachAsSpacing (stars.reach, spacing);

  const Index own_first = local.placeOf (first), own_last = own_first + (last - first);
  const std::vector<Eigen::Vector3f> smoothed =
      smoothedNormals (positions, neighbors, stars.normals, corner_rows, context.run);
  CandidateLists candidates =
      findCandidates (positions, stars, smoothed, spacing, Rows::range (own_first, own_last),
                      context.limits.surface.consensus.candidates, context.run);
  for (SureTriangle& sure : candidates.sure)
    for (Index& corner : sure.corners)
      corner = points[corner];
  for (Candidate& doubtful : candidates.doubtful)
    for (Index& corner : doubtful.corners)
      corner = points[corner];
  const OwnStars ended = takeStars (stars, Rows::range (own_first, own_last), local);
  writeTriangles (
      context, block, candidates, {smoothed.begin () + own_first, smoothed.begin () + own_last},
      {spacing.begin () + own_first, spacing.begin () + own_last}, ended.stars, ended.open,
      ended.far, reachesOut (ended.stars, first, Parts (cloud.points (), context.limits.parts)));
}

void
blockStep (const StepContext& context, const std::string& step, std::size_t block)
{
  constexpr std::array<void (*) (const StepContext&, std::size_t), BLOCK_STEPS.size ()> FUNCTIONS{
      neighborsStep, planesStep, starsStep, trianglesStep};
  for (std::size_t i = 0; i < BLOCK_STEPS.size (); ++i)
    if (step == BLOCK_STEPS[i])
      return FUNCTIONS[i](context, block);
  if (step == MESH)
    return meshStep (context, block);
  if (step == FINISH)
    return finishStep (context, block);
  throw std::logic_error ("a block step of this name");
}

} // namespace pcl::floater
