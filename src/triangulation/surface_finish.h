// SPDX-License-Identifier: GPL-3.0-or-later
// From the lifted triangulation to the final surface.
#pragma once

#include "triangulation/surface_mesh.h"

#include <pcl/surface/floater/report.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// Inserts points that have no triangle, flips edges where the options ask for it, and repairs the
/// folds that are left. Books flips and folds.
void
finishSurface (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
               std::vector<Eigen::Vector3f>& normals, const Options& options, Statistics& statistics);

} // namespace floater
} // namespace pcl
