// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Edges of a view from one surface to another behind it.
#pragma once

#include "mesh/triangle_mesh.h"
#include "view/rays.h"

#include <vector>

namespace pcl::floater {
struct StepLimits
{
  double slope = 4.0; ///< depth over width of an edge; below, it is never a step. Surfaces that a
                      ///< ray meets at less than 14 degrees return hardly any light, so that few
                      ///< edges of a surface are steeper
  double turn = 45.0; ///< degrees; below the slope, an edge is a step if the surface would turn so
                      ///< sharply at both ends, and in opposite senses: two sheets that face the
                      ///< sensor, one behind the other by more than the width of the edge
  double noise = 2.0; ///< a step exceeds so many times the noise (see findDepthSteps). Of Gaussian
                      ///< noise, 1 % does; but these edges stand alone, and a step does not
  double sharp_noise = 4.0; ///< the same below the slope, where nearly all edges are: of Gaussian
                            ///< noise, it is five standard deviations, one edge of a million
  double continued = 2.0; ///< an edge is on one surface if that goes on so from one of its ends, up
                          ///< to this factor. At a crease the edge is shorter than the surface goes
                          ///< on from the steeper side: factor 1, and as much for curvature
  double joint = 10.0;    ///< where two surfaces meet, length of an edge over that to which the
                          ///< surface of either end goes on; above, it is a step. One seen at less
  ///< than 6 degrees returns hardly any light, and is sampled ten times more
  ///< coarsely than one seen face on

  std::size_t edges_per_bin = 2000; ///< edges of about the same depth, among which the noise is
                                    ///< measured; their 80 % quantile has an error of 3 %
  std::size_t bins_beside = 4;      ///< on either side; the noise is the median of them all
  double noise_quantile = 0.8; ///< of a Gaussian, at 1.3 standard deviations. More than 80 % of
                               ///< the edges of a scene are on surfaces
  double rounding = 2e-5; ///< of the depth, or of the span of depths along parallel rays; a smaller
                          ///< deviation is rounding, as no sensor is so precise
  double step_quantile = 0.2; ///< of quantized depths: of the deviations above rounding, one step
  double largest_quantum = 0.02; ///< of the depth; sensors do not round more coarsely
};

/// Finds the edges of the view that lead from one surface to another behind it, and marks their
/// triangles.
///
/// From each end of an edge, the surface is continued along the edge: levels (see Rays) are affine
/// in planes, so that the triangle behind the end, seen along the edge, tells the level at the
/// other end. An edge is a step if it is steep, and if neither end tells the other one: the
/// deviation exceeds the noise, and the surface does not go on into that direction as steeply.
///
/// Noise of depth grows with depth in every sensor, in some with its square. So it is measured by
/// depth: as a quantile of the deviations at edges of about the same depth, each divided by the sum
/// of weights in it. Where most deviations are mere rounding, depths are quantized, and the noise
/// is one quantum. O(n log n).
/// \return of each triangle: 1 if one of its edges is a step
std::vector<std::uint8_t>
findDepthSteps (const TriangleMesh& view, const Rays& rays, const StepLimits& limits,
                const RunContext& run);

} // namespace pcl::floater
