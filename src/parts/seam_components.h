// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The components of a mesh in parts.
#pragma once

#include "mesh/triangle_mesh.h"
#include "parts/joined_points.h"
#include "parts/near_triangles.h"

#include <vector>

namespace pcl::floater {
/// Components in the order of their smallest points.
struct SeamComponents
{
  std::vector<std::size_t> points;          ///< number of points of each component
  std::vector<Index> first;                 ///< the smallest point of each
  std::vector<Index> of_point;              ///< of each point of a zone, NONE without a triangle;
                                            ///< undefined for other points
  std::vector<std::vector<Index>> of_inner; ///< of the components of the inner triangles of each
                                            ///< part

  std::size_t count () const { return points.size (); }
};

/// Joins the components of the parts.
/// \param points of zones, and of inner triangles near them: the latter are partial
/// \param mesh   zone triangles, then the near ones; corners are indices of `points`
/// \param seam   number of zone triangles
SeamComponents
joinComponents (const JoinedPoints& points, const TriangleMesh& mesh, std::size_t seam,
                const NearTriangles& near, const std::vector<InnerCheck>& checks);

} // namespace pcl::floater
