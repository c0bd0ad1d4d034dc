// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Files as programs with PCL write and read them.
// pcl_files KIND A.pcd B.pcd: writes B, ascii, binary or compressed. pcl_files read MESH: prints points and triangles.
#include <pcl/PCLPointCloud2.h>
#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/io/vtk_lib_io.h>
#include <pcl/point_types.h>

#include <iostream>
#include <string>

namespace {
int
convert (const std::string& kind, const std::string& from, const std::string& to)
{
  constexpr int DIGITS = 17;
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin;
  Eigen::Quaternionf turn;
  int version = 0;
  if (pcl::PCDReader ().read (from, cloud, origin, turn, version) != 0)
    return 1;
  pcl::PCDWriter writer;
  return kind == "ascii"    ? writer.writeASCII (to, cloud, origin, turn, DIGITS)
         : kind == "binary" ? writer.writeBinary (to, cloud, origin, turn)
                            : writer.writeBinaryCompressed (to, cloud, origin, turn);
}

/// As pcl::io::loadPLYFile or, as pcl_viewer, loadPolygonFileVTK, then into points of floats.
int
print (const std::string& path)
{
  pcl::PolygonMesh mesh;
  if (path.substr (path.size () - 4) == ".vtk")
    pcl::io::loadPolygonFileVTK (path, mesh);
  else if (pcl::io::loadPLYFile (path, mesh) != 0)
    return 1;
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
  pcl::fromPCLPointCloud2 (mesh.cloud, cloud);
  std::cout.precision (9);
  for (const pcl::PointXYZRGBNormal& p : cloud)
    std::cout << "v " << p.x << ' ' << p.y << ' ' << p.z << ' ' << +p.r << ' ' << +p.g << ' '
              << +p.b << ' ' << p.normal_x << ' ' << p.normal_y << ' ' << p.normal_z << '\n';
  for (const pcl::Vertices& polygon : mesh.polygons)
    std::cout << "f " << polygon.vertices.at (0) << ' ' << polygon.vertices.at (1) << ' '
              << polygon.vertices.at (2) << '\n';
  return 0;
}

} // namespace

int
main (int argc, char** argv)
{
  return argc == 4 ? convert (argv[1], argv[2], argv[3]) : print (argv[2]);
}
