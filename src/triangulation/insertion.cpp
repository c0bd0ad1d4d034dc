// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/insertion.h"

namespace pcl
{
namespace floater
{
namespace
{
// The triangle around p's neighbours whose split at p adds the least cost; NONE if there is none.
Index
cheapestTriangle (const SurfaceMesh& mesh, Row neighbors, Index p, const TriangleCost& cost,
                  std::vector<Index>& fan_triangles)
{
  Index best = NONE;
  double best_added = 0.0;
  for (Index q : neighbors) {
    mesh.fan (q, fan_triangles);
    for (Index t : fan_triangles) {
      const Triangle& corners = mesh.triangles[t];
      const double added = cost (p, corners[1], corners[2]) + cost (p, corners[2], corners[0]) +
                           cost (p, corners[0], corners[1]) - cost (corners);
      if (best == NONE || added < best_added) {
        best = t;
        best_added = added;
      }
    }
  }
  return best;
}

} // namespace

std::size_t
insertMissingPoints (SurfaceMesh& mesh, const FlatLists& near, const TriangleCost& cost)
{
  std::vector<Index> missing;
  for (Index p = 0; p < mesh.triangle_of.size (); ++p)
    if (mesh.triangle_of[p] == NONE)
      missing.push_back (p);
  std::vector<Index> fan_triangles;
  std::size_t inserted = 0;
  for (bool progress = true; progress && !missing.empty ();) {
    progress = false;
    std::vector<Index> left;
    for (Index p : missing) {
      const Index t = cheapestTriangle (mesh, near.row (p), p, cost, fan_triangles);
      if (t == NONE) {
        left.push_back (p);
        continue;
      }
      mesh.split (t, p);
      ++inserted;
      progress = true;
    }
    missing.swap (left);
  }
  return inserted;
}

void
orientMissingNormals (const SurfaceMesh& mesh, const FlatLists& near,
                      std::vector<Eigen::Vector3f>& normals)
{
  for (Index p = 0; p < normals.size (); ++p) {
    if (mesh.triangle_of[p] != NONE)
      continue;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero ();
    for (Index q : near.row (p))
      if (mesh.triangle_of[q] != NONE)
        sum += normals[q];
    if (normals[p].dot (sum) < 0.0F)
      normals[p] = -normals[p];
  }
}

} // namespace floater
} // namespace pcl
