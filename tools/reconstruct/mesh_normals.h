// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of the vertices of a mesh, as fields of its cloud.
#pragma once

#include "cloud.h"

namespace pcl::floater {
/// Gives the cloud the fields nx, ny and nz of 32-bit floats, with the normals of the vertices of
/// the mesh (see vertexNormals ()), in place of those that it has. All points must be left.
void
replaceNormals (Cloud& cloud, const Triangles& triangles, int threads);

} // namespace pcl::floater
