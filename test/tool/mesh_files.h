// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads meshes back with the libraries that users would use, PCL and VTK.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pcl::floater {
/// What a file holds.
struct MeshContent
{
  bool is_double = false;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::array<std::uint8_t, 3>> colors;
  std::vector<Eigen::Vector3f> normals;
  std::map<std::string, std::vector<double>> fields; ///< all others
};

/// VTK's reader of legacy polydata.
MeshContent
readVtk (const std::string& path);

/// A VTK file as pcl_viewer and other programs with PCL read it: pcl::io::loadPolygonFileVTK.
MeshContent
readVtkWithPcl (const std::string& path);

/// PCL's PLY reader.
MeshContent
readPly (const std::string& path);

/// The points of a PLY file as most programs with PCL read them: pcl::io::loadPLYFile, then
/// pcl::fromPCLPointCloud2 into PointXYZ.
std::vector<Eigen::Vector3f>
loadPlyIntoPoints (const std::string& path);

/// VTK's STL reader, without merging points.
MeshContent
readStl (const std::string& path);

/// Reads an OBJ file line by line, because no library reads doubles from it.
MeshContent
readObj (const std::string& path);

/// Reads an OFF file line by line, because no library reads doubles and colours from it.
MeshContent
readOff (const std::string& path);

/// VTK's glTF reader, without the transformation of its node. Vertices as the file has them.
MeshContent
readGlb (const std::string& path);

/// Reads a file by the reader for its extension.
MeshContent
readMesh (const std::string& path);

} // namespace pcl::floater
