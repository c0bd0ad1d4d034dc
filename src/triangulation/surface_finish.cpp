// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/surface_finish.h"

#include "triangulation/flips.h"
#include "triangulation/fold_repair.h"
#include "triangulation/insertion.h"

namespace pcl
{
namespace floater
{
void
finishSurface (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
               std::vector<Eigen::Vector3f>& normals, const Options& options, Statistics& statistics)
{
  orientNormals (mesh, positions, normals);
  const TriangleCost cost (positions, normals);
  insertMissingPoints (mesh, near, cost);
  if (!options.flip_edges) {
    statistics.folds = findFolds (mesh, positions).size ();
    return;
  }
  statistics.flips = flipEdges (mesh, cost);
  orientNormals (mesh, positions, normals);
  statistics.folds = repairFolds (mesh, positions, normals);
}

} // namespace floater
} // namespace pcl
