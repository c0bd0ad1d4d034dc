// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus_method.h"

#include "core/parallel.h"
#include "mesh/hole_filling.h"

#include <map>

namespace pcl::floater {
namespace {
// Finds where a one-sided surface was cut open: the longest row of contradicting triangles that
// are connected by edges, if it is long enough. An orientation that spreads round such a surface
// contradicts itself along a whole row across it; a wrong triangle between two sheets stands
// alone, and where thin sheets are glued, there are many short rows. Fails for strips less than
// about 4 spacings wide: their rows are too short. O(m log m) for m triangles.
// \param contradicting see Consensus::seam
// \return the triangles of the row, in the order of `contradicting`; empty if it is too short
std::vector<Triangle>
findOrientationSeam (const std::vector<Triangle>& contradicting)
{
  // Scans of two-sided surfaces had rows of up to 5, Moebius strips 4 spacings wide rows of 8, and
  // strips 12 spacings wide rows of 37.
  constexpr std::size_t SHORTEST_SEAM = 8;
  DisjointSets rows (contradicting.size ());
  std::map<std::pair<Index, Index>, Index> triangle_at; // each edge
  for (Index t = 0; t < contradicting.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge = std::minmax (contradicting[t][i], contradicting[t][(i + 1) % 3]);
      if (const auto [other, is_new] = triangle_at.emplace (edge, t); !is_new)
        rows.join (t, other->second);
    }
  std::vector<std::size_t> length (contradicting.size (), 0);
  for (Index t = 0; t < contradicting.size (); ++t)
    ++length[rows.find (t)];
  const auto longest = std::max_element (length.begin (), length.end ());
  std::vector<Triangle> row;
  // Of that length. Moebius strips, noisy or at random, have up to 4.1, glued leaves 6.4.
  constexpr std::size_t MOST_ROWS = 5;
  if (longest == length.end () || *longest < SHORTEST_SEAM ||
      MOST_ROWS * *longest < contradicting.size ())
    return row;
  const auto root = static_cast<Index> (longest - length.begin ());
  for (Index t = 0; t < contradicting.size (); ++t)
    if (rows.find (t) == root)
      row.push_back (contradicting[t]);
  return row;
}

// Makes the manifold part of the consensus, before its holes are filled, and orients the normals like
// it. O(n + m log m) for m doubtful candidates.
// \param geometry as of makeSurface ()
void
makeConsensusMesh (Surface& surface, const Positions& positions, LocalGeometry& geometry,
                   const RunContext& run)
{
  // Mean normals at sharp edges, where both faces are visible from them.
  Normals normals = std::move (geometry.stars.normals);
  constexpr double EDGE = 0.9; // cosine, 26 degrees, between own and mean normal there
  Normals smoothed (normals.size ());
  parallelPoints (run, normals.size (), [&] (Index p) {
    const Vector3f mean = meanNormal (positions, geometry.neighbors, normals, p).cast<float> ();
    smoothed[p] = std::abs (mean.dot (normals[p])) < EDGE ? mean : normals[p];
  });
  std::vector<Candidate> candidates =
      findCandidates (positions, geometry.stars, smoothed, geometry.spacing, run);
  geometry.stars = {};
  Consensus consensus = buildConsensus (positions, std::move (candidates), smoothed, run);
  surface.orientation_seam = findOrientationSeam (consensus.seam);
  surface.mesh = manifoldPart (std::move (consensus), positions, smoothed, geometry.neighbors,
                               SMALLEST_ISLAND, run);
  for (std::size_t p = 0; p < normals.size (); ++p)
    if (normals[p].dot (smoothed[p]) < 0.0F)
      normals[p] = -normals[p];
  geometry.stars.normals = std::move (normals);
}

// Decides which loops stay open, and widens those by the automatic policy (see widenHoles). O(n) plus
// judgeLoops ().
std::vector<BoundaryLoop>
chooseLoops (TriangleMesh& mesh, const Points& points, const LocalGeometry& geometry,
             const HoleOptions& holes, const RunContext& run)
{
  const Positions& positions = points.workingPositions ();
  std::vector<BoundaryLoop> loops =
      findBoundaryLoops (mesh, findComponents (mesh, run), positions, geometry.spacing, run);
  if (holes.policy == HolePolicy::AUTO)
    widenHoles (mesh, loops, positions, geometry, run);
  else
    judgeLoops (mesh, loops, positions, geometry, run);
  chooseOpenLoops (loops, holes, 1.0 / points.scale);
  return loops;
}

// Orients the normals of points without triangle like the mean normal of the vertices among their
// neighbours.
void
orientMissingNormals (const TriangleMesh& mesh, const CsrLists& neighbors, Normals& normals,
                      const RunContext& run)
{
  ProgressLoop progress (run);
  for (Index p = 0; p < normals.size (); ++p) {
    progress.next ();
    if (mesh.triangle_of[p] != NONE)
      continue;
    Vector3f sum = Vector3f::Zero ();
    for (const Index q : neighbors.row (p))
      if (mesh.triangle_of[q] != NONE)
        sum += normals[q];
    if (normals[p].dot (sum) < 0.0F)
      normals[p] = -normals[p];
  }
}

// Leaves out the loops that were to stay open, but are no boundary any more.
void
leaveOutClosed (const TriangleMesh& mesh, std::vector<BoundaryLoop>& loops)
{
  const Flags is_boundary = boundaryPoints (mesh);
  const auto isClosed = [&is_boundary] (const BoundaryLoop& loop) {
    return loop.keep_open && std::any_of (loop.points.begin (), loop.points.end (),
                                          [&] (Index p) { return is_boundary[p] == 0; });
  };
  loops.erase (std::remove_if (loops.begin (), loops.end (), isClosed), loops.end ());
}

} // namespace

Surface
makeSurface (const Points& points, LocalGeometry& geometry, const HoleOptions& holes,
             FinishSettings finish, const RunContext& run)
{
  const Positions& positions = points.workingPositions ();
  Surface surface;
  TriangleMesh& mesh = surface.mesh;
  run.beginStage (Stage::CONSENSUS);
  makeConsensusMesh (surface, positions, geometry, run);

  run.beginStage (Stage::HOLES);
  std::vector<BoundaryLoop> loops = chooseLoops (mesh, points, geometry, holes, run);
  const std::size_t before = mesh.triangles.size ();
  fillHoles (mesh, loops, positions, TriangleCost (positions, geometry.stars.normals), run);
  orientMissingNormals (mesh, geometry.neighbors, geometry.stars.normals, run);

  run.beginStage (Stage::FLIPS);
  finish.open_boundary = true;
  finish.remake_sheets = finish.repair;
  finish.are_points_added = !points.stacked.of.empty ();
  finish.closes_gaps = holes.policy == HolePolicy::AUTO || holes.policy == HolePolicy::CLOSE_ALL;
  if (finish.repair && mesh.triangles.size () > before)
    finish.other = [&, filled = mesh.triangles] (Flags& is_chosen) {
      return refillCrossed (filled, before, loops, is_chosen, holes.policy == HolePolicy::AUTO,
                            positions, TriangleCost (positions, geometry.stars.normals), run);
    };
  const std::vector<Index> noisy = indicesWhere (points.projected.size (), [&] (Index p) {
    return points.projected[p] != points.positions[p];
  });
  if (finish.other && 4 * noisy.size () > points.size ()) { // hardly any zone is made anew
    Flags is_chosen (points.size (), 1);
    if (TriangleMesh other = finish.other (is_chosen); !other.triangles.empty ())
      mesh = std::move (other);
    finish.other = {};
  }
  surface.finish = finishMesh (mesh, points.positions, geometry, finish, run);
  for (BoundaryLoop& loop : loops) {
    surface.holes_filled += loop.keep_open ? 0 : 1;
    if (isDoubtful (loop.judgement))
      surface.doubtful_loops.push_back (std::move (loop));
  }
  if (surface.finish.remade.points () > 0)
    leaveOutClosed (mesh, surface.doubtful_loops);
  return surface;
}

} // namespace pcl::floater
