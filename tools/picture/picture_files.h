// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The files of pictures: meshes that are drawn, images.
#pragma once

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace pcl::floater {
/// Reads a triangle mesh from a .vtk or .ply file, with texture coordinates if it has some: TCoords
/// of VTK, s and t of PLY.
/// \throw std::runtime_error that names the file if it cannot be read or has no polygons
vtkSmartPointer<vtkPolyData>
readMesh (const std::string& path);

/// Reads a PNG file. \throw std::runtime_error that names the file if it cannot be read
vtkSmartPointer<vtkImageData>
readPng (const std::string& path);

/// The bytes of a PNG file of a picture. \throw std::runtime_error if VTK fails
std::vector<unsigned char>
toPng (vtkImageData* image);

} // namespace pcl::floater
