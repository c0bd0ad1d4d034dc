// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture_mesh.h"

#include "cloud_reader.h"
#include "format.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace pcl::floater {
PictureMesh
readPictureMesh (const std::filesystem::path& path)
{
  const std::string extension = lowerExtension (path);
  if (extension != ".vtk" && extension != ".ply")
    throw ReadError ("its extension must be .vtk or .ply");
  const FileBytes file (path);
  PictureMesh mesh;
  Triangles all;
  const Cloud cloud = extension == ".vtk" ? parseVtk (file, all) : parsePly (file, false, &all);
  const std::vector<Eigen::Vector3d> positions = cloud.positions ();
  const Field *s = cloud.find ("s"), *t = cloud.find ("t");

  constexpr std::uint32_t UNUSED = std::numeric_limits<std::uint32_t>::max ();
  std::vector<std::uint32_t> number (positions.size (), UNUSED);
  Eigen::AlignedBox3d box;
  for (auto& triangle : all) {
    if (!std::all_of (triangle.begin (), triangle.end (),
                      [&] (std::uint32_t corner) { return positions[corner].allFinite (); }))
      continue;
    for (std::uint32_t& corner : triangle) {
      if (number[corner] == UNUSED) {
        number[corner] = static_cast<std::uint32_t> (mesh.points.size ());
        mesh.points.push_back (positions[corner]);
        box.extend (positions[corner]);
        if (s != nullptr && t != nullptr)
          mesh.coordinates.emplace_back (std::fmax (0.0, std::fmin (s->asDouble (corner), 1.0)),
                                         std::fmax (0.0, std::fmin (t->asDouble (corner), 1.0)));
      }
      corner = number[corner];
    }
    mesh.triangles.push_back (triangle);
  }
  if (mesh.triangles.empty ())
    throw ReadError ("it has no polygons");
  // Halves, because the size of the largest numbers overflows.
  mesh.centre = 0.5 * box.min () + 0.5 * box.max ();
  mesh.scale = 1.0 / (0.5 * box.max () - 0.5 * box.min ()).maxCoeff ();
  if (!std::isfinite (mesh.scale))
    mesh.scale = 1.0;
  for (Eigen::Vector3d& point : mesh.points)
    point = mesh.scale * (point - mesh.centre);
  return mesh;
}

} // namespace pcl::floater
