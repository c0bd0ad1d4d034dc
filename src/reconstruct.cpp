// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method: the stages of TW 385 in order, with edge flips on the surface after them.
#include <pcl/surface/floater/reconstruct.h>

#include "boundary/boundary_loop.h"
#include "common/stage_clock.h"
#include "complex/surface_method.h"
#include "neighborhoods/ball_neighbors.h"
#include "neighborhoods/nearest_neighbors.h"
#include "neighborhoods/noise.h"
#include "neighborhoods/outliers.h"
#include "neighborhoods/stars.h"
#include "neighborhoods/tangent_planes.h"
#include "neighborhoods/working_set.h"
#include "parameterization/parameterize.h"
#include "parameterization/region_recursion.h"
#include "report_builder.h"
#include "triangulation/flips.h"
#include "triangulation/outward.h"
#include "triangulation/planar_delaunay.h"
#include "triangulation/surface_finish.h"
#include "validation.h"

#include <algorithm>
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

constexpr std::size_t LARGEST_SECOND_TRY = 300'000; // points; a second and half a GB

// What both methods work on.
struct Samples
{
  WorkingSet set;
  FlatLists near; // the nearest neighbours, or those in a ball
  Stars stars;
};

// A disc as TW 385 makes it.
struct Disc
{
  Boundary boundary;
  SurfaceMesh mesh;
  SurfaceFinish finish;
  std::size_t relinked = 0;
  Problem problem;
};

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
  positions = projectOntoPlanes (positions, samples.near, options.threads);
  samples.near = findNeighbors (samples.set, options, search);
}

// True if the options ask for the disc method.
bool
isDisc (const Options& options)
{
  return options.topology == Topology::DISC || !options.loop.empty ();
}

Problem
prepare (Input& input, const Options& options, StageClock& clock, Samples& samples, Report& report)
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
  samples.stars = makeStars (
      positions, samples.near, fitTangentPlanes (positions, samples.near, options.threads),
      options.filter_sheets, options.threads, StarKind::DELAUNAY, isDisc (options));
  return {};
}

// The whole of TW 385 but for the flips. Consumes the stars, not their normals.
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
    samples.stars = makeStars (positions, samples.near, std::move (samples.stars.normals),
                               options.filter_sheets, options.threads, StarKind::ALL);
  }

  // Section 4, equations (1) to (3): weights, the loop on a convex curve, the linear system.
  const Parameterization parameterization =
      parameterize (positions, samples.near, samples.stars, disc.boundary.loop, options, clock,
                    report.statistics);
  reportParameterization (samples.set, parameterization, report);
  disc.relinked = parameterization.relinked;
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
  disc.finish = finishDisc (disc.mesh, positions, samples.near, samples.stars.normals, options);
  disc.problem = disc.finish.problem;
  if (!disc.problem)
    disc.problem = checkDisc (disc.mesh.triangles, positions.size (), disc.boundary.loop);
  if (!disc.problem && faceOutwards (disc.mesh, positions) > 0)
    mirrorParameters (report);
  return disc;
}

// Beyond the report: the mesh as it is, whatever the stages think that they made.
Problem
examine (const Samples& samples, const SurfaceMesh& mesh, const Options& options, StageClock& clock,
         Report& report)
{
  clock.start (Stage::CHECK);
  const std::vector<float> spacing =
      localSpacing (samples.set.positions, samples.near, options.threads);
  return reportCheck (samples.set, checkMesh (mesh.triangles, samples.set, spacing), options,
                      report);
}

// Makes the mesh of a disc the result.
Problem
useDisc (const Samples& samples, const Disc& disc, const Options& options, StageClock& clock,
         Result& result)
{
  result.report.topology = Topology::DISC;
  reportBoundary (samples.set, disc.boundary, result.report);
  if (disc.problem)
    return disc.problem;
  result.triangles = reportMesh (samples.set, disc.mesh, disc.finish, result.report);
  return examine (samples, disc.mesh, options, clock, result.report);
}

std::size_t
countFlaws (const SurfaceMesh& mesh, const SurfaceFinish& finish)
{
  return finish.folds.size () + static_cast<std::size_t> (std::count (
                                    mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE));
}

double
costOf (const Samples& samples, const SurfaceMesh& mesh, const Options& options)
{
  const std::vector<Eigen::Vector3d>& positions = samples.set.positions;
  std::vector<Eigen::Vector3f> normals = samples.stars.normals;
  orientNormals (mesh, positions, normals);
  const std::vector<float> spacing = localSpacing (positions, samples.near, options.threads);
  return meshCost (mesh, TriangleCost (positions, normals, &spacing));
}

// Topology::AUTO: where the surface is one disc but came out with folds or without points, and is
// not too large for a second try, the disc method makes it, too. It is taken if that has fewer of
// these, and is the smoother one.
bool
isDiscBetter (Samples& samples, const Surface& surface, const Options& options, StageClock& clock,
              Report& report, Disc& disc)
{
  const std::size_t flaws = countFlaws (surface.mesh, surface.finish);
  if (options.topology != Topology::AUTO || !surface.is_one_disc || flaws == 0 ||
      samples.set.positions.size () > LARGEST_SECOND_TRY)
    return false;
  const Report before = report;
  clock.start (Stage::STARS);
  samples.stars = makeStars (samples.set.positions, samples.near, samples.stars.normals,
                             options.filter_sheets, options.threads);
  disc = makeDisc (samples, options, clock, report);
  clock.stop ();
  if (!disc.problem && countFlaws (disc.mesh, disc.finish) < flaws &&
      costOf (samples, disc.mesh, options) < costOf (samples, surface.mesh, options))
    return true;
  const auto seconds = report.statistics.seconds;
  const double total_seconds = report.statistics.total_seconds;
  report = before;
  report.statistics.seconds = seconds;
  report.statistics.total_seconds = total_seconds;
  return false;
}

Problem
reconstructAny (Input& input, const Options& options, Result& result)
{
  Report& report = result.report;
  report.statistics.cloud_points = input.cloud_size;
  report.statistics.selected_points = input.positions.size ();
  if (Problem problem = checkOptions (options))
    return problem;
  StageClock clock (report.statistics, options.progress);
  Samples samples;
  if (Problem problem = prepare (input, options, clock, samples, report))
    return problem;

  Disc disc;
  if (isDisc (options)) {
    report.topology_reason =
        options.topology == Topology::DISC ? "asked for" : "its boundary loop is given";
    disc = makeDisc (samples, options, clock, report);
    return useDisc (samples, disc, options, clock, result);
  }
  const Surface surface = makeSurface (samples.set.positions, samples.near, samples.stars,
                                       1.0 / samples.set.scale, options, clock);
  reportOneSided (samples.set, surface.cut, report);
  if (isDiscBetter (samples, surface, options, clock, report, disc)) {
    report.topology_reason = "one disc, laid out with fewer folds than by stars alone";
    return useDisc (samples, disc, options, clock, result);
  }
  report.topology = Topology::SURFACE;
  report.statistics.holes_filled = surface.holes_filled;
  result.triangles = reportMesh (samples.set, surface.mesh, surface.finish, report);
  return examine (samples, surface.mesh, options, clock, report);
}

} // namespace

Result
reconstruct (Input input, const Options& options)
{
  Result result;
  Problem problem;
  try {
    problem = reconstructAny (input, options, result);
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
