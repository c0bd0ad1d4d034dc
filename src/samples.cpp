// SPDX-License-Identifier: GPL-3.0-or-later
#include "samples.h"

#include "blocks/block_driver.h"
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
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
bool
hasBalls (const Options& options)
{
  return options.neighborhood == Neighborhood::BALL ||
         options.neighborhood == Neighborhood::BALL_DELAUNAY;
}

// Finds neighbours, and, if in blocks, all that comes of them.
class NeighborFinder
{
public:
  NeighborFinder (const Options& options, NeighborSearch* search, std::size_t points)
      : options_ (options), search_ (search),
        blocks_ (asksForDisc (options) || hasBalls (options) || search != nullptr
                     ? 1
                     : chooseBlocks (points, options.blocks, options.threads))
  {
  }

  bool isInBlocks () const { return blocks_ > 1; }

  void find (Samples& samples) const
  {
    if (!isInBlocks ()) {
      samples.near =
          hasBalls (options_)
              ? findBallNeighbors (samples.set, options_.ball_radius, search_, options_.threads)
              : findNearestNeighbors (samples.set, options_.k, search_, options_.threads);
      return;
    }
    samples.near = {};
    samples.candidates.clear ();
    ThreadDriver driver (options_.threads);
    CloudSurface cloud = makeCloudSurface (samples.set.positions, blocks_, options_, driver);
    samples.near = std::move (cloud.near);
    samples.spacing = std::move (cloud.spacing);
    samples.stars.normals = std::move (cloud.normals);
    samples.crease = std::move (cloud.crease);
    samples.candidates = std::move (cloud.candidates);
  }

private:
  const Options& options_;
  NeighborSearch* search_;
  std::size_t blocks_;
};

// Beyond the report: points that lie off any surface would be woven in as spikes. Those that the
// user's loop names stay.
void
leaveOutliersOut (Samples& samples, const Options& options, const NeighborFinder& finder,
                  Report& report)
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
  finder.find (samples);
}

// Beyond the report: where noise is strong, triangles join the points as they lie in their local
// planes. The mesh is triangles only, so that the user's points stay where they are.
void
smoothNoise (Samples& samples, const Options& options, const NeighborFinder& finder, Report& report)
{
  std::vector<Eigen::Vector3d>& positions = samples.set.positions;
  const double noise = measureNoise (positions, samples.near, options.threads);
  const bool denoise = options.denoise && isStrongNoise (noise, positions.size ());
  reportNoise (noise, denoise, report);
  if (!denoise)
    return;
  samples.noisy = projectOntoPlanes (positions, samples.near, options.threads);
  samples.noisy.swap (positions);
  finder.find (samples);
}

// Section 4.1: Delaunay neighbourhoods in the tangent planes.
void
findStars (Samples& samples, const Options& options)
{
  const std::vector<Eigen::Vector3d>& positions = samples.set.positions;
  if (asksForDisc (options)) {
    samples.stars = makeStars (positions, samples.near,
                               fitTangentPlanes (positions, samples.near, options.threads),
                               options.filter_sheets, options.threads);
    return;
  }
  BlockSurface whole =
      makeWholeSurface (positions, samples.near, options.filter_sheets, options.threads);
  samples.spacing = std::move (whole.spacing);
  samples.stars.normals = std::move (whole.normals);
  samples.crease = std::move (whole.crease);
  samples.candidates.push_back (std::move (whole.candidates));
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
  std::vector<Index> ().swap (input.cloud_index);
  reportWorkingSet (samples.set, report);
  if (Problem problem = checkWorkingSet (samples.set))
    return problem;

  // Sections 5 and 6: the same neighbours, the k nearest or those in a ball, serve boundary and
  // weights alike.
  const NeighborFinder finder (options, input.search, samples.set.positions.size ());
  clock.start (finder.isInBlocks () ? Stage::STARS : Stage::NEIGHBORS);
  finder.find (samples);
  if (options.remove_outliers)
    leaveOutliersOut (samples, options, finder, report);
  if (Problem problem = checkWorkingSet (samples.set))
    return problem;
  smoothNoise (samples, options, finder, report);
  clock.start (Stage::STARS);
  if (!finder.isInBlocks ())
    findStars (samples, options);
  return {};
}

} // namespace floater
} // namespace pcl
