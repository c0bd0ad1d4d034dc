// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/chart_mesh.h"

#include "core/order_statistics.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// The boundary of a disc; empty for other meshes.
std::vector<Index>
discLoop (const TriangleMesh& mesh, std::size_t vertices)
{
  std::size_t inner_sides = 0;
  for (const auto& neighbors : mesh.neighbors)
    for (const Index other : neighbors)
      inner_sides += other != NONE ? 1 : 0;
  const std::size_t edges = 3 * mesh.triangles.size () - inner_sides / 2;
  if (vertices + mesh.triangles.size () != edges + 1)
    return {};
  std::vector<std::vector<Index>> loops = boundaryLoops (mesh, 1);
  return loops.size () == 1 ? std::move (loops.front ()) : std::vector<Index> ();
}

} // namespace

ChartMesh
makeChartMesh (const std::vector<Triangle>& triangles, const std::vector<Index>& chart,
               const std::vector<Eigen::Vector3d>& positions)
{
  ChartMesh result;
  result.points.reserve (3 * chart.size ());
  for (const Index t : chart)
    result.points.insert (result.points.end (), triangles[t].begin (), triangles[t].end ());
  sortUnique (result.points);
  result.points.shrink_to_fit ();
  result.positions.reserve (result.points.size ());
  for (const Index p : result.points)
    result.positions.push_back (positions[p]);
  result.mesh.triangles.reserve (chart.size ());
  for (const Index t : chart) {
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = static_cast<Index> (
          std::lower_bound (result.points.begin (), result.points.end (), triangles[t][i]) -
          result.points.begin ());
    result.mesh.triangles.push_back (corners);
  }
  if (result.mesh.connect (result.points.size (), 1))
    result.loop = discLoop (result.mesh, result.points.size ());
  return result;
}

} // namespace pcl::floater
