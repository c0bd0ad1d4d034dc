// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surface of a large cloud, made in parts.
#pragma once

#include "known_stages.h"

namespace pcl::floater {
/// Reconstructs the surface of a cloud that has several parts.
/// \param geometry if stages are known: the spacing and the normals of the stars only
/// \param known    nullptr: no stages are known
Problem
reconstructParts (const Points& points, const Parts& parts, LocalGeometry geometry,
                  const SurfaceSettings& surface_settings, const Request& request,
                  KnownStages* known, Result& result);

} // namespace pcl::floater
