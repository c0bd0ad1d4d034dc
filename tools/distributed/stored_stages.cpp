// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stored_stages.h"

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

StoredStages::StoredStages (const StepContext& context, const FolderStore* freed)
    : context_ (context), freed_ (freed), outliers_ (readOutliers (context)),
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
    file.append ("spacing", 0, own_, planes.spacing);
    file.append ("normals", 0, own_, planes.normals);
  });
  for (const char* step : {"neighbors", "planes"})
    remove (step);
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

Stars
StoredStages::begunStars ()
{
  const std::size_t n = ranges_.points ();
  Stars stars;
  forEachBlock ("stars", [&] (ArrayFile& file, std::size_t /*block*/) {
    appendLists (file, "stars", own_, n, stars.neighbors);
    appendLists (file, "far", own_, n, stars.far_neighbors);
    file.append ("open", 0, own_, stars.open);
    file.append ("normals", 0, own_, stars.normals);
    file.append ("reach", 0, own_, stars.reach);
  });
  remove ("stars");
  return stars;
}

} // namespace pcl::floater
