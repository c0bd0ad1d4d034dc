// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes with neighbours, of plain triangles.
#pragma once

#include "mesh/known_meshes.h"
#include "mesh/triangle_mesh.h"

#include <gtest/gtest.h>

namespace pcl::floater::samples {
/// The triangles of a mesh, in the same order, with their neighbours. The calling test fails if
/// they are no oriented manifold.
inline TriangleMesh
connected (const Mesh& mesh)
{
  TriangleMesh result;
  result.triangles = mesh.triangles;
  EXPECT_TRUE (result.connect (mesh.positions.size (), 1));
  return result;
}

} // namespace pcl::floater::samples
