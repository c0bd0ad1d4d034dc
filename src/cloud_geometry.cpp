// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_geometry.h"

#include "local/star_agreement.h"
#include "points/outliers.h"
#include "report_cloud.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
StarSettings
starSettings (const Options& options, const Limits& limits)
{
  StarSettings settings;
  settings.filter_sheets = options.filter_sheets;
  settings.with_offsets = asksForDisc (options);
  const Neighborhood kind = options.neighbors.kind;
  settings.reach_beyond =
      !asksForDisc (options) && kind != Neighborhood::BALL && kind != Neighborhood::BALL_DELAUNAY;
  settings.limits = limits.sheets;
  settings.reach = limits.reach;
  return settings;
}

// Cloud indices of the points that stand for those of a given loop: of equal points, one stands for
// all. Ascending.
std::vector<Index>
pointsOfLoop (const Points& points, std::vector<Index> loop)
{
  for (Index& index : loop) {
    const auto duplicate = std::lower_bound (points.duplicates.begin (), points.duplicates.end (),
                                             std::array<Index, 2>{index, 0});
    if (duplicate != points.duplicates.end () && (*duplicate)[0] == index)
      index = (*duplicate)[1];
  }
  std::sort (loop.begin (), loop.end ());
  return loop;
}

} // namespace

NeighborSettings
neighborSettings (const Options& options, NeighborSearch* search)
{
  // The solver of a disc takes so much memory that blocks save nothing.
  return {options.neighbors, asksForDisc (options) ? 1 : options.blocks, search};
}

void
removeOutliers (Points& points, CsrLists& neighbors, const NeighborSettings& settings,
                const Request& request, Report& report)
{
  const std::vector<Index> given = pointsOfLoop (points, request.options.boundary.loop);
  std::vector<Index> outliers =
      findOutliers (points.positions, neighbors, request.run, request.limits.outliers);
  const auto is_given = [&] (Index p) {
    return std::binary_search (given.begin (), given.end (), points.cloud_index[p]);
  };
  outliers.erase (std::remove_if (outliers.begin (), outliers.end (), is_given), outliers.end ());
  if (outliers.empty ())
    return;
  const std::vector<Index> cloud_indices = removePoints (points, outliers);
  reportOutliers (cloud_indices, points.size (), report);
  neighbors = renewNeighbors (points, outliers, neighbors, settings, request.run);
}

LocalGeometry
makeGeometry (const Points& points, CsrLists neighbors, const std::optional<KdTree>& tree,
              const Request& request, Noise& noise)
{
  const Limits& limits = request.limits;
  const RunContext& run = request.run;
  if (request.options.denoise)
    noise = measureNoise (points.positions, neighbors, limits.noise, run);
  run.beginStage (Stage::STARS);
  LocalGeometry geometry =
      makeLocalGeometry (points, std::move (neighbors), starSettings (request.options, limits), run,
                         limits.planes, tree ? &*tree : nullptr);
  noise.is_strong =
      noise.noisy_points > 0 && isStrong (noise, starAgreement (geometry.stars, run), limits.noise);
  return geometry;
}

LocalGeometry
projectNoise (Points& points, LocalGeometry geometry, const Noise& noise,
              const NeighborSettings& settings, const Request& request)
{
  const Limits& limits = request.limits;
  const RunContext& run = request.run;
  points.projected =
      projectNoisyPoints (points.positions, geometry.neighbors, noise, limits.noise, run);
  geometry = {};
  run.beginStage (Stage::NEIGHBORS);
  std::optional<KdTree> tree;
  CsrLists neighbors = findNeighbors (points, settings, run, &tree);
  run.beginStage (Stage::STARS);
  return makeLocalGeometry (points, std::move (neighbors), starSettings (request.options, limits),
                            run, limits.planes, tree ? &*tree : nullptr);
}

} // namespace floater
} // namespace pcl
