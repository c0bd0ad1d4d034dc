// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/flaw_repair.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/crossing_table.h"
#include "mesh/vertex_mover.h"

#include <random>
#include <unordered_map>

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

class FlawRepair
{
public:
  FlawRepair (TriangleMesh& mesh, Flags is_flawed, const std::vector<CrossingPair>& pairs,
              const CsrLists& neighbors, const TriangleCost& cost, const Positions& positions,
              Repair repair, const Ridges& ridges, const RepairLimits& limits,
              const RunContext& run)
      : mesh_ (mesh), repair_ (repair), ridges_ (ridges), limits_ (limits), run_ (run),
        is_flawed_ (std::move (is_flawed)), table_ (mesh, positions, pairs, run),
        mover_ (mesh, positions, neighbors, cost, run),
        most_tests_ (
            (repair == Repair::AT_THE_END ? 3 : 1) *
            std::max (limits.fewest_tests, mesh.triangles.size () * limits.tests_per_triangle)),
        changed_in_ (mesh.triangles.size (), 1), tried_in_ (mesh.triangle_of.size (), 0)
  {
  }

  Repairs run ()
  {
    for (std::size_t pass = 0; pass < limits_.passes && !isSpent (); ++pass) {
      const std::uint32_t before = step_;
      flipAll ();
      moveAll ();
      if (step_ == before)
        rebuildAll ();
      if (step_ == before)
        break;
    }
    return done_;
  }

  CrossingPairs crossing () const { return table_.pairs (); }

private:
  bool isSpent () const
  {
    return table_.tests () + TESTS_PER_REBUILT_VERTEX * rebuilt_vertices_ >= most_tests_;
  }

  bool isFlawedOrCrossing (Index t) const { return is_flawed_[t] != 0 || table_.isCrossing (t); }

  // Triangles that cross others or are flawed, ascending.
  std::vector<Index> flawedTriangles () const
  {
    std::vector<Index> triangles;
    for (Index t = 0; t < is_flawed_.size (); ++t)
      if (isFlawedOrCrossing (t))
        triangles.push_back (t);
    return triangles;
  }

  // Flips single edges as long as this helps.
  void flipAll ()
  {
    bool has_changed = true;
    while (has_changed) {
      has_changed = false;
      const std::vector<Index> triangles = flawedTriangles ();
      ProgressLoop progress (run_, triangles.size ());
      for (const Index t : triangles) {
        progress.next ();
        run_.poll (); // with many crossings, a triangle may take some hundredths of a second
        if (isSpent ())
          return;
        if (flips_tried_in_[t] >= lastChangeAround (t))
          continue;
        flips_tried_in_[t] = step_;
        for (std::uint8_t side = 0; side < 3; ++side) {
          mesh_.recordChanges ();
          if (flip ({t, side})) {
            ++done_.flips;
            has_changed = true;
          }
        }
      }
    }
  }

  // Tries a flip, and keeps it if it helps.
  bool flip (MeshEdge e)
  {
    const MeshEdge m = mesh_.mate (e);
    if (m.triangle == NONE ||
        (!isFlawedOrCrossing (e.triangle) && !isFlawedOrCrossing (m.triangle)) ||
        mesh_.hasEdge (mesh_.corner (e), mesh_.corner (m)))
      return false;
    const auto flip_it = [&] { mesh_.flip (e); };
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
      vertices.insert (vertices.end (), mesh_.triangles[t].begin (), mesh_.triangles[t].end ());
    sortUnique (vertices);
    ProgressLoop progress (run_, vertices.size ());
    for (const Index v : vertices) {
      progress.next ();
      if (isSpent ())
        return;
      if (!isWorthATry (v))
        continue;
      tried_in_[v] = step_;
      if (move (v))
        ++done_.moves;
    }
  }

