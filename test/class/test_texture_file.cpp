// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A pcl::TextureMesh as PCL writes and reads it.
#include "mesh_check.h"

#include <pcl/TextureMesh.h>
#include <pcl/io/obj_io.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace pcl::floater {
namespace {
TEST_F (FloaterClass, TextureMeshComesBackFromAFile)
{
  pcl::FloaterReconstruction<pcl::PointNormal> floater;
  floater.setInputCloud (makeCloud<pcl::PointNormal> (SurfaceKind::SPHERE, 700));
  pcl::TextureMesh mesh;
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS);
  mesh.tex_materials.front ().tex_file = "colours.png";
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path () / "pcl_floater_texture_file";
  std::filesystem::create_directories (folder);
  const std::string file = (folder / "mesh.obj").string ();
  ASSERT_EQ (pcl::io::saveOBJFile (file, mesh, 9), 0);

  pcl::TextureMesh read;
  ASSERT_EQ (pcl::io::loadOBJFile (file, read), 0);
  std::filesystem::remove_all (folder);
  ASSERT_EQ (read.tex_polygons.size (), 1U);
  ASSERT_EQ (read.tex_polygons[0].size (), mesh.tex_polygons[0].size ());
  EXPECT_EQ (read.tex_materials.at (0).tex_name, "surface");
  ASSERT_EQ (read.tex_coordinates.at (0).size (), 3 * mesh.tex_polygons[0].size ());
  for (std::size_t t = 0; t < mesh.tex_polygons[0].size (); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ (read.tex_polygons[0][t].vertices[i], mesh.tex_polygons[0][t].vertices[i]);
      EXPECT_LT ((read.tex_coordinates[0][3 * t + i] - mesh.tex_coordinates[0][3 * t + i]).norm (),
                 1e-6F);
    }
}

} // namespace
} // namespace pcl::floater
