// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_rays.h"

#include "core/geometry.h"
#include "mesh/triangle_order.h"

namespace pcl::floater {
TriangleRays::TriangleRays (const std::vector<Triangle>& triangles,
                            const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
    : triangles_ (triangles), positions_ (positions),
      order_ (orderByPoints (triangles, positions.size ())),
      tree_ ((order_.size () + GROUP - 1) / GROUP,
             [this] (std::size_t group) { return boxOf (group); }, run)
{
}

Eigen::AlignedBox3d
TriangleRays::boxOf (std::size_t group) const
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = group * GROUP; i < std::min (order_.size (), (group + 1) * GROUP); ++i)
    for (const Index p : triangles_[order_[i]])
      box.extend (positions_[p]);
  return box;
}

// The ray hits if the volumes of the tetrahedra of ray and edges have one sign. Both triangles of
// an edge compute exactly opposite volumes, so no ray slips between them.
double
TriangleRays::hit (Index t, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const
{
  const Eigen::Vector3d a = positions_[triangles_[t][0]] - origin;
  const Eigen::Vector3d b = positions_[triangles_[t][1]] - origin;
  const Eigen::Vector3d c = positions_[triangles_[t][2]] - origin;
  const double ab = direction.dot (a.cross (b));
  const double bc = direction.dot (b.cross (c));
  const double ca = direction.dot (c.cross (a));
  const bool is_front = ab >= 0.0 && bc >= 0.0 && ca >= 0.0;
  if (!is_front && !(ab <= 0.0 && bc <= 0.0 && ca <= 0.0))
    return 0.0;
  const Eigen::Vector3d normal = areaVector (a, b, c);
  const double slope = direction.dot (normal);
  return slope != 0.0 ? std::max (0.0, a.dot (normal) / slope) : 0.0;
}

} // namespace pcl::floater
