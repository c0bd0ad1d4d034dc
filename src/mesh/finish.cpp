// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/finish.h"

#include "mesh/flips.h"
#include "mesh/hole_filling.h"
#include "mesh/neck_cutting.h"
#include "mesh/trimming.h"

namespace pcl::floater {
namespace {
// Fractions of the stage's time at the end of these steps. Measured on clean clouds.
constexpr double AFTER_POINTS = 0.1, AFTER_FLIPS = 0.65;
// Rings around the zones that are made anew. With 3 again, 12 clouds and 200 generated bodies were
// the same.
constexpr int WIDEST = 3, WIDEST_AGAIN = 2;

// Fills small loops beside zones that were made anew. They are no openings.
std::size_t
fillPinholes (TriangleMesh& mesh, const Positions& positions, const std::vector<float>& spacing,
              const TriangleCost& cost, const Flags& is_remade, const RunContext& run)
{
  std::vector<BoundaryLoop> pinholes;
  const auto isBeside = [&] (std::vector<Index> points) {
    addRing (mesh, points);
    return std::any_of (points.begin (), points.end (),
                        [&] (Index p) { return is_remade[p] != 0; });
  };
  for (const std::vector<Index>& loop : boundaryLoops (mesh, run))
    if (loop.size () <= SMALL_LOOP && isBeside (loop))
      pinholes.push_back (measureLoop (loop, positions, spacing));
  return fillHoles (mesh, pinholes, positions, cost, run);
}

// Removes triangles at the boundary that cross others. Points that they leave join elsewhere.
// \return whether fewer cross then, and no point is lost; else the mesh stays as it was
bool
openOnce (TriangleMesh& mesh, const Positions& positions, const CsrLists& neighbors,
          CrossingPairs& crossing, const RunContext& run)
{
  if (crossing.empty () || !crossing.untested.empty ())
    return false;
  Flags is_chosen = chooseCrossingAtBoundary (mesh, crossing);
  if (is_chosen.empty ())
    return false;
  const auto countUnused = [&mesh] {
    return std::count (mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE);
  };
  std::vector<Triangle> before = mesh.triangles;
  const auto unused = countUnused ();
  removeTriangles (mesh, std::move (is_chosen), run);
  addMissingPoints (mesh, positions, neighbors, run);
  CrossingPairs after = findSelfIntersections (mesh.triangles, positions, run);
  if (after.size () < crossing.size () && after.untested.empty () && countUnused () <= unused) {
    crossing = std::move (after);
    return true;
  }
  mesh.triangles = std::move (before);
  mesh.connect (positions.size (), run);
  return false;
}
} // namespace

MeshFinish
finishMesh (TriangleMesh& mesh, const Positions& positions, LocalGeometry& geometry,
            const FinishSettings& settings, const RunContext& run)
{
  MeshFinish finish;
  Normals& normals = geometry.stars.normals;
  orientNormals (mesh, positions, normals, run);
  const TriangleCost cost (positions, normals, &geometry.meshSpacing ());
  run.beginStep (AFTER_POINTS);
  if (settings.add_points)
    addMissingPoints (mesh, positions, geometry.neighbors, run);
  run.beginStep (AFTER_FLIPS);
  if (settings.flip_edges)
    finish.flips = flipEdges (mesh, cost, run);
  finish.folds = findFolds (mesh, positions, run).size ();
  const double edges = 1.5 * static_cast<double> (mesh.triangles.size ());
  finish.is_repairable = !settings.flip_edges ||
                         static_cast<double> (finish.folds) <= settings.largest_fold_share * edges;
  if (settings.open_boundary) {
    openNotches (mesh, positions, run);
    if (finish.folds > 0)
      openBoundaryFolds (mesh, positions, run);
  }
  if (settings.repair && finish.is_repairable) {
    finish.crossing = findSelfIntersections (mesh.triangles, positions, run);
    finish.pairs_found = finish.crossing->size ();
    const auto remake = [&] (int widest) {
      if (!settings.remake_sheets || !finish.crossing->untested.empty () ||
          !remakeZones (mesh, positions, geometry, *finish.crossing, widest, finish.remade,
                        settings.closes_gaps, run))
        return false;
      std::size_t changes = addMissingPoints (mesh, positions, geometry.neighbors, run);
      if (settings.closes_gaps)
        changes += fillPinholes (mesh, positions, geometry.meshSpacing (), cost,
                                 finish.remade.is_remade, run);
      if (changes > 0)
        finish.crossing = findSelfIntersections (mesh.triangles, positions, run);
      return true;
    };
    const auto cut = [&] {
      const std::size_t cuts = cutNecks (mesh, positions, geometry, finish.remade.is_noisy, run);
      finish.necks_cut += cuts;
      if (cuts > 0)
        finish.crossing = findSelfIntersections (mesh.triangles, positions, run);
    };
    finish.remade.is_noise = settings.is_noise;
    if (!settings.is_noise)
      remake (WIDEST);
    const bool is_noise = finish.remade.is_noise;
    const auto givesUp = [&] {
      finish.gave_up = settings.gives_up && settings.gives_up (mesh, *finish.crossing);
      return finish.gave_up;
    };
    if (is_noise && givesUp ())
      return finish;
    if (!is_noise)
      cut ();
    if (finish.folds + finish.pairs_found + finish.remade.points () + finish.necks_cut > 0) {
      // With fewer flaws around, zones become smaller, and fewer of them touch. In noise no zone is
      // made anew: airborne scans keep 12 to 40 % fewer folds if none may come in for a crossing pair.
      const Repair first = is_noise ? Repair::AT_THE_END : Repair::BEFORE_REMAKING;
      if (repairMesh (mesh, positions, geometry, first, settings.limits, finish, run)
              .hasChanged () &&
          !is_noise && remake (WIDEST_AGAIN))
        cut ();
      if (!settings.are_points_added)
        repairMesh (mesh, positions, geometry, Repair::AT_THE_END, settings.limits, finish, run);
      if (!is_noise && givesUp ())
        return finish;
      if (settings.open_boundary)
        openCrossings (mesh, positions, geometry, settings.limits, finish, run);
    }
  }
  finish.facing = faceOutwards (mesh, positions, settings.facing, run);
  return finish;
}

Repairs
repairMesh (TriangleMesh& mesh, const Positions& positions, LocalGeometry& geometry, Repair kind,
            const RepairLimits& limits, MeshFinish& finish, const RunContext& run)
{
  // The triangles have changed; normals may have the wrong sign now.
  Normals& normals = geometry.stars.normals;
  orientNormals (mesh, positions, normals, run, finish.remade.is_remade);
  const Repairs done = repairFlaws (
      mesh, *finish.crossing, geometry.neighbors,
      TriangleCost (positions, normals, &geometry.meshSpacing ()), positions, kind,
      findRidges (mesh, positions, *finish.crossing, finish.remade.is_remade, run), limits, run);
  finish.repairs += done;
  return done;
}

void
openCrossings (TriangleMesh& mesh, const Positions& positions, LocalGeometry& geometry,
               const RepairLimits& limits, MeshFinish& finish, const RunContext& run)
{
  while (openOnce (mesh, positions, geometry.neighbors, *finish.crossing, run) &&
         !finish.remade.is_noise) // in noise, the repair would take as long as before
    repairMesh (mesh, positions, geometry, Repair::AT_THE_END, limits, finish, run);
}

} // namespace pcl::floater
