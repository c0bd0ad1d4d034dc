// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/flaw_repair.h"

#include "mesh/crossing_table.h"
#include "mesh/vertex_mover.h"

#include <random>

namespace pcl::floater {
namespace {
constexpr std::size_t TESTS_PER_REBUILT_VERTEX = 100; // in the same time, about 11 microseconds

// Whether a triangle is flawed, apart from those it crosses.
// \param normal of a triangle, of any length
template <typename Normal>
bool
isFlawed (const TriangleMesh& mesh, const TriangleCost& cost, Index t, Repair repair,
          const Ridges& ridges, Normal&& normal)
{
  const bool bad = repair == Repair::BEFORE_REMAKING;
  if (bad && (cost.isTurned (mesh.triangles[t]) || cost.isFlat (mesh.triangles[t])))
    return true;
  const Vector3d own = normal (t);
  for (std::uint8_t side = 0; side < 3; ++side)
    if (const Index u = mesh.neighbors[t][side]; u != NONE) {
      const Vector3d other = normal (u);
      if ((bad ? own.dot (other) < 0.0 : isFold (own, other)) &&
          !ridges.has (mesh.from ({t, side}), mesh.to ({t, side})))
        return true;
    }
  return false;
}

struct FlawRepair
{
  TriangleMesh& mesh;
  Repair repair;
  const Ridges& ridges;
  const RepairLimits& limits;
  const RunContext& run;
  Flags is_flawed; // of each triangle, see isFlawed
  CrossingTable& table;
  VertexMover& mover;
  std::size_t most_tests =
      (repair == Repair::AT_THE_END ? 3 : 1) *
      std::max (limits.fewest_tests, mesh.triangles.size () * limits.tests_per_triangle);
  std::uint32_t step = 1; // number of kept changes, from 1 on
  // Of each triangle: the last step that changed it.
  std::vector<std::uint32_t> changed_in = std::vector<std::uint32_t> (mesh.triangles.size (), 1);
  // Of each vertex: the step after which it was tried.
  std::vector<std::uint32_t> tried_in = std::vector<std::uint32_t> (mesh.triangle_of.size (), 0);
  // Last tries at triangles: by flips, and by rebuilding.
  std::unordered_map<Index, std::uint32_t> flips_tried_in = {}, rebuild_tried_in = {};
  std::size_t rebuilt_vertices = 0; // removed and reinserted in all trials
  Repairs done = {};
  std::vector<Index> fan = {};
  std::vector<Index> changed = {}; // triangles, ascending

  Repairs repairAll ()
  {
    for (std::size_t pass = 0; pass < limits.passes && !isSpent (); ++pass) {
      const std::uint32_t before = step;
      flipAll ();
      moveAll ();
      if (step == before)
        rebuildAll ();
      if (step == before)
        break;
    }
    return done;
  }

  bool isSpent () const
  {
    return table.tests () + TESTS_PER_REBUILT_VERTEX * rebuilt_vertices >= most_tests;
  }

  bool isFlawedOrCrossing (Index t) const { return is_flawed[t] != 0 || table.isCrossing (t); }

  // Triangles that cross others or are flawed, ascending.
  std::vector<Index> flawedTriangles () const
  {
    return indicesWhere (is_flawed.size (), [this] (Index t) { return isFlawedOrCrossing (t); });
  }

  // Flips single edges as long as this helps.
  void flipAll ()
  {
    bool has_changed = true;
    while (has_changed) {
      has_changed = false;
      const std::vector<Index> triangles = flawedTriangles ();
      ProgressLoop progress (run, triangles.size ());
      for (const Index t : triangles) {
        progress.next ();
        run.poll (); // with many crossings, a triangle may take some hundredths of a second
        if (isSpent ())
          return;
        if (flips_tried_in[t] >= lastChangeAround (t))
          continue;
        flips_tried_in[t] = step;
        for (std::uint8_t side = 0; side < 3; ++side) {
          mesh.recordChanges ();
          if (flip ({t, side})) {
            ++done.flips;
            has_changed = true;
          }
        }
      }
    }
  }

  // Tries a flip, and keeps it if it helps.
  bool flip (MeshEdge e)
  {
    const MeshEdge m = mesh.mate (e);
    if (m.triangle == NONE ||
        (!isFlawedOrCrossing (e.triangle) && !isFlawedOrCrossing (m.triangle)) ||
        mesh.hasEdge (mesh.corner (e), mesh.corner (m)))
      return false;
    const auto flip_it = [&] { mesh.flip (e); };
    if (gainOf (flip_it) <= 0.0)
      return false;
    keep (flip_it);
    return true;
  }

