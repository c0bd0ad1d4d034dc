// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/loops.h"

#include "mesh/open_boundary.h"
#include "mesh/trimming.h"

#include <tuple>

namespace pcl::floater {
namespace {
// Triangles over holes, each with its loop.
using TrianglesOverHoles = std::vector<std::pair<Index, Index>>;

// The loops that follow from the removal of triangles, in the places of those that they replace; the
// other places have no points.
std::vector<BoundaryLoop>
widenedLoops (const TriangleMesh& widened, const std::vector<BoundaryLoop>& loops,
              const std::vector<Index>& loop_of, const Positions& positions,
              const std::vector<float>& spacing, const RunContext& run)
{
  std::vector<BoundaryLoop> found (loops.size ());
  for (std::vector<Index>& points : boundaryLoops (widened, run)) {
    const auto at = std::find_if (points.begin (), points.end (),
                                  [&loop_of] (Index p) { return loop_of[p] != NONE; });
    if (at == points.end () || points == loops[loop_of[*at]].points)
      continue;
    const Index own = loop_of[*at];
    found[own] = measureLoop (std::move (points), positions, spacing);
    found[own].component = loops[own].component;
  }
  return found;
}

void
removeOver (const TrianglesOverHoles& over, TriangleMesh& mesh, const RunContext& run)
{
  Flags is_removed (mesh.triangles.size (), 0);
  for (const auto& [triangle, loop] : over)
    is_removed[triangle] = 1;
  removeTriangles (mesh, std::move (is_removed), run);
}

// Triangles at loops that are too large for the sampling around: no point lies in the circumcircle of
// a triangle, and the largest such circle depends on how even the sampling is: for Poisson disks its
// radius is at most the mean edge, among random points about twice that. A triangle is one if it has a
// boundary edge or a neighbour that is one; its other corner must be inside, so that the mesh without
// them is a manifold with the same points, components, loops and genus. O(n).
//
// Measured on 300 generated surfaces: of windows 4 to 8 spacings wide 76 % stay open instead of 70 %,
// of narrower ones 39 % instead of 13 %, and no more of 2050 gaps of the sampling than before.
// \return ring by ring
TrianglesOverHoles
findOverHoles (const TriangleMesh& mesh, const std::vector<BoundaryLoop>& loops,
               const std::vector<LoopEvidence>& evidence, const std::vector<Index>& loop_of,
               const Positions& positions)
{
  constexpr std::size_t MOST_RINGS = 3; // that are removed, from the loop on
  // A circumradius may reach the mean edge two rings into the surface; or, where the sampling is
  // uneven, EVENNESS times that edge, plus SPREAD times LoopEvidence::irregularity times it.
  constexpr double EVENNESS = 0.4, SPREAD = 4.0;
  BoundaryPeel peel{mesh};
  std::vector<std::pair<MeshEdge, Index>> edges, next; // of the ring, with their loops
  for (const MeshEdge e : boundaryEdges (mesh))
    if (const Index loop = loop_of[mesh.from (e)];
        loop != NONE && !loops[loop].judgement.staysOpen ())
      edges.emplace_back (e, loop);
  TrianglesOverHoles over;
  for (std::size_t ring = 0; ring < MOST_RINGS && !edges.empty (); ++ring, edges.swap (next)) {
    std::vector<std::tuple<double, MeshEdge, Index>> large;
    for (const auto& [e, loop] : edges) {
      const auto& [a, b, c] = mesh.triangles[e.triangle];
      const double radius = circumradius (positions[a], positions[b], positions[c]);
      const double most = EVENNESS + SPREAD * evidence[loop].irregularity;
      if (radius > evidence[loop].edge * std::max (1.0, most))
        large.emplace_back (radius, e, loop);
    }
    std::stable_sort (large.begin (), large.end (), [] (const auto& a, const auto& b) {
      return std::get<0> (a) > std::get<0> (b);
    });
    next.clear ();
    for (const auto& [radius, e, loop] : large) {
      if (!peel.mayTake (e))
        continue;
      peel.take (e);
      over.emplace_back (e.triangle, loop);
      for (const std::uint8_t side : {TriangleMesh::next (e.side), TriangleMesh::previous (e.side)})
        if (const MeshEdge beyond = mesh.mate ({e.triangle, side}); beyond.triangle != NONE)
          next.emplace_back (beyond, loop);
    }
  }
  return over;
}

} // namespace

void
widenHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
            const LocalGeometry& geometry, const RunContext& run)
{
  // Of a widened loop that stays open, at least; 4 to 1: it is chosen among many for looking open, and
  // a gap that is opened counts as four windows that are filled.
  constexpr double LEAST_LOG_ODDS = 1.39;
  const std::vector<LoopEvidence> evidence = judgeLoops (mesh, loops, positions, geometry, run);
  std::vector<Index> loop_of (positions.size (), NONE); // of each point on one
  for (Index i = 0; i < loops.size (); ++i)
    for (const Index p : loops[i].points)
      loop_of[p] = i;
  TrianglesOverHoles over = findOverHoles (mesh, loops, evidence, loop_of, positions);
  std::vector<BoundaryLoop> wide (loops.size ());
  if (!over.empty ()) {
    TriangleMesh widened = mesh;
    removeOver (over, widened, run);
    wide = widenedLoops (widened, loops, loop_of, positions, geometry.spacing, run);
    judgeLoops (widened, wide, positions, geometry, run);
  }
  std::vector<BoundaryLoop*> best;
  for (Index i = 0; i < loops.size (); ++i)
    best.push_back (wide[i].points.empty () ? &loops[i] : &wide[i]);
  judgeTogether (best);
  over.erase (std::remove_if (over.begin (), over.end (),
                              [&] (const auto& one) {
                                return wide[one.second].judgement.log_odds < LEAST_LOG_ODDS;
                              }),
              over.end ());
  if (over.empty ())
    return;
  removeOver (over, mesh, run);
  for (const auto& [triangle, loop] : over)
    if (!wide[loop].points.empty ()) // not yet moved
      loops[loop] = std::move (wide[loop]);
}

} // namespace pcl::floater
