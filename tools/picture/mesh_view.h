// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From where a mesh is seen in a picture.
#pragma once

#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl::floater {
/// Directions of a picture.
struct View
{
  Eigen::Vector3d towards_viewer, up; ///< unit vectors
};

/// The vertices of a mesh.
std::vector<Eigen::Vector3d>
pointsOf (vtkPolyData* mesh);

/// A mesh that faces one way is seen from there, and a sheet is tipped back; up is y, as in scans,
/// or z. A mesh that faces all ways is seen along its axis of least variance; if it is open, its
/// opening is below, because the mean normal points away from it.
View
chooseView (vtkPolyData* mesh, const std::vector<Eigen::Vector3d>& points);

/// Parallel projection, scaled so that the points fill the square picture.
void
aimCamera (vtkRenderer* renderer, const View& view, const std::vector<Eigen::Vector3d>& points);

/// Perspective from a viewpoint, along the mean direction to the points. The vertical is z, or -y
/// as in depth cameras if they look along z.
/// \return whether all points can be seen so
bool
aimFromViewpoint (vtkRenderer* renderer, const Eigen::Vector3d& viewpoint,
                  const std::vector<Eigen::Vector3d>& points);

} // namespace pcl::floater
