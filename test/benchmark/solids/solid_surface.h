// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Random surfaces of bodies, as meshes whose vertices are clouds with a known truth.
#pragma once

#include "core/types.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
struct SolidSurface
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles; ///< facing outwards
  std::string description;         ///< "quadric, 2 windows"
};

/// Balls, capsules, tori, ellipsoids, boxes and drums at random places, joined or taken away, with
/// smooth or with sharp seams; the largest component of that. A third of these surfaces is closed,
/// a third is cut by a plane, and a third has one to four windows, cut out by balls, 6 to 24 edges
/// wide. Vertices are spread evenly, or thinned out where the surface is flat, by two criteria, or
/// they are those of marching cubes, some of which are very close. Bodies whose vertices are
/// thinned out have no flat faces: hardly a vertex would be left there.
/// \return nothing if the surface has fewer than 1500 or more than 60000 vertices, or touches
/// itself, as every third one does
std::optional<SolidSurface>
makeSolidSurface (std::uint64_t seed);

} // namespace floater
} // namespace pcl
