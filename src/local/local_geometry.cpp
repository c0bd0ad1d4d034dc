// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/local_geometry.h"

#include "local/spacing.h"
#include "local/tangent_planes.h"

#include <utility>

namespace pcl
{
namespace floater
{
LocalGeometry
makeLocalGeometry (const std::vector<Eigen::Vector3d>& positions, CsrLists neighbors,
                   const StarSettings& settings, const RunContext& run)
{
  LocalGeometry geometry;
  geometry.neighbors = std::move (neighbors);
  geometry.spacing = localSpacing (positions, geometry.neighbors, run);
  geometry.stars = makeStars (positions, geometry.neighbors,
                              fitTangentPlanes (positions, geometry.neighbors, run), settings, run);
  return geometry;
}

} // namespace floater
} // namespace pcl
