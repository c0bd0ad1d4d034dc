// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a mesh and of its parameterization, side by side.
#pragma once

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// Reads a triangle mesh from a .vtk or .ply file.
/// \throw std::runtime_error that names the file if it cannot be read or has no polygons
vtkSmartPointer<vtkPolyData>
readMesh (const std::string& path);

/// What else a picture of a mesh shows.
struct PictureOptions
{
  vtkPolyData* parameterization = nullptr; ///< drawn beside the mesh: its edges, seen from above
  vtkPolyData* marked_edges = nullptr;     ///< lines on the mesh, drawn in magenta
  bool flat_shading = false;               ///< true: each triangle in one shade, so that bumps show
};

/// Draws a mesh: shaded from both sides (blue in front, orange behind), boundary edges red, all
/// edges if there are few, seen from where most of it faces. Needs an X display. \param height of
/// the picture in pixels; the picture is as wide for each of mesh and parameterization
vtkSmartPointer<vtkImageData>
drawMesh (vtkPolyData* mesh, int height, const PictureOptions& options = {});

/// A picture as a PNG file. \throw std::runtime_error if VTK fails
std::vector<unsigned char>
toPng (vtkImageData* image);

/// Whether there is an X display to draw on; without one VTK would end the process.
bool
displayAvailable ();

} // namespace floater
} // namespace pcl
