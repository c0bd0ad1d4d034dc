// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Edges of a view from one surface to another behind it.
#pragma once

#include "mesh/triangle_mesh.h"
#include "view/rays.h"

namespace pcl::floater {
struct StepLimits
{
  double slope = 4.0; ///< depth over width of an edge, below which it is not a steep step. Surfaces
                      ///< at less than 14 degrees to the ray return hardly any light, so few edges
                      ///< of a surface are steeper
  double turn = 45.0; ///< degrees; a less steep edge is a step if the surface would bend by this at
                      ///< both ends, in opposite directions: two sheets that face the sensor, one
                      ///< behind the other by more than the width of the edge
  double noise = 2.0; ///< a step exceeds this many times the noise (see findDepthSteps). 1 % of
                      ///< Gaussian noise does, but in isolated edges
  double sharp_noise = 4.0; ///< `noise` for edges below the slope, nearly all edges: five
                            ///< standard deviations of Gaussian noise, one edge of a million
  double continued = 2.0; ///< an edge is on one surface if an extrapolation from one of its ends is
                          ///< as steep, up to this factor. At a crease the edge is shorter than the
                          ///< extrapolation from the steeper side: factor 1, and as much for
                          ///< curvature
  double grazing =
      10.0; ///< depth over width of an edge, above which a surface is seen at less than 6
            ///< degrees, and returns hardly any light ...
  double continued_grazing = 1.25; ///< ... `continued` for these: only a plane may be seen so flat.
                                   ///< Rings on three things at three distances look like a slope
  /// largest sum of the weights of an extrapolation. It is 3 on a raster, and up to 7 where rays
  /// are lost; from three points of one ring to the next ring it is thousands, and tells nothing
  double most_weight = 20.0;
  double joint = 10.0; ///< where two surfaces meet: length of an edge over the length to which
                       ///< either is extrapolated; above, it is a step. A surface seen at less
                       ///< than 6 degrees returns hardly any light, and is sampled ten times
                       ///< more coarsely than one seen face on

  std::size_t edges_per_bin = 2000; ///< edges of about the same depth, among which the noise is
                                    ///< measured; their 80 % quantile has an error of 3 %
  std::size_t bins_beside = 4;      ///< on either side; the noise is the median over all
  double nearer_noise = 3.0; ///< largest ratio of the noise to that of edges farther away, in units
      ///< of depth: it does not fall with depth in any sensor. 1, and as much
      ///< as the curvature of near things and the error of each may add
  double noise_quantile = 0.8; ///< of a Gaussian, at 1.3 standard deviations. More than 80 % of the
                               ///< edges of a scene are on surfaces
  double rounding = 2e-5;     ///< of the depth, or of the span of depths for parallel rays; smaller
                              ///< deviations are rounding, as no sensor is so precise
  double step_quantile = 0.2; ///< quantile of the deviations above rounding that is one quantum
  double largest_quantum = 0.02; ///< of the depth; coarsest rounding of sensors
};

/// Marks triangles at edges of the view that lead from one surface to another behind it.
///
/// From each end of an edge, the surface is extrapolated along the edge: inverse depths (see Rays)
/// are affine in planes, so the triangle behind the end predicts the inverse depth at the other
/// end. An edge is a step if it is steep, and if neither end predicts the other one: the deviation
/// exceeds the noise, and the surface is not as steep in this direction. But where the surface goes
/// the same way at both ends, steeply and beyond the noise, it is one that few rays hit, such as
/// ground far from a low sensor.
///
/// Noise of depth grows with depth in every sensor, in some with its square. It is measured as a
/// quantile of the deviations, divided by their sums of weights, at edges of about the same depth.
/// Where most deviations are rounding, depths are quantized, and the noise is one quantum. O(n log
/// n).
/// \return of each triangle: 1 if one of its edges is a step
Flags
findDepthSteps (const TriangleMesh& view, const Rays& rays, const StepLimits& limits,
                const RunContext& run);

} // namespace pcl::floater
