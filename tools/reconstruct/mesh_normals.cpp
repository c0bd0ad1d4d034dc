// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_normals.h"

#include <pcl/surface/floater/vertex_normals.h>

#include <algorithm>
#include <memory>

namespace pcl::floater {
void
replaceNormals (Cloud& cloud, const Triangles& triangles, int threads)
{
  constexpr std::array<const char*, 3> NAMES{"nx", "ny", "nz"};
  const auto normals = std::make_shared<const std::vector<Eigen::Vector3f>> (
      vertexNormals (cloud.positions (), triangles, threads));
  cloud.file.giveBack ();
  cloud.fields.erase (std::remove_if (cloud.fields.begin (), cloud.fields.end (),
                                      [&NAMES] (const Field& field) {
                                        return std::find (NAMES.begin (), NAMES.end (),
                                                          field.name) != NAMES.end ();
                                      }),
                      cloud.fields.end ());
  for (std::size_t axis = 0; axis < NAMES.size (); ++axis) {
    Field field{NAMES[axis], ScalarType::FLOAT32};
    field.first = {normals, reinterpret_cast<const char*> (normals->front ().data () + axis)};
    field.stride = sizeof (Eigen::Vector3f);
    cloud.fields.push_back (std::move (field));
  }
}

} // namespace pcl::floater
