// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A pcl::TextureMesh, as PCL writes and reads it.
#include "mesh_check.h"

#include <pcl/TextureMesh.h>
#include <pcl/io/obj_io.h>

#include <filesystem>

namespace pcl::floater {
namespace {
TEST (FloaterClass, TextureMeshComesBackFromAFile)
{
  pcl::FloaterReconstruction<pcl::PointNormal> floater;
  floater.setInputCloud (makeCloud<pcl::PointNormal> (SurfaceKind::SPHERE, 700));
  pcl::TextureMesh mesh;
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS);
  EXPECT_FALSE (floater.getComputeTextureCoordinates ()); // as it was
  EXPECT_EQ (mesh.cloud.width * mesh.cloud.height, 700U);
  ASSERT_EQ (mesh.tex_polygons.size (), 1U);
  mesh.tex_materials.at (0).tex_file = "colours.png";
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path () / "pcl_floater_texture_file";
  std::filesystem::create_directories (folder);
  const std::string file = (folder / "mesh.obj").string ();
  ASSERT_EQ (pcl::io::saveOBJFile (file, mesh, 9), 0);

  pcl::TextureMesh read;
  ASSERT_EQ (pcl::io::loadOBJFile (file, read), 0);
  std::filesystem::remove_all (folder);
  ASSERT_EQ (read.tex_polygons.size (), 1U);
  EXPECT_EQ (read.tex_materials.at (0).tex_name, "surface");
  const TextureCoordinates& texture = floater.getTextureCoordinates ();
  ASSERT_EQ (read.tex_polygons[0].size (), texture.corners.size ());
  ASSERT_EQ (read.tex_coordinates.at (0).size (), 3 * texture.corners.size ());
  for (std::size_t t = 0; t < texture.corners.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = texture.corners[t][i];
      EXPECT_EQ (read.tex_polygons[0][t].vertices[i], texture.points[corner]);
      EXPECT_EQ (mesh.tex_coordinates.at (0)[3 * t + i], texture.coordinates[corner]);
      EXPECT_LT ((read.tex_coordinates[0][3 * t + i] - texture.coordinates[corner]).norm (), 1e-6F);
    }

  // After a failure it is empty.
  floater.setInputCloud (pcl::make_shared<pcl::PointCloud<pcl::PointNormal>> ());
  floater.reconstruct (mesh);
  EXPECT_EQ (floater.getStatus (), RunStatus::NO_INPUT);
  EXPECT_TRUE (mesh.tex_polygons.empty () && mesh.cloud.data.empty ());
  EXPECT_EQ (floater.getTextureCoordinates ().status, RunStatus::NOT_RUN);
}

} // namespace
} // namespace pcl::floater
