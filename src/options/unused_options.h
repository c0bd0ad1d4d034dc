// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options that were changed, and that had no say in the mesh.
#pragma once

#include <pcl/surface/floater/report.h>

#include <string>
#include <vector>

namespace pcl::floater {
/// One sentence for each reason why options without effect have none, with the names of these
/// options. An option counts if its value is not the default.
/// \param report of the run: which method made the mesh
/// \param has_plane_normals normals were given for the tangent planes
std::vector<std::string>
describeUnusedOptions (const Options& options, const Report& report,
                       bool has_plane_normals = false);

} // namespace pcl::floater
