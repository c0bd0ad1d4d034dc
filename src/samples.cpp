// SPDX-License-Identifier: GPL-3.0-or-later
#include "samples.h"

#include "neighborhoods/ball_neighbors.h"
#include "neighborhoods/nearest_neighbors.h"
#include "neighborhoods/noise.h"
#include "neighborhoods/outliers.h"
#include "neighborhoods/stars.h"
#include "neighborhoods/tangent_planes.h"
#include "neighborhoods/working_set.h"
#include "report_builder.h"
#include "validation.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
FlatLists
findNeighbors (const WorkingSet& set, const Options& options, NeighborSearch* search)
{
  if (options.neighborhood == Neighborhood::BALL ||
      options.neighborhood == Neighborhood::BALL_DELAUNAY)
    return findBallNeighbors (set, options.ball_radius, search, options.threads);
  return findNearestNeighbors (set, options.k, search, options.threads);
}

// Beyond the report: points that lie off any surface would be woven in as spikes. Those that the
// user's loop names stay.
void
leaveOutliersOut (Samples& samples, const Options& options, NeighborSearch* search, Report& report)
{
  const WorkingSet& set = samples.set;
  std::vector<Index> outliers = findOutliers (set.positions, samples.near, options.threads);
  const auto in_loop = [&] (Index p) {
    return std::find (options.loop.begin (), options.loop.end (), set.cloud_index[p]) !=
           options.loop.end ();
  };
  outliers.erase (std::remove_if (outliers.begin (), outliers.end (), in_loop), outliers.end ());
  if (outliers.empty ())
    return;
  std::vector<Index> cloud_indices = removePoints (samples.set, outliers);
  reportOutliers (std::move (cloud_indices), set.positions.size (), report);
  samples.near = findNeighbors (set, options, search);
}

// Beyond the report: where noise is strong, triangles join the points as they lie in their local
// planes. The mesh is triangles only, so that the user's points stay where they are.
void
smoothNoise (Samples& samples, const Options& options, NeighborSearch* search, Report& report)
{
  std::vector<Eigen::Vector3d>& positions = samples.set.positions;
  const double noise = measureNoise (positions, samples.near, options.threads);
  const bool denoise = options.denoise && isStrongNoise (noise, positions.size ());
  reportNoise (noise, denoise, report);
  if (!denoise)
    return;
  samples.noisy = projectOntoPlanes (positions, samples.near, options.threads);
  samples.noisy.swap (positions);
  samples.near = findNeighbors (samples.set, options, search);
}

} // namespace

bool
asksForDisc (const Options& options)
{
  return options.topology == Topology::DISC || !options.loop.empty ();
}

Problem
prepareSamples (Input& input, const Options& options, StageClock& clock, Samples& samples,
                Report& report)
{
  // Section 2.1: N finite, distinct points.
  clock.start (Stage::WORKING_SET);
  samples.set = makeWorkingSet (input.positions, input.cloud_index, options.threads);
  std::vector<Eigen::Vector3d> ().swap (input.positions);
  reportWorkingSet (samples.set, report);
  if (Problem problem = checkWorkingSet (samples.set))
    return problem;

  // Sections 5 and 6: the same neighbours, the k nearest or those in a ball, serve boundary and
  // weights alike.
  clock.start (Stage::NEIGHBORS);
  samples.near = findNeighbors (samples.set, options, input.search);
  if (options.remove_outliers)
    leaveOutliersOut (samples, options, input.search, report);
  if (Problem problem = checkWorkingSet (samples.set))
    return problem;
  smoothNoise (samples, options, input.search, report);

  // Section 4.1: Delaunay neighbourhoods in the tangent planes.
  clock.start (Stage::STARS);
  const std::vector<Eigen::Vector3d>& positions = samples.set.positions;
  std::vector<Eigen::Vector3f> planes = fitTangentPlanes (positions, samples.near, options.threads);
  samples.stars =
      asksForDisc (options)
          ? makeStars (positions, samples.near, planes, options.filter_sheets, options.threads)
          : makeStarsOf (Selection::all (positions.size ()), positions, samples.near, planes,
                         options.filter_sheets, options.threads);
  return {};
}

} // namespace floater
} // namespace pcl
