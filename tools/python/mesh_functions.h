// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What Python can ask of any triangle mesh.
#pragma once

#include <pybind11/pybind11.h>

namespace pcl::floater {
/// Adds the functions vertex_normals and texture_coordinates. Triangles are a contiguous array of
/// the shape (m, 3) of uint32.
void
defineMeshFunctions (pybind11::module_& module);

} // namespace pcl::floater
