// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of TW 385 in order, with its sections and equations.
#include "floater/floater_method.h"

#include "floater/planar_delaunay.h"
#include "floater/region_recursion.h"

#include <utility>

namespace pcl::floater {
namespace {
Problem
describeFolds (const Disc& disc)
{
  return {RunStatus::NOT_A_DISC,
          std::to_string (disc.finish.folds) + " of " +
              std::to_string (disc.mesh.triangles.size () * 3 / 2) +
              " edges are folded: the surface is not one disc with one boundary (it may be closed, "
              "have handles or several components, or be sampled too thinly); let the topology be "
              "chosen automatically, or reconstruct a part of the surface"};
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

  // Section 2.1: the weights may be for all neighbours; the boundary needed Delaunay stars.
  run.beginStage (Stage::WEIGHTS);
  StarSettings star_settings = settings.stars;
  if (settings.neighborhood == Neighborhood::NEAREST ||
      settings.neighborhood == Neighborhood::BALL) {
    star_settings.kind = StarKind::ALL;
    geometry.stars =
        makeStars (positions, geometry.neighbors, geometry.stars.normals, star_settings, run);
  }

  // Section 4, equations (1) to (3): weights, the loop on a convex curve, the linear system.
  // The normals are needed longer than the stars.
  std::vector<Eigen::Vector3f> normals = geometry.stars.normals;
  disc.parameterization = parameterize (positions, geometry.neighbors, std::move (geometry.stars),
                                        loop, settings.parameterization, run, settings.limits);
  geometry.stars = {};
  geometry.stars.normals = std::move (normals);
  disc.problem = disc.parameterization.problem;
  if (disc.problem)
    return disc;

  // Section 2: the triangles of the parameters are the triangles in space.
  run.beginStage (Stage::DELAUNAY);
  const std::vector<Eigen::Vector2d>& uv = disc.parameterization.uv;
  disc.mesh = triangulatePlane (uv, loop);

  // Beyond TW 385: collapsed regions are laid out again, level by level.
  if (!settings.as_published)
    disc.levels = layOutCollapsedRegions (disc.mesh, uv, positions, geometry.neighbors,
                                          geometry.stars.normals, loop, star_settings,
                                          settings.parameterization, run, settings.limits);

  // Beyond TW 385: points without a triangle, such as coinciding parameters, are inserted, and
  // edges are flipped in space.
  run.beginStage (Stage::FLIPS);
  disc.finish = finishMesh (disc.mesh, points.positions, geometry,
                            {settings.flip_edges, settings.limits.largest_fold_share,
                             settings.finish, settings.facing, !settings.as_published},
                            run);
  if (!disc.finish.is_repairable)
    disc.problem = describeFolds (disc);
  return disc;
}

} // namespace pcl::floater
