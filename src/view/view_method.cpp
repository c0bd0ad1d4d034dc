// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view_method.h"

#include "core/parallel.h"
#include "floater/planar_delaunay.h"
#include "mesh/check.h"
#include "mesh/hole_filling.h"
#include "mesh/trimming.h"

namespace pcl::floater {
namespace {
// Fills the loops that the policy does not keep. All loops are at a gap or a depth step.
std::size_t
closeHoles (TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
            const Viewpoint& viewpoint, const HoleOptions& holes, const RunContext& run)
{
  std::vector<BoundaryLoop> loops =
      findBoundaryLoops (mesh, findComponents (mesh, run), points.positions, spacing, run);
  // No point lies beyond any of them: the longest are kept.
  for (BoundaryLoop& loop : loops)
    loop.judgement.empty_length = loop.length;
  chooseOpenLoops (loops, holes, 1.0 / points.scale);
  Normals normals;
  normals.reserve (points.size ());
  for (const Vector3d& position : points.positions) {
    const Vector3d ray = viewpoint.is_far ? viewpoint.place : Vector3d (position - viewpoint.place);
    normals.emplace_back (-ray.normalized ().cast<float> ());
  }
  const TriangleCost cost (points.positions, normals);
  return fillHoles (mesh, loops, points.positions, cost, run);
}

// Unmarks short steps. A depth step is a closed line, or ends at a gap or another step; a few
// triangles alone are noise, unless they are all around a point, which may lie off the surface.
void
dropShortSteps (const TriangleMesh& mesh, const Flags& is_gap, std::size_t shortest, Flags& is_step)
{
  DisjointSets patches (is_step.size ());
  for (Index t = 0; t < is_step.size (); ++t)
    for (const Index other : mesh.neighbors[t])
      if (is_step[t] != 0 && other != NONE && is_step[other] != 0)
        patches.join (t, other);
  std::vector<Index> fan;
  std::vector<std::size_t> lengths (is_step.size (), 0); // of each patch, by its representative
  for (Index t = 0; t < is_step.size (); ++t)
    if (is_step[t] != 0) {
      const std::array<Index, 3>& beside = mesh.neighbors[t];
      bool is_long = std::any_of (beside.begin (), beside.end (), [&] (Index other) {
        return other == NONE || is_gap[other] != 0;
      });
      for (const Index p : mesh.triangles[t]) {
        mesh.fan (p, fan);
        is_long = is_long ||
                  std::all_of (fan.begin (), fan.end (), [&] (Index u) { return is_step[u] != 0; });
      }
      lengths[patches.find (t)] += is_long ? shortest : 1;
    }
  for (Index t = 0; t < is_step.size (); ++t)
    if (lengths[patches.find (t)] < shortest)
      is_step[t] = 0;
}

// The front of each component: towards the sensor, unless it is far away.
MeshFacing
faceInView (TriangleMesh& mesh, const Points& points, const Viewpoint& viewpoint, FacingHints hints,
            const RunContext& run)
{
  hints.is_one_view = viewpoint.is_far;
  hints.faces_sensor = !viewpoint.is_far;
  const bool by_view = hints.wanted == Facing::AUTO && hints.normals == nullptr;
  if (!viewpoint.is_far)
    hints.sensor = viewpoint.place;
  else if (hints.wanted != Facing::VIEWPOINT)
    hints.sensor.reset ();
  if (!by_view || viewpoint.is_far || boundaryEdges (mesh).empty ())
    return faceOutwards (mesh, points.positions, hints, run);
  MeshFacing facing; // oriented like the view
  FacingObject& all = facing.objects.emplace_back ();
  all.rule = FacingRule::SENSOR;
  all.triangles = mesh.triangles.size ();
  all.at = mesh.triangles.front ()[0];
  return facing;
}

} // namespace

Sight
sightFrom (const Points& points, const Viewpoint& viewpoint, bool is_told, const RunContext& run)
{
  constexpr std::size_t FEWEST_PATCHES = 4; // that a cloud must fill to be recognised
  // Largest DensityEvidence::hidden_share of a scan whose place is told, such as one with much
  // noise after a voxel filter, 0.018. Bodies seen from outside have 0.1 and more.
  constexpr double HIDDEN = 0.03;
  const Positions& positions = points.positions;
  const bool are_enough = positions.size () >= FEWEST_PATCHES * PATCH_POINTS;
  if ((!are_enough && !is_told) || looksToAllSides (positions, viewpoint))
    return Sight::NO;
  const std::vector<RayPatch> patches = findRayPatches (positions, viewpoint, run);
  const RayEvidence rays = findRayEvidence (positions, patches, viewpoint, run);
  if (are_enough && isSeenFromThere (rays))
    return Sight::CERTAIN;
  // Twice as many: densities are without points at the sensor.
  const bool may_be = are_enough && rays.nearShare () <= 2.0 * CROSSING_SHARE;
  const bool is_likely =
      is_told || (are_enough && areOutlinesClear (positions, patches, viewpoint, run));
  if (!may_be && !is_likely)
    return Sight::NO;
  const DensityEvidence densities = findDensityEvidence (positions, patches, viewpoint, run);
  if (may_be && explainsDensity (positions, densities, viewpoint, DENSITY_REGULARITY, run))
    return Sight::CERTAIN;
  return is_likely && densities.hidden_share <= HIDDEN ? Sight::POSSIBLE : Sight::NO;
}

ViewSurface
makeViewSurface (const Points& points, const Viewpoint& viewpoint, const Options& options,
                 const ViewLimits& limits, FacingHints hints, const RunContext& run)
{
  // Points; smaller components are left out with the outliers. A point and the rays around it are 7 or 9.
  constexpr std::size_t SMALLEST_PART = 12;
  ViewSurface surface;
  TriangleMesh& mesh = surface.mesh;
  run.beginStage (Stage::DELAUNAY);
  const Rays rays = makeRays (points.positions, viewpoint, run);
  mesh = triangulateHull (rays.places);
  // Sorts triangles canonically, since later results depend on their order. Each begins with its
  // smallest corner; sorted by this and the next one, so along the curve of the points.
  for (Triangle& t : mesh.triangles)
    std::rotate (t.begin (), std::min_element (t.begin (), t.end ()), t.end ());
  sortInParallel (mesh.triangles.begin (), mesh.triangles.end (), std::less<> (), run);
  mesh.connect (points.size (), run);

  run.beginStage (Stage::HOLES);
  Flags is_left_out = findGaps (mesh, rays, run);
  Flags is_step = findDepthSteps (mesh, rays, run);
  dropShortSteps (mesh, is_left_out, limits.shortest_step, is_step);
  surface.is_at_step.assign (points.size (), 0);
  for (std::size_t t = 0; t < is_step.size (); ++t) {
    surface.gaps += is_left_out[t];
    if (is_left_out[t] != 0 || is_step[t] == 0)
      continue;
    is_left_out[t] = 1;
    ++surface.steps;
    for (const Index p : mesh.triangles[t])
      surface.is_at_step[p] = 1;
  }
  removeTriangles (mesh, std::move (is_left_out), run);

  run.beginStage (Stage::FLIPS);
  if (options.flip_edges)
    surface.finish.flips = flipInView (mesh, rays, points.positions, run);
  surface.spacing = spacingOfMesh (mesh, points.positions, run);
  TrimmingOptions bridges;
  bridges.maximum_edge_ratio = limits.longest_edge;
  surface.steps += trimMesh (mesh, points, surface.spacing, bridges, run).triangles;
  if (options.remove_outliers)
    removeSmallComponents (mesh, SMALLEST_PART, run);
  if (options.holes.policy != HolePolicy::AUTO)
    surface.holes_filled =
        closeHoles (mesh, points, surface.spacing, viewpoint, options.holes, run);
  surface.finish.facing = faceInView (mesh, points, viewpoint, std::move (hints), run);
  return surface;
}

} // namespace pcl::floater
