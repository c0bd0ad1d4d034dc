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

namespace {
struct FlatTriangle
{
  std::array<Eigen::Vector2d, 3> corners;
};

// The longest edge is on the first axis.
FlatTriangle
layFlat (const std::array<Eigen::Vector3d, 3>& place, double least_length)
{
  std::size_t apex = 0; // opposite to the longest edge
  double longest = -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = (place[(i + 2) % 3] - place[(i + 1) % 3]).norm ();
    if (length > longest) {
      longest = length;
      apex = i;
    }
  }
  const std::size_t from = (apex + 1) % 3, to = (apex + 2) % 3;
  const double base = std::max (longest, least_length);
  const Eigen::Vector3d along = place[to] - place[from], up = place[apex] - place[from];
  const double x = longest > 0.0 ? up.dot (along) / longest : 0.0;
  const double height = longest > 0.0 ? along.cross (up).norm () / longest : 0.0;
  FlatTriangle flat;
  flat.corners[from] = Eigen::Vector2d::Zero ();
  flat.corners[to] = {base, 0.0};
  flat.corners[apex] = {x, std::max (height, LEAST_HEIGHT * base)};
  return flat;
}

} // namespace

RestShapes
makeRestShapes (const ChartMesh& chart)
{
  RestShapes result;
  const auto place = [&chart] (const Triangle& t) -> std::array<Eigen::Vector3d, 3> {
    return {chart.positions[t[0]], chart.positions[t[1]], chart.positions[t[2]]};
  };
  double longest = 0.0;
  for (const Triangle& t : chart.mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      longest =
          std::max (longest, (chart.positions[t[i]] - chart.positions[t[(i + 1) % 3]]).norm ());
  const double least = longest > 0.0 ? LEAST_HEIGHT * longest * LEAST_HEIGHT : 1.0;
  result.shapes.reserve (chart.mesh.triangles.size ());
  for (const Triangle& t : chart.mesh.triangles) {
    const FlatTriangle flat = layFlat (place (t), least);
    Eigen::Matrix2d edges;
    edges << flat.corners[1] - flat.corners[0], flat.corners[2] - flat.corners[0];
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
