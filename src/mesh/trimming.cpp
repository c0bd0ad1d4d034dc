// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/trimming.h"

#include "mesh/triangle_removal.h"

#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// An edge is as long as the limit up to rounding; positions are in a box of diagonal 1.
constexpr double ROUNDING = 1e-15;

bool
isTooLong (Index p, Index q, const Points& points, const std::vector<float>& spacing,
           const TrimmingOptions& options)
{
  const double length = (points.positions[q] - points.positions[p]).norm () - ROUNDING;
  const double unit = 0.5 * (static_cast<double> (spacing[p]) + spacing[q]);
  return (options.maximum_edge_length > 0.0 &&
          length > options.maximum_edge_length / points.scale) ||
         (options.maximum_edge_ratio > 0.0 && length > options.maximum_edge_ratio * unit);
}

void
cutLongEdges (TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
              const TrimmingOptions& options, const RunContext& run)
{
  std::vector<std::uint8_t> is_removed (mesh.triangles.size (), 0);
  ProgressLoop progress (run);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    progress.next ();
    const Triangle& triangle = mesh.triangles[t];
    for (std::size_t i = 0; i < 3; ++i)
      if (isTooLong (triangle[i], triangle[(i + 1) % 3], points, spacing, options))
        is_removed[t] = 1;
  }
  removeTriangles (mesh, std::move (is_removed), run);
}

} // namespace

bool
asksForTrimming (const TrimmingOptions& options)
{
  return options.maximum_edge_length > 0.0 || options.maximum_edge_ratio > 0.0 ||
         options.minimum_component_size > 0;
}

Trimming
trimMesh (TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
          const TrimmingOptions& options, const RunContext& run)
{
  Trimming done;
  const std::size_t triangles = mesh.triangles.size ();
  const std::vector<Index> before = mesh.triangle_of;
  cutLongEdges (mesh, points, spacing, options, run);
  if (options.minimum_component_size > 0)
    done.components = removeSmallComponents (
        mesh, static_cast<std::size_t> (options.minimum_component_size), run);
  done.triangles = triangles - mesh.triangles.size ();
  for (Index p = 0; p < before.size (); ++p)
    if (before[p] != NONE && mesh.triangle_of[p] == NONE)
      done.points.push_back (p);
  return done;
}

} // namespace floater
} // namespace pcl