  // Rebuilds patches around crossing triangles, those with the fewest crossings first: they are
  // most likely to succeed. Then around flawed ones that cross none.
  void rebuildAll ()
  {
    std::vector<Index> triangles = flawedTriangles ();
    // Without partners, the largest number.
    const auto order = [this] (Index t) { return table_.partnersOf (t).size () - 1; };
    std::stable_sort (triangles.begin (), triangles.end (),
                      [&] (Index t, Index u) { return order (t) < order (u); });
    std::size_t tries = 0, successes = 0;
    ProgressLoop progress (run_, triangles.size ());
    for (const Index t : triangles) {
      progress.next ();
      if (!isFlawedOrCrossing (t) || rebuild_tried_in_[t] >= lastChangeAround (t))
        continue;
      if (isSpent () || tries++ >= limits_.vain_rebuilds + limits_.rebuilds_per_success * successes)
        return;
      rebuild_tried_in_[t] = step_;
      if (rebuildAround (t))
        ++successes;
    }
  }

  // Rebuilds a patch around a triangle if this helps: a small one, or else a wider one.
  bool rebuildAround (Index t)
  {
    std::vector<Index> patch (mesh_.triangles[t].begin (), mesh_.triangles[t].end ());
    const auto add = [&] (Index u) {
      patch.insert (patch.end (), mesh_.triangles[u].begin (), mesh_.triangles[u].end ());
    };
    for (const Index u : table_.partnersOf (t))
      add (u);
    for (const Index u : mesh_.neighbors[t])
      if (u != NONE && !table_.isCrossing (t))
        add (u);
    sortUnique (patch);
    for (std::size_t ring = 0; ring < limits_.rebuilt_rings; ++ring) {
      if (ring > 0)
        addRing (mesh_, patch);
      if (patch.size () > limits_.largest_patch)
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
    for (std::size_t order = 0; order < limits_.rebuilt_orders; ++order) {
      run_.poll ();
      bool is_possible = true;
      const auto change = [&] { is_possible = mover_.rebuild (vertices) && is_possible; };
      mesh_.recordChanges ();
      rebuilt_vertices_ += 2 * vertices.size ();
      if (gainOf (change) > 0.0 && is_possible) {
        keep (change);
        ++done_.rebuilds;
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
    mesh_.fan (v, fan_);
    return std::any_of (fan_.begin (), fan_.end (),
                        [this] (Index t) { return isFlawedOrCrossing (t); }) &&
           std::any_of (fan_.begin (), fan_.end (),
                        [&] (Index t) { return lastChangeAround (t) > tried_in_[v]; });
  }

  // The last step that changed a triangle, one beside it, or one that crosses it.
  std::uint32_t lastChangeAround (Index t) const
  {
    std::uint32_t last = changed_in_[t];
    for (const Index u : mesh_.neighbors[t])
      if (u != NONE)
        last = std::max (last, changed_in_[u]);
    for (const Index u : table_.partnersOf (t))
      last = std::max (last, changed_in_[u]);
    return last;
  }

  // Tries all cuts for a vertex, and keeps the best one if it helps.
  bool move (Index v)
  {
    mesh_.recordChanges ();
    double best = 0.0;
    const Cut* best_cut = nullptr;
    const std::vector<Cut> cuts = mover_.cutsFor (v);
    for (const Cut& cut : cuts) {
      run_.poll ();
      if (isSpent ())
        break;
      if (const double gain = gainOf ([&] { mover_.moveTo (v, cut); }); gain > best) {
        best = gain;
        best_cut = &cut;
      }
    }
    if (best_cut != nullptr)
      keep ([&] { mover_.moveTo (v, *best_cut); });
    return best_cut != nullptr;
  }

  // Gain of a change, in the unit of cost: above 0 if it should be kept. The mesh stays unchanged.
  // Tests costs and folds first: most changes cost more than all pairs there are worth, or fold the
  // surface, and the search for pairs takes most of the time.
  template <typename Change>
  double gainOf (Change&& change)
  {
    const std::size_t mark = mesh_.mark ();
    change ();
    changed_ = mesh_.changedTriangles ();
    const Flaws after = flaws ();
    mesh_.undo (mark);
    const Flaws before = flaws ();
    const auto gain = [&] (long pairs) {
      return before.cost - after.cost - limits_.pair_cost * static_cast<double> (pairs);
    };
    const long folds = after.folds - before.folds;
    const bool trades = repair_ == Repair::BEFORE_REMAKING;
    const long pairs_there = table_.pairsOf (changed_);
    if (after.long_triangles > before.long_triangles || after.ridges < before.ridges ||
        folds > (trades ? pairs_there : 0) || !(gain (-pairs_there) > VertexMover::IMPROVES))
      return 0.0;
    const long most_pairs = trades ? -folds : 0;
    change ();
    const long pairs = table_.tryChange (changed_, std::max (most_pairs, 0L) + 1);
    mesh_.undo (mark);
    table_.renewBoxes (changed_);
    return pairs <= most_pairs && gain (pairs) > VertexMover::IMPROVES ? gain (pairs) : 0.0;
  }

  template <typename Change>
  void keep (Change&& change)
  {
    change ();
    changed_ = mesh_.changedTriangles ();
    table_.accept (changed_);
    ++step_;
    const auto normal = [this] (Index t) -> Vector3d {
      return mover_.cost () (mesh_.triangles[t]).unit_normal;
    };
    const auto look = [&] (Index t) {
      is_flawed_[t] =
          isFlawed (mesh_, mover_.cost ().plain (), t, repair_, ridges_, normal) ? 1 : 0;
    };
    for (const Index t : changed_) {
      changed_in_[t] = step_;
      look (t);
      for (const Index u : mesh_.neighbors[t])
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
    CachedCost& cost = mover_.cost ();
    Flaws sum;
    for (const Index t : changed_) {
      const TriangleCost::Value own = cost (mesh_.triangles[t]);
      sum.cost += own.cost;
      sum.long_triangles += cost.plain ().isLong (mesh_.triangles[t]) ? 1 : 0;
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index u = mesh_.neighbors[t][side];
        if (u == NONE || (t > u && std::binary_search (changed_.begin (), changed_.end (), u)))
          continue;
        if (ridges_.has (mesh_.from ({t, side}), mesh_.to ({t, side}))) {
          ++sum.ridges;
          continue;
        }
        const Vector3d normal = cost (mesh_.triangles[u]).unit_normal;
        sum.folds += isFold (own.unit_normal, normal) ? 1 : 0;
        sum.cost += TriangleCost::ofEdge (own.unit_normal, normal);
      }
    }
    return sum;
  }

  TriangleMesh& mesh_;
  Repair repair_;
  const Ridges& ridges_;
  RepairLimits limits_;
  RunContext run_;
  Flags is_flawed_; // of each triangle, see isFlawed
  CrossingTable table_;
  VertexMover mover_;
  std::size_t most_tests_;
  std::uint32_t step_ = 1;                // number of kept changes, from 1 on
  std::vector<std::uint32_t> changed_in_; // of each triangle: the last step that changed it
  std::vector<std::uint32_t> tried_in_;   // of each vertex: the step after which it was tried
  // Last tries at triangles: by flips, and by rebuilding.
  std::unordered_map<Index, std::uint32_t> flips_tried_in_, rebuild_tried_in_;
  std::size_t rebuilt_vertices_ = 0; // removed and reinserted in all trials
  Repairs done_;
  std::vector<Index> fan_;
  std::vector<Index> changed_; // triangles, ascending
};

} // namespace

Repairs
repairFlaws (TriangleMesh& mesh, CrossingPairs& crossing, const CsrLists& neighbors,
             const TriangleCost& cost, const Positions& positions, Repair repair,
             const Ridges& ridges, const RepairLimits& limits, const RunContext& run)
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
  FlawRepair search (mesh, std::move (is_flawed), crossing, neighbors, cost, positions, repair,
                     ridges, limits, run);
  const Repairs done = search.run ();
  if (done.hasChanged ())
    crossing = search.crossing ();
  return done;
}

} // namespace pcl::floater
