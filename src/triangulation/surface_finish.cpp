// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/surface_finish.h"

#include "triangulation/flips.h"
#include "triangulation/insertion.h"

#include <Eigen/Geometry>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double FOLD_COSINE = -0.5; // 120 degrees between the normals of neighbours

Eigen::Vector3d
areaVector (const std::vector<Eigen::Vector3d>& positions, const Triangle& t)
{
  return (positions[t[1]] - positions[t[0]]).cross (positions[t[2]] - positions[t[0]]);
}

} // namespace

std::vector<MeshEdge>
findFolds (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions)
{
  std::vector<MeshEdge> folds;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index u = mesh.neighbors[t][side];
      if (u == NONE || u < t)
        continue;
      const Eigen::Vector3d a = areaVector (positions, mesh.triangles[t]);
      const Eigen::Vector3d b = areaVector (positions, mesh.triangles[u]);
      if (a.dot (b) < FOLD_COSINE * a.norm () * b.norm ())
        folds.push_back ({t, side});
    }
  return folds;
}

void
finishSurface (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
               std::vector<Eigen::Vector3f>& normals, const Options& options, Statistics& statistics)
{
  orientNormals (mesh, positions, normals);
  const TriangleCost cost (positions, normals);
  insertMissingPoints (mesh, near, cost);
  if (options.flip_edges)
    statistics.flips = flipEdges (mesh, cost);
  statistics.folds = findFolds (mesh, positions).size ();
}

} // namespace floater
} // namespace pcl
