// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of a result, for Python without a copy.
#pragma once

#include <pcl/surface/floater/reconstruct.h>
#include <pybind11/pybind11.h>

#include <memory>

namespace pcl::floater {
/// Makes the arrays known to Python. NumPy takes them by the buffer protocol, so that the module
/// depends on no version of NumPy's C interface. Each keeps the whole result alive.
void
defineResultArray (pybind11::module_& module);

/// The arrays by the names of the report, and "triangles" and "parameters". The indices of the core
/// are unsigned, and here signed: every cloud index is below 2^31.
pybind11::dict
arraysOfResult (const std::shared_ptr<const Result>& result);

/// Adds the functions vertex_normals and texture_coordinates. Triangles are a contiguous array of
/// the shape (m, 3) of uint32.
void
defineMeshFunctions (pybind11::module_& module);

} // namespace pcl::floater
