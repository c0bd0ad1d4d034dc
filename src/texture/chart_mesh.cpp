// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/chart_mesh.h"

#include "core/geometry.h"
#include "core/order_statistics.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

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

FlatTriangle
layFlat (const std::array<Eigen::Vector3d, 3>& place, double least_height)
{
  FlatTriangle flat{{}, -1.0};
  std::size_t apex = 0; // opposite to the longest edge
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = (place[(i + 2) % 3] - place[(i + 1) % 3]).norm ();
    if (length > flat.longest) {
      flat.longest = length;
      apex = i;
    }
  }
  const std::size_t from = (apex + 1) % 3, to = (apex + 2) % 3;
  const double scale = flat.longest > 0.0 ? 1.0 / flat.longest : 0.0;
  const Eigen::Vector3d along = scale * (place[to] - place[from]);
  const Eigen::Vector3d up = scale * (place[apex] - place[from]);
  flat.corners[from] = Eigen::Vector2d::Zero ();
  flat.corners[to] = Eigen::Vector2d::UnitX ();
  flat.corners[apex] = {up.dot (along), std::max (along.cross (up).norm (), least_height)};
  return flat;
}

RestShapes
makeRestShapes (const ChartMesh& chart)
{
  RestShapes result;
  std::vector<FlatTriangle> all;
  all.reserve (chart.mesh.triangles.size ());
  double longest = 0.0;
  for (const Triangle& t : chart.mesh.triangles) {
    all.push_back (layFlat ({chart.positions[t[0]], chart.positions[t[1]], chart.positions[t[2]]},
                            LEAST_HEIGHT));
    longest = std::max (longest, all.back ().longest);
  }
  const double least = longest > 0.0 ? LEAST_HEIGHT * longest : 1.0;
  result.shapes.reserve (all.size ());
  for (const FlatTriangle& flat : all) {
    Eigen::Matrix2d edges;
    edges << flat.corners[1] - flat.corners[0], flat.corners[2] - flat.corners[0];
    edges *= std::max (flat.longest, least);
    result.shapes.push_back ({edges.inverse (), 0.5 * edges.determinant ()});
    result.area += result.shapes.back ().area;
  }
  const double scale = std::sqrt (result.area);
  for (RestShape& shape : result.shapes) {
    shape.to_unit *= scale;
    shape.area /= result.area;
  }
  return result;
}

} // namespace pcl::floater
