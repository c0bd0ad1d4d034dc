// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The method of TW 385: one disc, laid out in the plane.
#pragma once

#include "floater/boundary/boundary.h"
#include "floater/disc_limits.h"
#include "floater/parameterize.h"
#include "mesh/finish.h"

namespace pcl::floater {
struct DiscSettings
{
  Neighborhood neighborhood = Neighborhood::NEAREST_DELAUNAY;
  StarSettings stars; ///< for new stars
  ParameterizationSettings parameterization;
  bool flip_edges = true;    ///< flip edges in space at the end, and repair folds
  bool as_published = false; ///< nothing beyond TW 385
  DiscLimits limits{};
  FinishLimits finish{};
  FacingHints facing{};
};

/// The mesh of a disc, or why there is none.
struct Disc
{
  Boundary boundary;
  Parameterization parameterization;
  std::size_t levels = 0; ///< of the recursion over collapsed regions; 0: there was none
  TriangleMesh mesh;
  MeshFinish finish;
  Problem problem;
};

/// Makes the mesh of a disc from its boundary loop (TW 385, sections 2 and 4). Beyond TW 385:
/// collapsed regions are laid out again, edges are flipped in space, and folds are repaired. Stages
/// WEIGHTS, SOLVE, DELAUNAY and FLIPS.
/// \param geometry its stars, which need their offsets, are consumed, except their normals
/// \param boundary checked (see checkBoundary ()), without a problem
/// \return with the problem of the parameterization, or NOT_A_DISC if too many edges are folded
Disc
makeDisc (const Points& points, LocalGeometry& geometry, Boundary boundary,
          const DiscSettings& settings, const RunContext& run);

} // namespace pcl::floater
