// SPDX-License-Identifier: GPL-3.0-or-later
// From the lifted triangulation to the final surface.
#pragma once

#include "common/problem.h"
#include "triangulation/surface_mesh.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// What the last stage did, and why it gave up if it did.
struct SurfaceFinish
{
  std::size_t flips = 0;
  std::size_t moves = 0;       ///< vertices taken out and put back elsewhere
  std::vector<MeshEdge> folds; ///< edges left more than 120 degrees apart
  Problem problem;             ///< NOT_A_DISC
};

/// Inserts points that have no triangle, flips edges where the options ask for it, and repairs the
/// folds that are left. \param normals of points that are vertices get the side of the mesh
SurfaceFinish
finishSurface (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const FlatLists& near, std::vector<Eigen::Vector3f>& normals,
               const Options& options);

/// The same for a surface that was laid out as a disc. Where flips leave more than 3 % of all edges
/// folded, it has been pressed into a disc that it is not, and nothing can mend it.
SurfaceFinish
finishDisc (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
            std::vector<Eigen::Vector3f>& normals, const Options& options);

} // namespace floater
} // namespace pcl
