// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/local_geometry.h"

#include "local/spacing.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace pcl
{
namespace floater
{
LocalGeometry
makeLocalGeometry (const Points& points, CsrLists neighbors, const StarSettings& settings,
                   const RunContext& run, const PlaneLimits& planes, const KdTree* known)
{
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  LocalGeometry geometry;
  geometry.neighbors = std::move (neighbors);
  geometry.spacing = localSpacing (positions, geometry.neighbors, run);
  if (!points.projected.empty ())
    geometry.own_spacing = localSpacing (points.positions, geometry.neighbors, run);
  if (!settings.reach_beyond) {
    geometry.stars =
        makeStars (positions, geometry.neighbors,
                   fitTangentPlanes (positions, geometry.neighbors, run, planes), settings, run);
    return geometry;
  }
  std::optional<KdTree> own_tree;
  const KdTree& tree = known != nullptr ? *known : own_tree.emplace (positions, run);
  const BesideLines beside = findBesideLines (positions, geometry.neighbors, geometry.spacing, tree,
                                              planes.least_aspect, settings.reach, run);
  appendRows (beside.neighbors, geometry.neighbors);
  const BeyondNeighbors beyond{tree, geometry.spacing, beside, settings.reach};
  geometry.stars = makeStars (positions, geometry.neighbors,
                              fitTangentPlanes (positions, geometry.neighbors, run, planes),
                              settings, run, &beyond);
  appendRows (geometry.stars.far_neighbors, geometry.neighbors);
  geometry.stars.far_neighbors = {};
  for (std::size_t p = 0; p < positions.size (); ++p)
    geometry.spacing[p] =
        std::max (geometry.spacing[p], REACH_AS_SPACING * geometry.stars.reach[p]);
  return geometry;
}

} // namespace floater
} // namespace pcl
