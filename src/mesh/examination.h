// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What an examination tells, of all that was found around the points of a mesh.
#pragma once

#include "mesh/surroundings.h"

#include <functional>
#include <vector>

namespace pcl::floater {
/// What was found of a mesh, point by point.
struct ExaminedParts
{
  Surroundings around;                       ///< of all of its points
  std::size_t triangles = 0;                 ///< proper ones
  std::size_t components = 0;                ///< connected by edges
  std::vector<std::size_t> component_points; ///< vertices of each component, connected by vertices
  std::vector<Index> component_first;        ///< the smallest one of each
};

/// The examination, but for triangles that cross each other: with the boundary loops and the genus.
/// O(boundary log boundary)
/// \param parts     its boundary edges are those of `mesh`, all else is of points
/// \param mesh      has at least the points of the boundary
/// \param pointOf   the point that is a point of `mesh`
/// \param component of each point of `mesh`
MeshExamination
makeExamination (ExaminedParts parts, const ExaminedMesh& mesh,
                 const std::function<Index (Index)>& pointOf, const std::vector<Index>& component,
                 const Points& points);

} // namespace pcl::floater