  // Tries to move the vertices of these triangles, each once.
  void moveAll ()
  {
    std::vector<Index> vertices;
    for (const Index t : flawedTriangles ())
      vertices.insert (vertices.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
    sortUnique (vertices);
    ProgressLoop progress (run, vertices.size ());
    for (const Index v : vertices) {
      progress.next ();
      if (isSpent ())
        return;
      if (!isWorthATry (v))
        continue;
      tried_in[v] = step;
      if (move (v))
        ++done.moves;
    }
  }

  // Rebuilds patches around crossing triangles, those with the fewest crossings first: they are
  // most likely to succeed. Then around flawed ones that cross none.
  void rebuildAll ()
  {
    std::vector<Index> triangles = flawedTriangles ();
    // Without partners, the largest number.
    const auto order = [this] (Index t) { return table.partnersOf (t).size () - 1; };
    std::stable_sort (triangles.begin (), triangles.end (),
                      [&] (Index t, Index u) { return order (t) < order (u); });
    std::size_t tries = 0, successes = 0;
    ProgressLoop progress (run, triangles.size ());
    for (const Index t : triangles) {
      progress.next ();
      if (!isFlawedOrCrossing (t) || rebuild_tried_in[t] >= lastChangeAround (t))
        continue;
      if (isSpent () || tries++ >= limits.vain_rebuilds + limits.rebuilds_per_success * successes)
        return;
      rebuild_tried_in[t] = step;
      if (rebuildAround (t))
        ++successes;
    }
  }

  // Rebuilds a patch around a triangle if this helps: a small one, or else a wider one.
  bool rebuildAround (Index t)
  {
    std::vector<Index> patch (mesh.triangles[t].begin (), mesh.triangles[t].end ());
    const auto add = [&] (Index u) {
      patch.insert (patch.end (), mesh.triangles[u].begin (), mesh.triangles[u].end ());
    };
    for (const Index u : table.partnersOf (t))
      add (u);
    for (const Index u : mesh.neighbors[t])
      if (u != NONE && !table.isCrossing (t))
        add (u);
    sortUnique (patch);
    for (std::size_t ring = 0; ring < limits.rebuilt_rings; ++ring) {
      if (ring > 0)
        addRing (mesh, patch);
      if (patch.size () > limits.largest_patch)
        return false;
      if (rebuild (patch))
        return true;
    }
    return false;
  }

  // Removes the vertices of a patch and reinserts them, in an order that helps, if there is one. The
  // orders are deterministic.
  bool rebuild (std::vector<Index> vertices)
  {
    std::mt19937 random (1);
    for (std::size_t order = 0; order < limits.rebuilt_orders; ++order) {
      run.poll ();
      bool is_possible = true;
      const auto change = [&] { is_possible = mover.rebuild (vertices) && is_possible; };
      mesh.recordChanges ();
      rebuilt_vertices += 2 * vertices.size ();
      if (gainOf (change) > 0.0 && is_possible) {
        keep (change);
        ++done.rebuilds;
        return true;
      }
      for (std::size_t i = vertices.size (); i > 1; --i)
        std::swap (vertices[i - 1], vertices[random () % i]);
    }
    return false;
  }

  // Whether a triangle of a vertex is flawed or crosses another one, and something there changed since
  // its last try.
  bool isWorthATry (Index v)
  {
    mesh.fan (v, fan);
    return std::any_of (fan.begin (), fan.end (),
                        [this] (Index t) { return isFlawedOrCrossing (t); }) &&
           std::any_of (fan.begin (), fan.end (),
                        [&] (Index t) { return lastChangeAround (t) > tried_in[v]; });
  }

  // The last step that changed a triangle, one beside it, or one that crosses it.
  std::uint32_t lastChangeAround (Index t) const
  {
    std::uint32_t last = changed_in[t];
    for (const Index u : mesh.neighbors[t])
      if (u != NONE)
        last = std::max (last, changed_in[u]);
    for (const Index u : table.partnersOf (t))
      last = std::max (last, changed_in[u]);
    return last;
  }

  // Tries all cuts for a vertex, and keeps the best one if it helps.
  bool move (Index v)
  {
    mesh.recordChanges ();
    double best = 0.0;
    const Cut* best_cut = nullptr;
    const std::vector<Cut> cuts = mover.cutsFor (v);
    for (const Cut& cut : cuts) {
      run.poll ();
      if (isSpent ())
        break;
      if (const double gain = gainOf ([&] { mover.moveTo (v, cut); }); gain > best) {
        best = gain;
        best_cut = &cut;
      }
    }
    if (best_cut != nullptr)
      keep ([&] { mover.moveTo (v, *best_cut); });
    return best_cut != nullptr;
  }

  // Gain of a change, in the unit of cost: above 0 if it should be kept. The mesh stays unchanged.
  // Tests costs and folds first: most changes cost more than all pairs there are worth, or fold the
  // surface, and the search for pairs takes most of the time.
  template <typename Change>
  double gainOf (Change&& change)
  {
    const std::size_t mark = mesh.mark ();
    change ();
    changed = mesh.changedTriangles ();
    const Flaws after = flaws ();
    mesh.undo (mark);
    const Flaws before = flaws ();
    const auto gain = [&] (long pairs) {
      return before.cost - after.cost - limits.pair_cost * static_cast<double> (pairs);
    };
    const long folds = after.folds - before.folds;
    const bool trades = repair == Repair::BEFORE_REMAKING;
    const long pairs_there = table.pairsOf (changed);
    if (after.long_triangles > before.long_triangles || after.ridges < before.ridges ||
        folds > (trades ? pairs_there : 0) || !(gain (-pairs_there) > VertexMover::IMPROVES))
      return 0.0;
    const long most_pairs = trades ? -folds : 0;
    change ();
    const long pairs = table.tryChange (changed, std::max (most_pairs, 0L) + 1);
    mesh.undo (mark);
    table.renewBoxes (changed);
    return pairs <= most_pairs && gain (pairs) > VertexMover::IMPROVES ? gain (pairs) : 0.0;
  }

  template <typename Change>
  void keep (Change&& change)
  {
    change ();
    changed = mesh.changedTriangles ();
    table.accept (changed);
    ++step;
    const auto normal = [this] (Index t) -> Vector3d {
      return mover.cost () (mesh.triangles[t]).unit_normal;
    };
    const auto look = [&] (Index t) {
      is_flawed[t] = isFlawed (mesh, mover.cost ().plain, t, repair, ridges, normal) ? 1 : 0;
    };
    for (const Index t : changed) {
      changed_in[t] = step;
      look (t);
      for (const Index u : mesh.neighbors[t])
        if (u != NONE)
          look (u);
    }
  }

  struct Flaws
  {
    long folds = 0, long_triangles = 0, ridges = 0;
    double cost = 0.0;
  };

  // Flaws of the changed triangles and their edges.
  Flaws flaws ()
  {
    CachedCost& cost = mover.cost ();
    Flaws sum;
    for (const Index t : changed) {
      const TriangleCost::Value own = cost (mesh.triangles[t]);
      sum.cost += own.cost;
      sum.long_triangles += cost.plain.isLong (mesh.triangles[t]) ? 1 : 0;
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index u = mesh.neighbors[t][side];
        if (u == NONE || (t > u && std::binary_search (changed.begin (), changed.end (), u)))
          continue;
        if (ridges.has (mesh.from ({t, side}), mesh.to ({t, side}))) {
          ++sum.ridges;
          continue;
        }
        const Vector3d normal = cost (mesh.triangles[u]).unit_normal;
        sum.folds += isFold (own.unit_normal, normal) ? 1 : 0;
        sum.cost += TriangleCost::ofEdge (own.unit_normal, normal);
      }
    }
    return sum;
  }
};

} // namespace

Repairs
repairFlaws (TriangleMesh& mesh, CrossingPairs& crossing, const CsrLists& neighbors,
             const TriangleCost& cost, const Positions& positions, Repair repair,
             const Ridges& ridges, const Flags& is_settled, const RepairLimits& limits,
             const RunContext& run)
{
  if (!crossing.untested.empty ())
    return {};
  const auto normal = [&] (Index t) { return areaVectorOf (mesh.triangles[t], positions); };
  Flags is_flawed (mesh.triangles.size ());
  parallelPoints (run, is_flawed.size (), [&] (Index t) {
    is_flawed[t] = isFlawed (mesh, cost, t, repair, ridges, normal) ? 1 : 0;
  });
  if (crossing.empty () && std::count (is_flawed.begin (), is_flawed.end (), 1) == 0)
    return {};
  CrossingTable table (mesh, positions, crossing, run);
  VertexMover mover (mesh, positions, neighbors, cost, run);
  FlawRepair search{mesh, repair, ridges, limits, run, std::move (is_flawed), table, mover};
  if (!is_settled.empty ())
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      if (!anyCorner (mesh.triangles[t], [&] (Index p) { return is_settled[p] == 0; }))
        search.changed_in[t] = 0;
  const Repairs done = search.repairAll ();
  if (done.hasChanged ())
    crossing = table.pairs ();
  return done;
}

} // namespace pcl::floater
