// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Puts zones that were made anew into a mesh.
#pragma once

#include "mesh/triangle_mesh.h"

#include <optional>
#include <vector>

namespace pcl::floater {
/// A patch of the frame of a zone, by one of its triangles.
struct PatchSide
{
  Index triangle; ///< of the mesh
  bool is_turned; ///< against the new triangles
};

/// A zone made anew.
struct NewZone
{
  std::vector<Index> points; ///< whose triangles go
  std::vector<Triangle> triangles;
  std::vector<PatchSide> patches;
};

/// The triangles of the mesh with new zones, turned so that neighbours face one side; where sides
/// differ, that of most triangles is kept. O(n log n).
/// \param[in,out] made loses zones that overlap an earlier one or contradict the sides of others
std::vector<Triangle>
spliceZones (const TriangleMesh& mesh, std::vector<std::optional<NewZone>>& made);

} // namespace pcl::floater
