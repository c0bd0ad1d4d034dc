// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/local_geometry.h"

#include "local/spacing.h"

#include <utility>

namespace pcl
{
namespace floater
{
LocalGeometry
makeLocalGeometry (const Points& points, CsrLists neighbors, const StarSettings& settings,
                   const RunContext& run, const PlaneLimits& planes)
{
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  LocalGeometry geometry;
  geometry.neighbors = std::move (neighbors);
  geometry.spacing = localSpacing (positions, geometry.neighbors, run);
  if (!points.projected.empty ())
    geometry.own_spacing = localSpacing (points.positions, geometry.neighbors, run);
  geometry.stars =
      makeStars (positions, geometry.neighbors,
                 fitTangentPlanes (positions, geometry.neighbors, run, planes), settings, run);
  return geometry;
}

} // namespace floater
} // namespace pcl
