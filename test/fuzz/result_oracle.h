// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What every result must be, whatever the cloud and the options were.
#pragma once

#include <pcl/surface/floater/reconstruct.h>

#include <string>

namespace pcl::floater::fuzz {
/// Compares a result with what the headers promise, without any code of the library: no status that
/// blames the library; without a mesh a message; else triangles of selected points that form an
/// oriented manifold with the figures of the report, and every selected point accounted for exactly
/// once: in the mesh, or as unused, outlier, not finite, or equal to another point.
/// \param input as it was given to reconstruct ()
/// \return the first fault in a sentence; empty if there is none
std::string
findFault (const Input& input, const Result& result);

} // namespace pcl::floater::fuzz
