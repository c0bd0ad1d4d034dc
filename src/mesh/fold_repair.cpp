// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fold_repair.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/mesh_blocks.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>

namespace pcl::floater {
namespace {
// Nearest neighbours of the points of a block, within the block and numbered in it.
CsrLists
neighborsWithin (const CsrLists& neighbors, Index first, Index last)
{
  return makeCsrLists (last - first, [&] (const auto& emit) {
    for (Index p = first; p < last; ++p)
      for (const Index q : neighbors.row (p))
        if (q >= first && q < last)
          emit (p - first, q - first);
  });
}

// The corners of the triangles at some edges.
std::vector<Index>
verticesAt (const std::vector<MeshEdge>& edges, const TriangleMesh& mesh)
{
  std::vector<Index> vertices;
  for (const MeshEdge& e : edges)
    for (Index p : {mesh.corner (e), mesh.from (e), mesh.to (e), mesh.corner (mesh.mate (e))})
      vertices.push_back (p);
  sortUnique (vertices);
  return vertices;
}

// Number of allowed and of requested triangle costs.
struct Costs
{
  std::size_t most;
  std::atomic<std::size_t> asked{0};

  std::size_t left () const { return most - std::min (most, asked.load ()); }

  // The share of a block, by its vertices to move.
  std::size_t share (std::size_t vertices, std::size_t of_all) const
  {
    return static_cast<std::size_t> (static_cast<double> (most) * static_cast<double> (vertices) /
                                     static_cast<double> (of_all));
  }
};

// Moves vertices of a block, numbered in it. Reports which of them are done: their triangles are
// free, and their neighbours are all in the block.
std::size_t
moveInBlock (MeshBlock& block, const CsrLists& all_neighbors,
             const std::vector<RepairTarget>& targets, const std::vector<Index>& vertices,
             const TriangleCost& cost, const RepairLimits& limits, const RunContext& run,
             std::size_t most_costs, Costs& costs,
             const std::function<void (Index v, bool is_whole)>& tell)
{
  const CsrLists neighbors =
      neighborsWithin (all_neighbors, block.first,
                       block.first + static_cast<Index> (block.mesh.triangle_of.size ()));
  VertexRepair repair (block.mesh, neighbors, targets, cost, limits, run);
  const std::size_t moves = repair.moveAll (vertices, most_costs);
  costs.asked += repair.costs ();
  std::vector<Index> fan;
  for (const Index v : vertices) {
    block.mesh.fan (v, fan);
    tell (v, neighbors.row (v).size () == all_neighbors.row (block.first + v).size () &&
                 std::all_of (fan.begin (), fan.end (),
                              [&block] (Index t) { return block.mesh.isFree (t); }));
  }
  return moves;
}

// Moves vertices, ascending, in blocks of the mesh if there are several. Removes those that are
// done from the list. Returns the number of moves.
std::size_t
moveInBlocks (TriangleMesh& mesh, const CsrLists& neighbors,
              const std::vector<RepairTarget>& targets, const TriangleCost& cost,
              const RepairLimits& limits, const RunContext& run, std::vector<Index>& vertices,
              Costs& costs)
{
  const MeshBlocks blocks (mesh, run);
  if (vertices.empty () || blocks.count () == 1)
    return 0;
  std::vector<std::uint8_t> is_done (targets.size (), 0);
  std::atomic<std::size_t> moves{0};
  parallelTasks (run, blocks.count (), [&] (std::size_t b) {
    const Index first = blocks.first (b), last = blocks.last (b);
    std::vector<Index> inside (std::lower_bound (vertices.begin (), vertices.end (), first),
                               std::lower_bound (vertices.begin (), vertices.end (), last));
    if (inside.empty ())
      return;
    for (Index& v : inside)
      v -= first;
    MeshBlock block = blocks.cutOut (mesh, b);
    moves += moveInBlock (block, neighbors, {targets.begin () + first, targets.begin () + last},
                          inside, cost.countedFrom (first), limits, run.withThreads (1),
                          costs.share (inside.size (), vertices.size ()), costs,
                          [&] (Index v, bool is) { is_done[first + v] = is ? 1 : 0; });
    blocks.putBack (block, b, mesh);
  });
  vertices.erase (std::remove_if (vertices.begin (), vertices.end (),
                                  [&] (Index v) { return is_done[v] != 0; }),
                  vertices.end ());
  return moves;
}

} // namespace

std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const RunContext& run)
{
  const auto areaVectorOf = [&] (Index t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return areaVector (positions[a], positions[b], positions[c]);
  };
  // Sides of each triangle at which it is folded against one of a higher index, as bits.
  std::vector<std::uint8_t> sides (mesh.triangles.size (), 0);
  parallelRanges (run, sides.size (), [&] (std::size_t first, std::size_t last) {
    for (auto t = static_cast<Index> (first); t < last; ++t) {
      const Eigen::Vector3d own = areaVectorOf (t);
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index u = mesh.neighbors[t][side];
        if (u != NONE && t < u && isFold (own, areaVectorOf (u)))
          sides[t] = static_cast<std::uint8_t> (sides[t] | (1U << side));
      }
    }
  });
  std::vector<MeshEdge> folds;
  for (Index t = 0; t < sides.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (((sides[t] >> side) & 1U) != 0)
        folds.push_back ({t, side});
  return folds;
}

std::size_t
moveVertices (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
              const std::vector<Eigen::Vector3d>& positions, const RepairLimits& limits,
              const RunContext& run)
{
  const std::vector<RepairTarget> targets =
      findRepairTargets (mesh, positions, cost, limits.patch_points, run);
  std::vector<Index> bad;
  for (Index v = 0; v < targets.size (); ++v)
    if (targets[v] == RepairTarget::BAD || targets[v] == RepairTarget::SCATTERED)
      bad.push_back (v);
  Costs costs{std::max (limits.fewest_costs, limits.costs_of_moves * targets.size ())};
  const bool is_whole = mesh.is_fixed.empty () && mesh.is_partial.empty ();
  const std::size_t moves_in_blocks =
      is_whole ? moveInBlocks (mesh, neighbors, targets, cost, limits, run, bad, costs) : 0;
  VertexRepair repair (mesh, neighbors, targets, cost, limits, run);
  const std::size_t moves = repair.moveAll (std::move (bad), costs.left ());
  const std::size_t kicks = repair.kickAll (verticesAt (findFolds (mesh, positions, run), mesh));
  return moves_in_blocks + moves + kicks;
}

} // namespace pcl::floater
