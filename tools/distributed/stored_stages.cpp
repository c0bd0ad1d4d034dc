// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stored_stages.h"

#include "part_files.h"
#include "report/report_cloud.h"
#include "stored_cloud.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// Appends all lists of a block to those of the blocks before it.
// \param rows so many lists, of indices below `limit`
void
appendLists (ArrayFile& file, const std::string& name, std::size_t rows, std::size_t limit,
             CsrLists& all)
{
  if (all.offsets.empty ())
    all.offsets.push_back (0);
  const Index before = all.offsets.back (); // modulo 2^32, as all offsets
  const auto ids = file.read<Index> (name);
  file.requireBelow (ids, limit);
  all.ids.insert (all.ids.end (), ids.begin (), ids.end ());
  const std::size_t first = all.offsets.size ();
  file.append (name + ".ends", 0, rows, all.offsets);
  file.require (std::is_sorted (all.offsets.begin () + static_cast<std::ptrdiff_t> (first),
                                all.offsets.end ()) &&
                (rows == 0 ? 0 : all.offsets.back ()) == ids.size ());
  for (std::size_t r = first; r < all.offsets.size (); ++r)
    all.offsets[r] += before;
}

} // namespace

StoredStages::StoredStages (const StepContext& context, FolderStore& folder,
                            const FolderStore* freed)
    : context_ (context), folder_ (folder),
      freed_ (partsOf (context).count () > 1 ? nullptr : freed), outliers_ (readOutliers (context)),
      ranges_ (blockRanges (context.plan, context.plan.points - outliers_.size ()))
{
}

template <typename Visit>
void
StoredStages::forEachBlock (const char* step, Visit&& visit)
{
  for (std::size_t block = 0; block < context_.plan.blocks; ++block) {
    context_.run.poll ();
    if (context_.options.task_callback) // makes room where memory is limited
      context_.options.task_callback ();
    ArrayFile file = openArrays (context_.store, blockFile (step, block), context_.plan);
    own_ = ranges_.last (block) - ranges_.first (block);
    visit (file, block);
  }
}

void
StoredStages::remove (const char* step) const
{
  if (freed_ != nullptr)
    for (std::size_t block = 0; block < context_.plan.blocks; ++block)
      freed_->remove (blockFile (step, block));
}

Points
StoredStages::points (Report& report)
{
  std::vector<Index> gross_outliers;
  Points points = readPoints (context_.store, POINTS, context_.plan, gross_outliers);
  report.statistics.cloud_points = context_.plan.cloud_size;
  report.statistics.selected_points = context_.plan.selected_points;
  reportGrossOutliers (gross_outliers, report);
  reportPoints (points, report);
  return points;
}

CsrLists
StoredStages::neighborsOf (const std::vector<Index>& points)
{
  return StoredNeighbors (context_, outliers_, ranges_).all (points);
}

LocalPlanes
StoredStages::planes ()
{
  const std::size_t n = ranges_.points ();
  const std::size_t k =
      std::min<std::size_t> (static_cast<std::size_t> (context_.options.neighbors.k), n - 1);
  LocalPlanes planes;
  CsrLists& neighbors = planes.neighbors;
  neighbors.offsets.reserve (n + 1);
  neighbors.ids.reserve (n * k);
  if (outliers_.empty ()) {
    for (std::size_t p = 0; p <= n; ++p)
      neighbors.offsets.push_back (static_cast<Index> (p * k));
    forEachBlock ("neighbors", [&] (ArrayFile& file, std::size_t /*block*/) {
      const auto ids = file.read<Index> ("ids");
      file.require (ids.size () == own_ * k);
      file.requireBelow (ids, n);
      neighbors.ids.insert (neighbors.ids.end (), ids.begin (), ids.end ());
    });
  }
  CsrLists beside;
  beside.offsets.reserve (n + 1);
  forEachBlock ("planes", [&] (ArrayFile& file, std::size_t /*block*/) {
    if (!outliers_.empty ())
      appendLists (file, "renewed", own_, n, neighbors);
    appendLists (file, "beside", own_, n, beside);
  });
  neighbors.findWraps (); // others have fewer entries
  appendRows (beside, neighbors);
  return planes;
}

std::vector<AreaSample>
StoredStages::areaSamples ()
{
  std::vector<AreaSample> samples;
  forEachBlock ("stars",
                [&] (ArrayFile& file, std::size_t /*block*/) { file.append ("areas", samples); });
  return samples;
}

NoiseProbes
StoredStages::noiseProbes ()
{
  NoiseProbes probes;
  forEachBlock ("planes", [&] (ArrayFile& file, std::size_t /*block*/) {
    file.append ("probes.noise", probes.noise);
    file.append ("probes.unevenness", probes.unevenness);
  });
  return probes;
}

LocalGeometry
StoredStages::geometry (LocalPlanes planes, bool with_stars)
{
  const std::size_t n = ranges_.points ();
  LocalGeometry geometry;
  Stars& stars = geometry.stars;
  geometry.spacing.reserve (n);
  stars.normals.reserve (n);
  CsrLists far;
  far.offsets.reserve (n + 1);
  forEachBlock ("stars", [&] (ArrayFile& file, std::size_t /*block*/) {
    file.append ("normals", 0, own_, stars.normals);
  });
  for (const char* step : {"neighbors", "planes", "stars"})
    remove (step); // the neighbours of the planes are in memory by now
  forEachBlock ("triangles", [&] (ArrayFile& file, std::size_t /*block*/) {
    file.append ("spacing", 0, own_, geometry.spacing);
    appendLists (file, "far", own_, n, far);
    if (!with_stars)
      return;
    appendLists (file, "stars", own_, n, stars.neighbors);
    file.append ("open", 0, own_, stars.open);
  });
  geometry.neighbors = std::move (planes.neighbors);
  appendRows (far, geometry.neighbors);
  return geometry;
}

std::vector<float>
StoredStages::spacing ()
{
  std::vector<float> spacing;
  spacing.reserve (ranges_.points ());
  forEachBlock ("triangles", [&] (ArrayFile& file, std::size_t /*block*/) {
    file.append ("spacing", 0, own_, spacing);
  });
  return spacing;
}

std::unique_ptr<PartWork>
StoredStages::parts (const PartsSettings& settings)
{
  return std::make_unique<StoredParts> (context_, folder_, settings, help_);
}

ProposedTriangles
StoredStages::triangles ()
{
  ProposedTriangles proposed;
  CandidateLists& candidates = proposed.candidates;
  candidates.sure_ranks = context_.limits.surface.consensus.candidates.sure_ranks;
  std::size_t sure = 0, doubtful = 0;
  forEachBlock ("triangles", [&] (ArrayFile& file, std::size_t /*block*/) {
    sure += file.count<Triangle> ("sure.corners");
    doubtful += file.count<Triangle> ("doubtful.corners");
  });
  candidates.sure.reserve (sure);
  candidates.doubtful.reserve (doubtful);
  proposed.smoothed_normals.reserve (ranges_.points ());
  forEachBlock ("triangles", [&] (ArrayFile& file, std::size_t block) {
    file.append ("smoothed_normals", 0, own_, proposed.smoothed_normals);
    appendCandidates (file, 0, NONE, ranges_.points (), candidates);
    if (freed_ != nullptr)
      freed_->remove (blockFile ("triangles", block));
  });
  return proposed;
}

} // namespace pcl::floater
