// SPDX-License-Identifier: GPL-3.0-or-later
// The method of TW 385: one disc, laid out in the plane.
#pragma once

#include "floater/boundary/boundary.h"
#include "floater/parameterize.h"
#include "mesh/finish.h"

namespace pcl
{
namespace floater
{
struct DiscSettings
{
  Neighborhood neighborhood = Neighborhood::NEAREST_DELAUNAY;
  bool filter_sheets = true;
  ParameterizationSettings parameterization;
  bool flip_edges = true;
};

/// The mesh of a disc and how it came about, or why there is none.
struct Disc
{
  Boundary boundary;
  Parameterization parameterization;
  std::size_t levels = 0; ///< of regions laid out again where the plane was too small for them
  TriangleMesh mesh;
  MeshFinish finish;
  Problem problem;
};

/// The whole of TW 385 from the boundary loop on, and what is beyond it: regions too deep for
/// double precision, flips on the surface, repair. Runs through stages WEIGHTS, SOLVE, DELAUNAY and
/// FLIPS. \param geometry its stars, which need their offsets, are consumed, but for the normals
/// \param boundary checked (see checkBoundary)
Disc
makeDisc (const Points& points, LocalGeometry& geometry, Boundary boundary,
          const DiscSettings& settings, const RunContext& run);

} // namespace floater
} // namespace pcl
