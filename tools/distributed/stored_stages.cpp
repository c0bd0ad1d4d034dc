// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stored_stages.h"

#include "mesh/vertex_stars.h"
#include "report/report_cloud.h"

#include <algorithm>
#include <memory>

namespace pcl::floater {
namespace {
// Appends candidates whose first corners are from `first` to before `last`.
// \param limit all corners are below
template <typename T>
void
appendRange (ArrayFile& file, const char* array, Index first, Index last, std::size_t limit,
             std::vector<T>& all)
{
  const auto candidates = file.read<T> (array);
  const auto find = [&] (Index p) {
    return std::partition_point (candidates.begin (), candidates.end (),
                                 [p] (const T& candidate) { return candidate.corners[0] < p; });
  };
  for (const T& candidate : candidates)
    file.require (isProper (candidate.corners, limit));
  all.insert (all.end (), find (first), find (last));
}

} // namespace

StoredStages::StoredStages (const StepContext& context)
    : context_ (context), outliers_ (readOutliers (context)),
      ranges_ (blockRanges (context.plan, context.plan.points - outliers_.size ()))
{
}

ArrayFile
StoredStages::file (const char* step, std::size_t block) const
{
  return openArrays (context_.store, blockFile (step, block), context_.plan);
}

Slices
StoredStages::slices (const char* step) const
{
  return {context_.store, context_.plan, ranges_, step};
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
  LocalPlanes planes;
  planes.neighbors = neighborsOf (allPoints ());
  return planes;
}

std::vector<AreaSample>
StoredStages::areaSamples ()
{
  std::vector<AreaSample> samples;
  for (std::size_t block = 0; block < ranges_.blocks (); ++block)
    if (!ranges_.isEmpty (block))
      file ("stars", block).append ("areas", samples);
  return samples;
}

NoiseProbes
StoredStages::noiseProbes ()
{
  NoiseProbes probes;
  for (std::size_t block = 0; block < ranges_.blocks (); ++block) {
    if (ranges_.isEmpty (block))
      continue;
    ArrayFile planes = file ("planes", block);
    planes.append ("probes.noise", probes.noise);
    planes.append ("probes.unevenness", probes.unevenness);
  }
  return probes;
}

LocalGeometry
StoredStages::geometry (LocalPlanes planes, bool with_stars)
{
  Slices triangles = slices ("triangles");
  LocalGeometry geometry;
  geometry.spacing = spacing ();
  geometry.stars.normals = normals ();
  if (with_stars) {
    geometry.stars.neighbors = triangles.gatherLists ("stars", allPoints ());
    geometry.stars.open = triangles.gather<std::uint8_t> ("open", allPoints ());
  }
  geometry.neighbors = std::move (planes.neighbors);
  appendRows (triangles.gatherLists ("far", allPoints ()), geometry.neighbors);
  return geometry;
}

std::vector<float>
StoredStages::spacing ()
{
  return slices ("triangles").gather<float> ("spacing", allPoints ());
}

std::vector<Eigen::Vector3f>
StoredStages::normals ()
{
  return slices ("stars").gather<Eigen::Vector3f> ("normals", allPoints ());
}

ProposedTriangles
StoredStages::proposed (Index first, Index last) const
{
  ProposedTriangles some;
  some.candidates.sure_ranks = context_.limits.surface.consensus.candidates.sure_ranks;
  for (std::size_t b = ranges_.blockOf (first); b <= ranges_.blockOf (last - 1); ++b) {
    if (ranges_.isEmpty (b))
      continue;
    ArrayFile triangles = file ("triangles", b);
    appendRange (triangles, "sure", first, last, ranges_.points (), some.candidates.sure);
    appendRange (triangles, "doubtful", first, last, ranges_.points (), some.candidates.doubtful);
  }
  some.smoothed_normals =
      slices ("triangles").gather<Eigen::Vector3f> ("smoothed_normals", pointsFrom (first, last));
  return some;
}

PartSource
StoredStages::parts (const Parts& parts)
{
  const auto propose = [this, &parts] (std::size_t part) {
    const Index first = parts.first (part), last = parts.last (part);
    ProposedTriangles all = proposed (first, last);
    const CsrLists stars = slices ("triangles").gatherLists ("stars", pointsFrom (first, last));
    return ProposedPart{divideCandidates (std::move (all.candidates), first, last,
                                          reachesOut (stars, first, parts)),
                        std::move (all.smoothed_normals)};
  };
  const auto neighbors = [this] () -> NeighborRows {
    const auto of_planes = std::make_shared<StoredNeighbors> (context_, outliers_, ranges_);
    const auto triangles = std::make_shared<Slices> (slices ("triangles"));
    return [of_planes, triangles] (const std::vector<Index>& points) {
      CsrLists rows = of_planes->all (points);
      appendRows (triangles->gatherLists ("far", points), rows);
      return rows;
    };
  };
  return {propose, neighbors};
}

} // namespace pcl::floater
