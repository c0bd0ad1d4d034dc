// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a mesh and of its parameterization, side by side.
#pragma once

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace pcl::floater {
/// Options of a picture.
struct PictureOptions
{
  vtkPolyData* parameterization =
      nullptr;                       ///< mesh in the plane whose edges are drawn beside the mesh
  vtkImageData* texture = nullptr;   ///< image on the mesh, by its texture coordinates; beside it,
                                     ///< the same in the square of the texture
  bool flat_shading = false;         ///< one shade for each triangle, which shows bumps
  const double* viewpoint = nullptr; ///< x, y, z: from where the mesh is seen, if it lies within
                                     ///< 60 degrees of one direction from there
};

/// A checkerboard of 32 x 32 squares, of another colour in each of 8 x 8 fields: shows stretch, and
/// what lies where.
vtkSmartPointer<vtkImageData>
makeCheckerboard ();

/// Draws a mesh: front sides blue, back sides orange, boundary edges red, and all edges if there
/// are few. It is seen from the side to which most of it faces. Needs an X display.
/// \param height in pixels; mesh and parameterization are as wide each
vtkSmartPointer<vtkImageData>
drawMesh (vtkPolyData* mesh, int height, const PictureOptions& options = {});

/// Whether there is an X display to draw on. Without one, VTK would end the process.
bool
displayAvailable ();

} // namespace pcl::floater
