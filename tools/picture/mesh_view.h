// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From where a mesh is seen in a picture.
#pragma once

#include "canvas.h"
#include "cloud.h"

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>

namespace pcl::floater {
/// A mesh with the vertices that its triangles use. They are moved to the origin, and scaled so
/// that the longest side of their box is 2.
struct PictureMesh
{
  std::vector<Eigen::Vector3d> points;
  Triangles triangles;                      ///< at least one
  std::vector<Eigen::Vector2d> coordinates; ///< of a texture, parallel to the points; may be empty
  Eigen::Vector3d centre;                   ///< what has become the origin
  double scale;                             ///< factor
};

/// Reads a mesh from a .vtk or .ply file, with texture coordinates if it has some. Triangles with a
/// vertex that is not finite are left out.
/// \throw ReadError if it cannot be read or has no triangles
PictureMesh
readPictureMesh (const std::filesystem::path& path);

/// Directions of a picture.
struct View
{
  Eigen::Vector3d towards_viewer, up; ///< unit vectors
};

/// Where points are on a canvas.
struct Camera
{
  Eigen::Matrix3d axes;   ///< its rows are right, up and towards the viewer
  Eigen::Vector3d origin; ///< the middle of the picture; in perspective, the viewer
  double half_side;       ///< of the picture; in perspective, at the distance 1
  bool is_perspective;

  Spot project (const Eigen::Vector3d& point, double side) const
  {
    const Eigen::Vector3d p = axes * (point - origin);
    const double weight = is_perspective ? -1.0 / p.z () : 1.0;
    const double pixels = 0.5 * side / half_side * weight;
    return {0.5 * side + pixels * p.x (), 0.5 * side - pixels * p.y (),
            is_perspective ? weight : p.z (), weight};
  }
};

/// A mesh that faces one way is seen from there, and a sheet is tipped back; up is y, as in scans,
/// or z. A mesh that faces all ways is seen along its axis of least variance; if it is open, its
/// opening is below, because the mean normal points away from it.
View
chooseView (const PictureMesh& mesh);

/// Parallel projection, scaled so that the points fill the square picture.
Camera
aimCamera (const View& view, const std::vector<Eigen::Vector3d>& points);

/// Perspective from a viewpoint, along the mean direction to the points. Up is z; where that is
/// nearly the direction, y, or -y as in depth cameras if they look along z.
/// \return nothing if not all points are within 60 degrees of that direction
std::optional<Camera>
aimFromViewpoint (const Eigen::Vector3d& viewpoint, const std::vector<Eigen::Vector3d>& points);

} // namespace pcl::floater
