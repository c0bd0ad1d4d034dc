// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/boundary_loops.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl::floater {
namespace {
constexpr std::size_t WIDTH_POINTS = 256; // maximum for the width: its time is quadratic

double
widthOf (const std::vector<Index>& points, const std::vector<Eigen::Vector3d>& positions)
{
  const std::size_t step = (points.size () + WIDTH_POINTS - 1) / WIDTH_POINTS;
  double sqr_width = 0.0;
  for (std::size_t i = 0; i < points.size (); i += step)
    for (std::size_t j = 0; j < i; j += step)
      sqr_width =
          std::max (sqr_width, (positions[points[i]] - positions[points[j]]).squaredNorm ());
  return std::sqrt (sqr_width);
}

} // namespace

void
measureLoop (BoundaryLoop& loop, const std::vector<Eigen::Vector3d>& positions,
             const std::vector<float>& spacing)
{
  const std::size_t count = loop.points.size ();
  loop.length = loop.spacing = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Index p = loop.points[i];
    loop.length += (positions[loop.points[i + 1 == count ? 0 : i + 1]] - positions[p]).norm ();
    loop.spacing += spacing[p];
  }
  loop.spacing /= static_cast<double> (std::max<std::size_t> (1, count));
  loop.width = widthOf (loop.points, positions);
}

std::vector<BoundaryLoop>
findBoundaryLoops (const TriangleMesh& mesh, const MeshComponents& components,
                   const std::vector<Eigen::Vector3d>& positions, const std::vector<float>& spacing,
                   const RunContext& run)
{
  std::vector<BoundaryLoop> loops;
  ProgressLoop progress (run);
  for (std::vector<Index>& points : boundaryLoops (mesh, run)) {
    progress.next ();
    BoundaryLoop loop;
    loop.component = components.of_triangle[mesh.triangle_of[points.front ()]];
    loop.points = std::move (points);
    measureLoop (loop, positions, spacing);
    loops.push_back (std::move (loop));
  }
  return loops;
}

} // namespace pcl::floater
