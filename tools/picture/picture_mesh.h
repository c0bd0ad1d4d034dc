// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh as it is drawn.
#pragma once

#include "cloud.h"

#include <filesystem>

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

} // namespace pcl::floater
