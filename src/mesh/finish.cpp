// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/finish.h"

#include "mesh/crossing_table.h"
#include "mesh/flips.h"
#include "mesh/hole_filling.h"
#include "mesh/neck_cutting.h"
#include "mesh/trimming.h"
#include "mesh/zone_splicing.h"

namespace pcl::floater {
namespace {
// Fraction of the stage's time at the end of this step. Measured on clean clouds.
constexpr double AFTER_FLIPS = 0.65;
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
  CrossingPairs after = pairsAfterChange (mesh, positions, before, crossing, run);
  if (after.size () < crossing.size () && after.untested.empty () && countUnused () <= unused) {
    crossing = std::move (after);
    return true;
  }
  mesh.triangles = std::move (before);
  mesh.connect (positions.size (), run);
  return false;
}

struct MeshFinisher
{
  TriangleMesh& mesh;
  const Positions& positions;
  LocalGeometry& geometry;
  const FinishSettings& settings;
  const RunContext& run;
  Normals& normals = geometry.stars.normals;
  TriangleCost cost{positions, normals, &geometry.meshSpacing ()};
  MeshFinish finish = {};

  void finishAll ()
  {
    run.beginStep (AFTER_FLIPS);
    begin (mesh);
    const double edges = 1.5 * static_cast<double> (mesh.triangles.size ());
    finish.is_repairable = !settings.flip_edges || static_cast<double> (finish.folds) <=
                                                       settings.largest_fold_share * edges;
    if (settings.repair && finish.is_repairable) {
      finish.crossing = findSelfIntersections (mesh.triangles, positions, run);
      finish.pairs_found = finish.crossing->size ();
      cure ();
      if (settings.other && !finish.remade.is_noise && takeOther ())
        cure ();
      finish.remade.is_settled.clear ();
      if (settings.open_boundary)
        openCrossings (mesh, positions, geometry, settings.limits, finish, run);
    }
    finish.facing = faceOutwards (mesh, positions, settings.facing, run);
  }

  void begin (TriangleMesh& begun)
  {
    orientNormals (begun, positions, normals, run);
    if (settings.add_points)
      addMissingPoints (begun, positions, geometry.neighbors, run);
    if (settings.flip_edges)
      finish.flips = flipEdges (begun, cost, run);
    finish.folds = findFolds (begun, positions, run).size ();
    if (settings.open_boundary) {
      openNotches (begun, positions, run);
      if (finish.folds > 0)
        openBoundaryFolds (begun, positions, run);
    }
  }

  void cure ()
  {
    remake (WIDEST);
    const bool is_noise = finish.remade.is_noise;
    if (!is_noise)
      cut ();
    else if (settings.other) // before the repair, which takes most of the time in noise
      takeOther ();
    if (finish.folds + finish.pairs_found + finish.remade.points () + finish.necks_cut == 0)
      return;
    // With fewer flaws around, zones become smaller, and fewer of them touch. In noise no zone is
    // made anew: airborne scans keep 12 to 40 % fewer folds if none may come in for a crossing pair.
    const Repair first = is_noise ? Repair::AT_THE_END : Repair::BEFORE_REMAKING;
    if (repairMesh (mesh, positions, geometry, first, settings.limits, finish, run).hasChanged () &&
        !is_noise && remake (WIDEST_AGAIN))
      cut ();
    if (!settings.are_points_added)
      repairMesh (mesh, positions, geometry, Repair::AT_THE_END, settings.limits, finish, run);
  }

  // \return whether any zone was made anew
  bool remake (int widest)
  {
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
  }

  void cut ()
  {
    const RemadeZones& remade = finish.remade;
    const std::size_t cuts =
        cutNecks (mesh, positions, geometry,
                  remade.is_settled.empty () ? remade.is_noisy : remade.is_settled, run);
    finish.necks_cut += cuts;
    if (cuts > 0)
      finish.crossing = findSelfIntersections (mesh.triangles, positions, run);
  }

  // Takes the other mesh where triangles cross, and in noise all of it. What is far from there is settled. Not
  // twice: the places of the first time may turn out to be noise.
  bool takeOther ()
  {
    if (finish.crossing->empty () || !finish.remade.is_settled.empty ())
      return false;
    Flags is_chosen (positions.size (), 0);
    for (const CrossingPair& pair : *finish.crossing)
      for (const Index t : {pair.first, pair.second})
        for (const Index p : mesh.triangles[t])
          is_chosen[p] = 1;
    TriangleMesh other = settings.other (is_chosen);
    if (other.triangles.empty ())
      return false;
    begin (other);
    if (finish.remade.is_noise) {
      mesh = std::move (other);
      finish.crossing = findSelfIntersections (mesh.triangles, positions, run);
      finish.remade.is_remade.clear ();
    }
    else {
      std::vector<std::optional<NewZone>> places = placesOf (other, mesh, is_chosen);
      std::vector<Triangle> before = spliceZones (mesh, places);
      mesh.triangles.swap (before);
      mesh.connect (positions.size (), run);
      finish.crossing = pairsAfterChange (mesh, positions, before, *finish.crossing, run);
      for (const std::uint8_t comes : is_chosen)
        finish.remade.is_settled.push_back (comes ^ 1U);
      for (std::size_t p = 0; p < finish.remade.is_remade.size (); ++p)
        finish.remade.is_remade[p] &= finish.remade.is_settled[p];
    }
    return true;
  }
};
} // namespace

MeshFinish
finishMesh (TriangleMesh& mesh, const Positions& positions, LocalGeometry& geometry,
            const FinishSettings& settings, const RunContext& run)
{
  MeshFinisher finisher{mesh, positions, geometry, settings, run};
  finisher.finishAll ();
  return std::move (finisher.finish);
}

Repairs
repairMesh (TriangleMesh& mesh, const Positions& positions, LocalGeometry& geometry, Repair kind,
            const RepairLimits& limits, MeshFinish& finish, const RunContext& run)
{
  // The triangles have changed; normals may have the wrong sign now.
  Normals& normals = geometry.stars.normals;
  orientNormals (mesh, positions, normals, run, finish.remade.is_remade);
  const Repairs done =
      repairFlaws (mesh, *finish.crossing, geometry.neighbors,
                   TriangleCost (positions, normals, &geometry.meshSpacing ()), positions, kind,
                   findRidges (mesh, positions, *finish.crossing, finish.remade.is_remade, run),
                   finish.remade.is_settled, limits, run);
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
