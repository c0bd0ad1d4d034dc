// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_steps.h"

#include "cloud_geometry.h"
#include "known_stages.h"
#include "local/smoothed_normals.h"
#include "stored_cloud.h"

#include <algorithm>
#include <stdexcept>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double HALO = 4.0;           // width, see BlockCutter: stars look up to 40 spacings ahead
constexpr Index STARS_AT_ONCE = 65536; // these are made again if one of them leaves the block

// The lists of some of the own points, by their numbers in the working set.
struct OwnStars
{
  CsrLists stars, far;
  std::vector<std::uint8_t> open;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> reach;
};

OwnStars
takeStars (const Stars& stars, Index first, Index last, const LocalPoints& local)
{
  OwnStars own;
  appendLists (stars.neighbors, first, last, own.stars);
  appendLists (stars.far_neighbors, first, last, own.far);
  local.toPoints (own.stars.ids);
  local.toPoints (own.far.ids);
  own.open.assign (stars.open.begin () + first, stars.open.begin () + last);
  own.normals.assign (stars.normals.begin () + first, stars.normals.begin () + last);
  own.reach.assign (stars.reach.begin () + first, stars.reach.begin () + last);
  return own;
}

void
appendStars (const OwnStars& more, OwnStars& all)
{
  appendLists (more.stars, all.stars);
  appendLists (more.far, all.far);
  all.open.insert (all.open.end (), more.open.begin (), more.open.end ());
  all.normals.insert (all.normals.end (), more.normals.begin (), more.normals.end ());
  all.reach.insert (all.reach.end (), more.reach.begin (), more.reach.end ());
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
                const CsrLists& stars, const std::vector<std::uint8_t>& open, const CsrLists& far)
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
  const std::vector<Index> outliers = readOutliers (context);
  StoredCloud cloud (context, outliers, false);
  const Index first = cloud.ranges ().first (block), last = cloud.ranges ().last (block);
  if (first == last) {
    writeStars (context, block, {}, {});
    return;
  }
  const StarSettings settings = settingsOf (context);
  StoredNeighbors stored (context, outliers, cloud.ranges ());
  const std::vector<Index> own = pointsFrom (first, last);
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

  BlockSearch search (cloud.cutter (), block, context.run, HALO);
  std::vector<OwnStars> parts ((last - first + STARS_AT_ONCE - 1) / STARS_AT_ONCE);
  std::vector<std::uint8_t> is_done (parts.size (), 0);
  std::vector<AreaSample> samples;
  bool are_sampled = false;
  do {
    takeIn (own, all_lists, cloud, search);
    const LocalPoints local (search.block ().points);
    const std::vector<Eigen::Vector3d>& positions = search.block ().positions;
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
    for (std::size_t part = 0; part < parts.size (); ++part) {
      if (is_done[part] != 0)
        continue;
      const Index begin = own_first + static_cast<Index> (part) * STARS_AT_ONCE;
      const Index end = std::min (begin + STARS_AT_ONCE, search.ownLast ());
      const Rows rows = Rows::range (begin, end);
      StarsInMaking made =
          beginStars (positions, neighbors, normals, rows, settings, context.run, &beyond);
      if (search.hasLeft ())
        continue;
      parts[part] = takeStars (endStars (std::move (made), rows, settings), begin, end, local);
      is_done[part] = 1;
    }
    if (!are_sampled) {
      std::vector<Index> places = centres;
      local.toPlaces (places);
      const Stars stars =
          makeStarsOf (places, positions, neighbors, normals, settings, context.run, &beyond);
      are_sampled = !search.hasLeft ();
      if (are_sampled)
        samples = takeAreaSamples (places, positions, stars, context.run);
    }
  } while (search.widen ());
  OwnStars all;
  for (const OwnStars& part : parts)
    appendStars (part, all);
  writeStars (context, block, all, samples);
}

void
trianglesStep (const StepContext& context, std::size_t block)
{
  const std::vector<Index> outliers = readOutliers (context);
  StoredCloud cloud (context, outliers, false);
  const Index first = cloud.ranges ().first (block), last = cloud.ranges ().last (block);
  if (first == last) {
    writeTriangles (context, block, {}, {}, {}, {}, {}, {});
    return;
  }
  const StarSettings settings = settingsOf (context);
  StoredNeighbors stored (context, outliers, cloud.ranges ());
  Slices stars_before (context.store, context.plan, cloud.ranges (), "stars");

  // Candidates are judged by the stars and normals of their corners; a star without neighbours
  // across holes, by the reach at both ends of its edges; and that is the largest around each.
  const std::vector<Index> own = pointsFrom (first, last);
  std::vector<Index> corners = own;
  append (stored.all (own).ids, corners);
  append (stars_before.gatherLists ("far", own).ids, corners);
  sortUnique (corners);
  const CsrLists far = stars_before.gatherLists ("far", corners);
  std::vector<Index> with_rows = corners;
  append (far.ids, with_rows);
  sortUnique (with_rows);
  const CsrLists rows = stored.all (with_rows);
  std::vector<Index> points = with_rows;
  append (rows.ids, points);
  sortUnique (points);

  const LocalPoints local (points);
  const std::vector<Eigen::Vector3d> positions = cloud.gather (points);
  const std::vector<Eigen::Vector3f> normals = gatherVectors (stored.planes (), "normals", points);
  std::vector<float> spacing = stored.planes ().gather<float> ("spacing", points);
  CsrLists neighbors = local.toPlaces (with_rows, rows);
  Stars begun;
  begun.neighbors = local.toPlaces (corners, stars_before.gatherLists ("stars", corners));
  begun.far_neighbors = local.toPlaces (corners, far);
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
  const OwnStars ended = takeStars (stars, own_first, own_last, local);
  writeTriangles (context, block, candidates,
                  {smoothed.begin () + own_first, smoothed.begin () + own_last},
                  {spacing.begin () + own_first, spacing.begin () + own_last}, ended.stars,
                  ended.open, ended.far);
}

void
blockStep (const StepContext& context, const std::string& step, std::size_t block)
{
  constexpr std::array<void (*) (const StepContext&, std::size_t), BLOCK_STEPS.size ()> FUNCTIONS{
      neighborsStep, planesStep, starsStep, trianglesStep};
  for (std::size_t i = 0; i < BLOCK_STEPS.size (); ++i)
    if (step == BLOCK_STEPS[i])
      return FUNCTIONS[i](context, block);
  throw std::logic_error ("a block step of this name");
}

} // namespace floater
} // namespace pcl
