// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Discs laid out by CGAL's package Surface_mesh_parameterization.
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
enum class CgalMethod
{
  MEAN_VALUE, ///< on a circle
  ARAP        ///< as rigid as possible, with a free boundary
};

/// \return the place of each point; empty if CGAL failed
std::vector<Eigen::Vector2d>
layOutByCgal (const std::vector<Eigen::Vector3d>& positions, const std::vector<Triangle>& triangles,
              CgalMethod method);

} // namespace floater
} // namespace pcl
