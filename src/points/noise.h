// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How noisy the points are, each at its own scale, and which lie on no surface at any scale.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/neighbor_table.h"
#include "points/point_sample.h"

#include <vector>

namespace pcl::floater {
/// What is taken for noise.
///
/// A neighbourhood has a residual: the root mean square distance of its points to the quadric that
/// fits them best. From one scale to the next, with every fourth point, spacings double. Noise
/// keeps its residual, so that in spacings of the scale it falls to one half. At a crease it stays
/// the same in spacings, and where a surface bends more than a quadric it rises (after Mitra and
/// Nguyen 2003; Pauly, Keiser and Gross 2003).
struct NoiseLimits
{
  double strong = 0.15;  ///< residual in spacings of a scale from which on points are better
                         ///< connected without it. Clouds that are clean, however thin, sharp or
                         ///< coarse, measured up to 0.08; noise of 0.2 spacings in each coordinate
                         ///< measures 0.15 to 0.19
  double falls_to = 0.7; ///< of the residual in spacings, at a larger scale. Between 0.5 (noise)
                         ///< and 1 (crease), a standard error of 20 points nearer to noise
  double least_aspect = 0.02; ///< middle over largest eigenvalue of the points; below, they lie on
                              ///< a line, and a residual says nothing
  double quantile = 0.9; ///< of the noise of the points around. Within a terrace of quantized depth
                         ///< everything looks flat
  double sheet_gap = 0.7; ///< spacings between two sheets that are not noise
  double radius = 8.0;    ///< of the ball on whose plane a point is projected, in its noise. The
                          ///< mean of as many points has a fifth of the noise or less
  /// Mean, over all points, of the share of neighbours in the star of a noisy point that do not
  /// have it in theirs. Generated boxes and sheets 2 spacings apart have up to 0.028, surfaces with
  /// noise of 0.3 spacings 0.07, of 0.5 spacings 0.18. Of the clean clouds of the benchmark the
  /// largest is 0.020, of its depth cameras the smallest 0.038. Chosen between these: close to
  /// both, and not certain.
  double disturbed_share = 0.035;
  /// Residual in spacings at the scale where it is smallest, median of the places around a point.
  /// From here on the point is scatter. Of 20,000 generated points, five clouds of each kind: 98 to
  /// 99.7 % are scatter if they are strewn into a box, a ball or clumps; on a plane 0.05 % with
  /// noise of 1.5 spacings, 8 % with 2, 78 % with 3.
  double scatter = 0.48;
};

/// The noise of a cloud.
struct Noise
{
  std::vector<float> at_point; ///< standard deviation across the surface, in the unit of the
                               ///< positions; 0 at points that are not noisy
  std::size_t noisy_points = 0;
  std::vector<Index> scatter; ///< points around which no scale is flat, ascending: leaves, grass
  double median = 0.0, quantile_90 = 0.0, largest = 0.0; ///< over all points, in local spacings
  bool is_strong = false;                                ///< see isStrong; set by the caller
};

/// What a place of the cloud looks like, one value for each place.
struct NoiseProbes
{
  std::vector<float> noise;      ///< standard deviation across the surface; 0: there is none
  std::vector<float> unevenness; ///< residual in spacings at the flattest scale; below 0: unknown
};

/// Every 64th point is measured first. If none of these is noisy, the cloud has no noise.
constexpr std::size_t NOISE_PROBES = 64;

/// Whether a cloud has enough points to tell noise.
bool
mayBeNoisy (std::size_t points);

/// Measures noise around some points. O(1) for each.
/// \param neighbors of these points, nearest first
/// \param samples   at each scale but the first, whose place is not read
/// \param is_unevenness_needed if not, it is unknown at places without noise, which take less time
NoiseProbes
probeNoise (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Index>& points, const std::array<const PointSample*, SCALES>& samples,
            const NoiseLimits& limits, const RunContext& run, bool is_unevenness_needed = true);

/// Measures noise at every eighth point, at three scales: its 20 nearest of all points, of every
/// fourth, and of every sixteenth. Each point has the 90 % quantile of the 10 places around it.
/// Clouds of fewer than 320 points have no such scales, and no noise; those in which fewer than 1 %
/// of the places are noisy have none, either. The same holds for scatter, which needs 320 points
/// that are no surface: a single bush of fewer lies in a surface at the largest scale. A place
/// where all three scales are lines, as on a wire, is scatter, too. O(n log n).
/// \param positions along a space-filling curve
/// \param neighbors of each point, nearest first
/// \param known of every NOISE_PROBES-th point, if they have been measured before
Noise
measureNoise (const std::vector<Eigen::Vector3d>& positions, const NeighborTable& neighbors,
              const NoiseLimits& limits, const RunContext& run, const NoiseProbes* known = nullptr);

/// Whether points have to be projected before they are connected: so many are noisy, and so little
/// do their stars agree. At creases and thin sheets of clean clouds points look noisy, too, but
/// their stars agree. O(n).
/// \param agreement of the star of each point, see starAgreement
bool
isStrong (const Noise& noise, const std::vector<float>& agreement, const NoiseLimits& limits);

} // namespace pcl::floater
