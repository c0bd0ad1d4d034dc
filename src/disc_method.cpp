// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of the report in order, with its sections and equations.
#include "disc_method.h"

#include "neighborhoods/stars.h"
#include "parameterization/parameterize.h"
#include "parameterization/region_recursion.h"
#include "report_builder.h"
#include "triangulation/outward.h"
#include "triangulation/planar_delaunay.h"
#include "validation.h"

namespace pcl
{
namespace floater
{
Disc
makeDisc (Samples& samples, const Options& options, StageClock& clock, Report& report)
{
  Disc disc;
  const std::vector<Eigen::Vector3d>& positions = samples.set.positions;

  // Section 3: boundary points as one ordered loop.
  clock.start (Stage::BOUNDARY);
  disc.boundary = findBoundary (samples.set, samples.near, samples.stars, options);
  disc.problem = disc.boundary.problem;
  if (disc.problem)
    return disc;

  // Section 2.1: weights for all neighbours, if so wished; boundaries are told by Delaunay stars.
  if (options.neighborhood == Neighborhood::NEAREST || options.neighborhood == Neighborhood::BALL) {
    clock.start (Stage::WEIGHTS);
    samples.stars = makeStars (positions, samples.near, samples.stars.normals,
                               options.filter_sheets, options.threads, StarKind::ALL);
  }

  // Section 4, equations (1) to (3): weights, the loop on a convex curve, the linear system.
  const Parameterization parameterization =
      parameterize (positions, samples.near, samples.stars, disc.boundary.loop, options, clock,
                    report.statistics);
  reportParameterization (samples.set, parameterization, report);
  disc.problem = parameterization.problem;
  if (disc.problem)
    return disc;

  // Section 2: Delaunay triangulation of the parameters; the same triangles in space.
  clock.start (Stage::DELAUNAY);
  disc.mesh = triangulatePlane (parameterization.uv, disc.boundary.loop);

  // Beyond the report: what is too deep for double precision is laid out again, level by level.
  report.statistics.levels =
      layOutCollapsedRegions (disc.mesh, parameterization.uv, positions, samples.near,
                              samples.stars.normals, disc.boundary.loop, options)
          .levels;

  // Points that coincide in the plane come back, edges are flipped in space.
  clock.start (Stage::FLIPS);
  disc.finish =
      finishDisc (disc.mesh, samples.ownPositions (), samples.near, samples.stars.normals, options);
  disc.problem = disc.finish.problem;
  if (!disc.problem)
    disc.problem = checkDisc (disc.mesh.triangles, positions.size (), disc.boundary.loop);
  if (!disc.problem && faceOutwards (disc.mesh, samples.ownPositions ()) > 0)
    mirrorParameters (report);
  return disc;
}

} // namespace floater
} // namespace pcl
