// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary/complex_loop.h"

#include "boundary/gaps.h"
#include "boundary/loop_refinement.h"
#include "complex/complex_mesh.h"
#include "complex/rims.h"

#include <algorithm>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double LARGE_TRIANGLE = 2.0; // circumradius in spacings: beside it there is a gap
} // namespace

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

  // Ragged borders have points beyond the triangles: the ends of gaps tell them.
  std::vector<Index> candidates;
  for (const Gap& gap : findGaps (stars, spacing, LARGE_TRIANGLE))
    candidates.push_back (gap.point);
  Boundary boundary;
  const auto largest = std::max_element (piece_points.begin (), piece_points.end ());
  for (Rim& rim : rims) {
    candidates.insert (candidates.end (), rim.points.begin (), rim.points.end ());
    if (rim.stays && rim.piece == static_cast<Index> (largest - piece_points.begin ()))
      boundary.loop = std::move (rim.points);
  }
  std::sort (candidates.begin (), candidates.end ());
  candidates.erase (std::unique (candidates.begin (), candidates.end ()), candidates.end ());
  boundary.candidates = candidates.size ();
  if (!boundary.loop.empty ())
    refineLoop (positions, stars, spacing, candidates, boundary.loop);
  return boundary;
}

} // namespace floater
} // namespace pcl
