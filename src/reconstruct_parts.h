// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A surface of a large cloud, which is made in parts.
#pragma once

#include "known_stages.h"

namespace pcl::floater {
/// Reconstructs the surface of a cloud that has several parts.
/// \param points   the same afterwards; if stages are known, possibly without their positions
/// \param geometry if stages are known: the spacing alone
/// \param known    nullptr: no stages are known. Else it is given the mesh, unless something is cut
///                 off: then the result has it
Problem
reconstructParts (Points& points, const Parts& parts, LocalGeometry geometry,
                  const SurfaceSettings& surface_settings, const Request& request,
                  KnownStages* known, Result& result);

} // namespace pcl::floater
