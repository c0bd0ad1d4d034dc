// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of the report in order, with its sections and equations.
#include "floater/floater_method.h"

#include "floater/planar_delaunay.h"
#include "floater/region_recursion.h"

#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// Share of all edges. Discs have up to 1 % of their edges folded before repair, closed surfaces
// that were pressed into a disc from 4 % (24 clouds).
constexpr double TOO_MANY_FOLDS = 0.03;

Problem
describeFolds (const Disc& disc)
{
  return {Status::NOT_A_DISC,
          std::to_string (disc.finish.folds) + " of " +
              std::to_string (disc.mesh.triangles.size () * 3 / 2) +
              " edges are folded: the surface is not one disc with one boundary (it may be closed, "
              "have handles, several parts, or be too thinly sampled); let the topology be chosen "
              "automatically, or reconstruct a part of it"};
}

} // namespace

Disc
makeDisc (const Points& points, LocalGeometry& geometry, Boundary boundary,
          const DiscSettings& settings, const RunContext& run)
{
  Disc disc;
  disc.boundary = std::move (boundary);
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  const std::vector<Index>& loop = disc.boundary.loop;

  // Section 2.1: weights for all neighbours, if so wished; boundaries are told by Delaunay stars.
  run.beginStage (Stage::WEIGHTS);
  StarSettings star_settings{settings.filter_sheets};
  if (settings.neighborhood == Neighborhood::NEAREST ||
      settings.neighborhood == Neighborhood::BALL) {
    star_settings.kind = StarKind::ALL;
    geometry.stars =
        makeStars (positions, geometry.neighbors, geometry.stars.normals, star_settings, run);
  }

  // Section 4, equations (1) to (3): weights, the loop on a convex curve, the linear system.
  std::vector<Eigen::Vector3f> normals = geometry.stars.normals;
  disc.parameterization = parameterize (positions, geometry.neighbors, std::move (geometry.stars),
                                        loop, settings.parameterization, run);
  geometry.stars = {};
  geometry.stars.normals = std::move (normals);
  disc.problem = disc.parameterization.problem;
  if (disc.problem)
    return disc;

  // Section 2: Delaunay triangulation of the parameters; the same triangles in space.
  run.beginStage (Stage::DELAUNAY);
  const std::vector<Eigen::Vector2d>& uv = disc.parameterization.uv;
  disc.mesh = triangulatePlane (uv, loop);

  // Beyond the report: what is too deep for double precision is laid out again, level by level.
  disc.levels =
      layOutCollapsedRegions (disc.mesh, uv, positions, geometry.neighbors, geometry.stars.normals,
                              loop, star_settings, settings.parameterization, run);

  // Points that coincide in the plane come back, edges are flipped in space.
  run.beginStage (Stage::FLIPS);
  disc.finish = finishMesh (disc.mesh, points.positions, geometry,
                            {settings.flip_edges, TOO_MANY_FOLDS}, run);
  if (!disc.finish.is_repairable)
    disc.problem = describeFolds (disc);
  return disc;
}

} // namespace floater
} // namespace pcl
