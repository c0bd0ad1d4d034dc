// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a mesh and of its parameterization, side by side.
#pragma once

#include "mesh_texture.h"

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

struct PictureOptions
{
  std::optional<PictureMesh> parameterization; ///< mesh in the plane whose edges are drawn beside
                                               ///< the mesh
  std::optional<ColourImage> texture;          ///< image on the mesh, by its texture coordinates;
                                               ///< beside it, the same in the square of the texture
  bool flat_shading = false;                   ///< one shade for each triangle, which shows bumps
  std::optional<Eigen::Vector3d> viewpoint; ///< from where the mesh is seen, if it lies within 60
                                            ///< degrees of one direction from there
};

/// Draws a mesh: front sides blue, back sides orange, boundary edges red, and all edges if there
/// are few. It is seen from the side to which most of it faces.
/// \param height in pixels; mesh and parameterization are as wide each
ColourImage
drawMesh (PictureMesh mesh, std::size_t height, const PictureOptions& options);

} // namespace pcl::floater
