// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Assembles an examination from its pieces.
#pragma once

#include "mesh/surroundings.h"

#include <functional>
#include <vector>

namespace pcl::floater {
/// Results of an examination, point by point.
struct ExaminedParts
{
  Surroundings around;                       ///< of all points
  std::size_t triangles = 0;                 ///< proper ones
  std::size_t components = 0;                ///< connected by edges
  std::vector<std::size_t> component_points; ///< vertices of each component, connected by vertices
  std::vector<Index> component_first;        ///< smallest vertex of each component
};

/// The examination without crossing pairs: adds boundary loops and genus. O(boundary log boundary)
/// \param parts     its boundary edges have points of `mesh`; all else is of all points
/// \param mesh      has at least the points of the boundary
/// \param pointOf   the point behind a point of `mesh`
/// \param component of each point of `mesh`
MeshExamination
makeExamination (ExaminedParts parts, const ExaminedMesh& mesh,
                 const std::function<Index (Index)>& pointOf, const std::vector<Index>& component,
                 const Points& points);

} // namespace pcl::floater
