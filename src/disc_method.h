// SPDX-License-Identifier: GPL-3.0-or-later
// The method of TW 385: one disc, laid out in the plane.
#pragma once

#include "boundary/boundary_loop.h"
#include "samples.h"
#include "triangulation/surface_finish.h"

namespace pcl
{
namespace floater
{
/// The mesh of a disc, or why there is none.
struct Disc
{
  Boundary boundary;
  SurfaceMesh mesh; ///< faces outwards
  SurfaceFinish finish;
  Problem problem;
};

/// The whole of TW 385, and what is beyond it: regions too deep for double precision, flips on the
/// surface, repair. Books stages BOUNDARY to DELAUNAY and FLIPS; reports the parameterization and
/// figures of the system. \param samples its stars are consumed, but for the normals
Disc
makeDisc (Samples& samples, const Options& options, StageClock& clock, Report& report);

} // namespace floater
} // namespace pcl
