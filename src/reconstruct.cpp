// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method: the stages of TW 385 in order, with edge flips on the surface after them.
#include <pcl/surface/floater/reconstruct.h>

#include "boundary/boundary_loop.h"
#include "common/stage_clock.h"
#include "neighborhoods/ball_neighbors.h"
#include "neighborhoods/nearest_neighbors.h"
#include "neighborhoods/stars.h"
#include "neighborhoods/tangent_planes.h"
#include "neighborhoods/working_set.h"
#include "parameterization/parameterize.h"
#include "report_builder.h"
#include "triangulation/planar_delaunay.h"
#include "triangulation/surface_finish.h"
#include "validation.h"

#include <new>

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

Problem
reconstructDisc (Input& input, const Options& options, Result& result)
{
  Report& report = result.report;
  Statistics& statistics = report.statistics;
  statistics.cloud_points = input.cloud_size;
  statistics.selected_points = input.positions.size ();
  if (Problem problem = checkOptions (options))
    return problem;
  StageClock clock (statistics, options.progress);

  // Section 2.1: N finite, distinct points.
  clock.start (Stage::WORKING_SET);
  const WorkingSet set = makeWorkingSet (input.positions, input.cloud_index, options.threads);
  std::vector<Eigen::Vector3d> ().swap (input.positions);
  reportWorkingSet (set, report);
  if (Problem problem = checkWorkingSet (set))
    return problem;

  // Sections 5 and 6: the same neighbours, the k nearest or those in a ball, serve boundary and
  // weights alike.
  clock.start (Stage::NEIGHBORS);
  FlatLists near = findNeighbors (set, options, input.search);

  // Section 4.1: Delaunay neighbourhoods in the tangent planes.
  clock.start (Stage::STARS);
  Stars stars =
      makeStars (set.positions, near, fitTangentPlanes (set.positions, near, options.threads),
                 options.filter_sheets, options.threads);

  // Section 3: boundary points as one ordered loop.
  clock.start (Stage::BOUNDARY);
  const Boundary boundary = findBoundary (set, near, stars, options);
  reportBoundary (set, boundary, report);
  if (boundary.problem)
    return boundary.problem;

  // Section 2.1: weights for all neighbours, if so wished; boundaries are told by Delaunay stars.
  if (options.neighborhood == Neighborhood::NEAREST || options.neighborhood == Neighborhood::BALL) {
    clock.start (Stage::WEIGHTS);
    stars = makeStars (set.positions, near, std::move (stars.normals), options.filter_sheets,
                       options.threads, StarKind::ALL);
  }

  // Section 4, equations (1) to (3): weights, the loop on a convex curve, the linear system.
  const Parameterization parameterization =
      parameterize (set.positions, near, stars, boundary.loop, options, clock, statistics);
  reportParameterization (set, parameterization, report);
  if (parameterization.problem)
    return parameterization.problem;

  // Section 2: Delaunay triangulation of the parameters; the same triangles in space.
  clock.start (Stage::DELAUNAY);
  SurfaceMesh mesh = triangulatePlane (parameterization.uv, boundary.loop);

  // Beyond the report: points that coincide in the plane come back, edges are flipped in space.
  clock.start (Stage::FLIPS);
  const SurfaceFinish finish = finishSurface (mesh, set.positions, near, stars.normals, options);
  if (finish.problem)
    return finish.problem;
  result.triangles = reportMesh (set, mesh, finish, report);
  return checkDisc (mesh.triangles, set.positions.size (), boundary.loop);
}

} // namespace

Result
reconstruct (Input input, const Options& options)
{
  Result result;
  Problem problem;
  try {
    problem = reconstructDisc (input, options, result);
  }
  catch (const std::bad_alloc&) {
    problem = {Status::OUT_OF_MEMORY,
               "not enough memory: use fewer points, or a machine with more"};
  }
  catch (const std::exception& error) {
    problem = {Status::INTERNAL_ERROR, std::string ("unexpected error: ") + error.what ()};
  }
  result.report.status = problem.status;
  if (problem) {
    result.triangles.clear ();
    result.report.message = std::move (problem.message);
  }
  return result;
}

} // namespace floater
} // namespace pcl
