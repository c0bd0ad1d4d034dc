// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of any topology, out of the triangles that stars agree on.
#pragma once

#include "common/problem.h"
#include "common/stage_clock.h"
#include "complex/rims.h"
#include "samples.h"
#include "triangulation/surface_finish.h"

namespace pcl
{
namespace floater
{
/// The mesh of a surface and how it came about.
struct Surface
{
  SurfaceMesh mesh;
  SurfaceFinish finish;
  std::vector<Rim> rims; ///< of the complex; those that stay are the mesh's boundary loops
  std::size_t holes_filled = 0;
  std::vector<Triangle> cut; ///< where a surface that seems one-sided was cut open; see longestRow
  std::size_t pieces = 0;
  bool is_one_disc = false; ///< one piece, one loop, Euler characteristic 1
};

/// Complex, holes, left-over points, flips and repair. Books stages COMPLEX, HOLES and FLIPS.
/// O(n log n). Edges are flipped and folds repaired where the user's points are. \param samples
/// candidates, crease normals and spacings are consumed; normals get consistent signs
Surface
makeSurface (Samples& samples, const Options& options, StageClock& clock);

} // namespace floater
} // namespace pcl
