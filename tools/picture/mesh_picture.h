// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a mesh and of its parameterization, side by side.
#pragma once

#include "mesh_texture.h"
#include "mesh_view.h"

#include <optional>

namespace pcl::floater {
/// Options of a picture.
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

/// A checkerboard of 32 x 32 squares, of another colour in each of 8 x 8 fields: shows stretch, and
/// what lies where.
ColourImage
makeCheckerboard ();

/// Draws a mesh: front sides blue, back sides orange, boundary edges red, and all edges if there
/// are few. It is seen from the side to which most of it faces.
/// \param height in pixels; mesh and parameterization are as wide each
ColourImage
drawMesh (PictureMesh mesh, std::size_t height, const PictureOptions& options);

} // namespace pcl::floater
