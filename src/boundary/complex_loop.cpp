// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary/complex_loop.h"

#include "complex/complex_mesh.h"
#include "complex/rims.h"

#include <algorithm>
#include <utility>

namespace pcl
{
namespace floater
{
Boundary
complexLoop (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
             const Stars& stars, const std::vector<float>& spacing, int threads)
{
  std::vector<Eigen::Vector3f> normals = stars.normals;
  const SurfaceMesh mesh = makeComplexMesh (positions, near, stars, spacing, threads, normals).mesh;
  Index count = 0;
  const std::vector<Index> pieces = findPieces (mesh, count);
  const std::vector<std::size_t> piece_points = pointsOfPieces (mesh, pieces, count);
  std::vector<Rim> rims = findRims (mesh, pieces, positions, near, normals, spacing);
  Options keep_largest;
  keep_largest.holes = HolePolicy::KEEP_LARGEST;
  chooseRims (rims, piece_points, keep_largest, 1.0);

  Boundary boundary;
  const auto largest = std::max_element (piece_points.begin (), piece_points.end ());
  for (Rim& rim : rims) {
    boundary.candidates += rim.points.size ();
    if (rim.stays && rim.piece == static_cast<Index> (largest - piece_points.begin ()))
      boundary.loop = std::move (rim.points);
  }
  return boundary;
}

} // namespace floater
} // namespace pcl
