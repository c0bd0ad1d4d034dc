// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options that were changed, but had no effect on the mesh.
#pragma once

#include <pcl/surface/floater/report.h>

#include <string>
#include <vector>

namespace pcl::floater {
/// One sentence for each reason why options had no effect, with their names. Only options that
/// differ from the default count.
/// \param report of the run, for the method that made the mesh
/// \param has_plane_normals normals were given for the tangent planes
std::vector<std::string>
describeUnusedOptions (const Options& options, const Report& report,
                       bool has_plane_normals = false);

} // namespace pcl::floater
