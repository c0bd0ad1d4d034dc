// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a mesh and of its parameterization, side by side.
#pragma once

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

/// Draws a mesh: shaded from both sides (blue in front, orange behind), boundary edges red, all
/// edges if there are few, seen from where most of it faces. Beside it, unless null, the
/// parameterization: its edges, seen from above. Needs an X display. \param height of the picture
/// in pixels; the picture is as wide for each of the two \return the picture as a PNG file
std::vector<unsigned char>
drawMesh (vtkPolyData* mesh, vtkPolyData* parameterization, int height);

/// Whether there is an X display to draw on; without one VTK would end the process.
bool
displayAvailable ();

} // namespace floater
} // namespace pcl
