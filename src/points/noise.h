// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Noise of the points, each at its own scale, how uneven the cloud is around them, and regions:
// points of a kind that hang together.
#pragma once

#include "core/csr_lists.h"
#include "core/disjoint_sets.h"
#include "core/run_context.h"
#include "points/neighbors.h"
#include "points/points.h"

namespace pcl::floater {
/// Unevenness from which on a point may lie on no surface. Points strewn into a box or a ball have 0.49
/// or more, sheets with noise of one spacing 0.37 or less.
constexpr double UNEVEN = 0.38;

/// The noise of a cloud.
struct Noise
{
  std::vector<float> at_point; ///< standard deviation across the surface, in the unit of the
                               ///< positions; 0 at points that are not noisy
  std::size_t noisy_points = 0;
  /// Unevenness of each point: the residual in spacings at the scale where it is smallest, median
  /// of the probes around. Empty if hardly any point is uneven.
  std::vector<float> unevenness;
  /// Dimension of each point: by which power of the distance the number of points around grows,
  /// from 40 to 160 and from 80 to 320 points, median of the probes around; 2 on a surface. Empty
  /// as unevenness is.
  std::vector<float> dimension;
  /// The same at a smaller scale, from 10 to 40 and from 20 to 80 points.
  std::vector<float> smaller_dimension;
  double median = 0.0, quantile_90 = 0.0, largest = 0.0; ///< over all points, in local spacings
};

/// Measures noise. A neighbourhood has a residual: the root mean square distance of its points to their
/// least-squares quadric. Spacings double from one scale to the next, which has every fourth point.
/// The residual of noise is constant, so relative to the spacing it halves. At a crease the
/// relative residual is constant, and where a surface bends more than a quadric it rises (after
/// Mitra and Nguyen 2003; Pauly, Keiser and Gross 2003).
///
/// Measured at every eighth point (probe), at three scales: its 20 nearest of all points, of
/// every fourth, and of every sixteenth. Each point has the 90 % quantile of the 10 probes around
/// it. Clouds of fewer than 320 points lack these scales, and have neither noise nor unevenness.
/// If fewer than 1 % of the probes are noisy, there is no noise. A probe where all three scales are
/// lines, as on a wire, is as uneven as can be. O(n log n).
/// \param positions along a space-filling curve
/// \param neighbors of each point, nearest first
Noise
measureNoise (const Positions& positions, const CsrLists& neighbors, const RunContext& run);

/// Keeps noise only in regions of noisy points where it explains the disagreement of the stars, and
/// counts the noisy points again. O(n).
/// \param neighbors of each point, nearest first
/// \param before agreement of the star of each point, by the positions of the points
/// \param after  the same with projected points
void
keepExplained (const CsrLists& neighbors, const std::vector<float>& before,
               const std::vector<float>& after, Noise& noise);

/// Projects every noisy point on the plane of up to 60 points around it within eight times its noise,
/// weighted by distance. A second pass leaves out points far off the first plane, such as
/// background behind an object. 3 microseconds for a noisy point.
/// \param neighbors of each point, nearest first
Positions
projectNoisyPoints (const Positions& positions, const CsrLists& neighbors, const Noise& noise,
                    const RunContext& run);

/// Points of which those that hang together are judged together.
struct RegionPoints
{
  Flags is_inside;          ///< of each point: whether it may be in a region
  Flags is_counted;         ///< whether it counts for its region
  std::vector<float> value; ///< of the points that count
};

/// Takes the regions with at least so many points that count, and at least this mean of their
/// values. Points hang together if one is among the nearest 20 of the other. O(n).
/// \param neighbors of each point, nearest first
/// \param taken     set to 1 at all points of such regions; otherwise left as it is
inline void
takeRegions (const CsrLists& neighbors, const RegionPoints& points, std::size_t least,
             double least_mean, Flags& taken)
{
  constexpr std::size_t NEAREST = 20;
  const std::size_t n = points.is_inside.size ();
  DisjointSets regions (n);
  for (Index p = 0; p < n; ++p)
    if (points.is_inside[p] != 0)
      for (const Index q : neighbors.first (p, NEAREST))
        if (points.is_inside[q] != 0)
          regions.join (p, q);
  std::vector<std::size_t> count (n, 0);
  std::vector<double> sum (n, 0.0);
  for (Index p = 0; p < n; ++p)
    if (points.is_inside[p] != 0 && points.is_counted[p] != 0) {
      const Index region = regions.find (p);
      ++count[region];
      sum[region] += static_cast<double> (points.value[p]);
    }
  for (Index p = 0; p < n; ++p) {
    const Index region = regions.find (p);
    if (points.is_inside[p] != 0 && count[region] >= least &&
        sum[region] >= least_mean * static_cast<double> (count[region]))
      taken[p] = 1;
  }
}

} // namespace pcl::floater
