// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fold_repair.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/crossing_table.h"
#include "mesh/vertex_mover.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl::floater {
namespace {
constexpr std::uint8_t NO_PLACE = 255; // rank after all kicks have failed

// The corners of bad triangles, ascending.
std::vector<Index>
findBadVertices (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                 const TriangleCost& cost, const RunContext& run)
{
  std::vector<std::uint8_t> is_bad (mesh.triangles.size ());
  parallelRanges (run, is_bad.size (), [&] (std::size_t first, std::size_t last) {
    for (auto t = static_cast<Index> (first); t < last; ++t) {
      const bool is = isBad (mesh, cost, t, [&] (Index u) -> Eigen::Vector3d {
        return areaVectorOf (mesh.triangles[u], positions);
      });
      is_bad[t] = is ? 1 : 0;
    }
  });
  std::vector<Index> vertices;
  for (Index t = 0; t < is_bad.size (); ++t)
    if (is_bad[t] != 0)
      vertices.insert (vertices.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  sortUnique (vertices);
  return vertices;
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

// Moves and kicks vertices, see moveVertices.
class VertexRepair
{
public:
  VertexRepair (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
                const RepairLimits& limits, const RunContext& run)
      : mesh_ (mesh), limits_ (limits), run_ (run),
        mover_ (mesh, neighbors, cost, limits.largest_fan, run)
  {
  }

  // Moves these vertices, if they are bad, and those around them.
  // \param most_costs number of requested costs at which moves end
  // \return number of moves
  std::size_t moveAll (std::vector<Index> vertices, std::size_t most_costs)
  {
    most_costs_ = cost_.asked () + most_costs;
    std::size_t moves = 0;
    keepThoseToMove (vertices);
    for (int pass = 0; pass < limits_.passes && !vertices.empty (); ++pass) {
      mover_.dirty ().clear ();
      ProgressLoop progress (run_, vertices.size ());
      for (Index v : vertices) {
        progress.next ();
        if (isSpent ())
          return moves;
        mesh_.recordChanges ();
        moves += mover_.move (v, limits_.places) < 0.0 ? 1 : 0;
      }
      vertices.swap (mover_.dirty ());
      sortUnique (vertices);
      keepThoseToMove (vertices);
    }
    return moves;
  }

  // Kicks the vertices at folds among these, within the limits.
  // \return number of kicks that were kept
  std::size_t kickAll (std::vector<Index> vertices)
  {
    std::size_t kept = 0;
    next_rank_.assign (mesh_.triangle_of.size (), 0);
    kicks_left_ = mesh_.triangle_of.size () / limits_.points_per_kick + limits_.kicks;
    most_costs_ = cost_.asked () + std::max (limits_.fewest_costs,
                                             limits_.costs_of_kicks * mesh_.triangle_of.size ());
    if (isSpent ())
      return 0;
    const std::size_t kicks = kicks_left_;
    ProgressLoop progress (run_, kicks);
    while (!vertices.empty ()) {
      const std::size_t share = std::min (limits_.kicks, 1 + kicks_left_ / vertices.size ());
      std::vector<Index> again;
      for (Index v : vertices) {
        progress.reach (kicks - kicks_left_);
        if (!isAtFold (v))
          continue;
        if (kick (v, share)) {
          ++kept;
          allowKicksAround (again);
        }
        else if (next_rank_[v] != NO_PLACE)
          again.push_back (v);
        if (kicks_left_ == 0 || isSpent ())
          return kept;
      }
      sortUnique (again);
      vertices.swap (again);
    }
    return kept;
  }

private:
  bool isBadTriangle (Index t)
  {
    return isBad (mesh_, cost_.plain (), t, [this] (Index u) -> Eigen::Vector3d {
      return cost_ (mesh_.triangles[u]).unit_normal;
    });
  }

  void keepThoseToMove (std::vector<Index>& vertices)
  {
    ProgressLoop progress (run_);
    vertices.erase (std::remove_if (vertices.begin (), vertices.end (),
                                    [&] (Index v) {
                                      progress.next ();
                                      return !isToMove (v);
                                    }),
                    vertices.end ());
  }

  bool isToMove (Index v)
  {
    mesh_.fan (v, fan_);
    return std::any_of (fan_.begin (), fan_.end (), [this] (Index t) { return isBadTriangle (t); });
  }

  // True if an edge of a triangle around a vertex is folded.
  bool isAtFold (Index v)
  {
    mesh_.fan (v, fan_);
    for (Index t : fan_) {
      const Eigen::Vector3d normal = cost_ (mesh_.triangles[t]).unit_normal;
      for (Index u : mesh_.neighbors[t])
        if (u != NONE && isFold (normal, cost_ (mesh_.triangles[u]).unit_normal))
          return true;
    }
    return false;
  }

  // Kicks a vertex to its next triangles until one is kept. After the flips, several of them may be
  // equivalent to each other or to the start: the vertex then has the same neighbours.
  bool kick (Index v, std::size_t times)
  {
    rings_.clear ();
    noteRing (v);
    const std::vector<VertexMover::Place> places = mover_.placesFor (v, limits_.kicks);
    for (; times > 0 && kicks_left_ > 0 && next_rank_[v] < places.size (); ++next_rank_[v]) {
      run_.poll ();
      mesh_.recordChanges ();
      mover_.dirty ().clear ();
      const double change = mover_.moveTo (v, places[next_rank_[v]]);
      if (noteRing (v)) {
        --times;
        --kicks_left_;
        if (change + moveAfterKick (change) < -VertexMover::IMPROVES)
          return true;
      }
      mesh_.undo (0);
    }
    if (next_rank_[v] >= places.size ())
      next_rank_[v] = NO_PLACE;
    return false;
  }

  // Moves the vertices around after a kick. Returns the change of cost by these moves.
  double moveAfterKick (double change_by_kick)
  {
    double change = 0.0;
    for (int pass = 0; pass < limits_.passes_after_kick; ++pass) {
      around_.swap (mover_.dirty ());
      mover_.dirty ().clear ();
      sortUnique (around_);
      for (Index w : around_) {
        if (!isToMove (w))
          continue;
        change += mover_.move (w, limits_.places_after_kick);
        if (std::abs (change_by_kick + change) <= VertexMover::IMPROVES)
          return change; // the mesh is as before the kick
      }
    }
    return change;
  }

  // Stores the neighbours of a vertex. Returns false if they are known already.
  bool noteRing (Index v)
  {
    std::vector<Index> ring;
    mesh_.fan (v, fan_, ring);
    std::sort (ring.begin (), ring.end ());
    if (std::find (rings_.begin (), rings_.end (), ring) != rings_.end ())
      return false;
    rings_.push_back (std::move (ring));
    return true;
  }

  // After a successful kick: the corners of all changed triangles may be kicked again.
  void allowKicksAround (std::vector<Index>& again)
  {
    for (Index t : mesh_.changedTriangles ())
      for (Index p : mesh_.triangles[t]) {
        next_rank_[p] = 0;
        again.push_back (p);
      }
  }

  bool isSpent () const { return cost_.asked () >= most_costs_; }

  TriangleMesh& mesh_;
  const RepairLimits& limits_;
  RunContext run_;
  VertexMover mover_;
  CachedCost& cost_ = mover_.cost ();
  std::vector<std::uint8_t> next_rank_; // per point: rank of its next kick
  std::size_t kicks_left_ = 0;
  std::size_t most_costs_ = 0;            // limit for kicks
  std::vector<std::vector<Index>> rings_; // neighbours at the triangles tried so far
  std::vector<Index> fan_, around_;
};

} // namespace

std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const RunContext& run)
{
  // Sides of each triangle at which it is folded against one of a higher index, as bits.
  std::vector<std::uint8_t> sides (mesh.triangles.size (), 0);
  parallelRanges (run, sides.size (), [&] (std::size_t first, std::size_t last) {
    for (auto t = static_cast<Index> (first); t < last; ++t) {
      const Eigen::Vector3d own = areaVectorOf (mesh.triangles[t], positions);
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index u = mesh.neighbors[t][side];
        if (u != NONE && t < u && isFold (own, areaVectorOf (mesh.triangles[u], positions)))
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
flipFolds (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const std::vector<float>& spacing, const std::vector<CrossingPair>& crossing,
           const RunContext& run)
{
  constexpr double OF_FOLD = 10.0; // more than the bends of five edges
  constexpr double NEEDLE = 1e-3;  // height over longest edge, as CheckLimits::flat_height
  constexpr double LONGEST = 3.0;  // edge, in spacings
  constexpr double IMPROVES = 1e-6;
  constexpr int MOST_PASSES = 12; // few folds change after five
  CrossingTable table (mesh, positions, crossing, run);
  // How far the surface is bent beyond a right angle at an edge, and whether that is a fold.
  const auto bendAt = [&] (Index t, std::uint8_t side) {
    const Index u = mesh.neighbors[t][side];
    if (u == NONE)
      return 0.0;
    const Eigen::Vector3d one = areaVectorOf (mesh.triangles[t], positions);
    const Eigen::Vector3d other = areaVectorOf (mesh.triangles[u], positions);
    return std::max (0.0, -one.normalized ().dot (other.normalized ())) +
           (isFold (one, other) ? OF_FOLD : 0.0);
  };
  // Whether a triangle has an edge of many spacings, or is a needle.
  const auto isLong = [&] (Index t) {
    double longest = 0.0, spacings = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = mesh.triangles[t][i], q = mesh.triangles[t][(i + 1) % 3];
      longest = std::max (longest, (positions[q] - positions[p]).norm ());
      spacings += static_cast<double> (spacing[p]) / 3.0;
    }
    return longest > LONGEST * spacings ||
           areaVectorOf (mesh.triangles[t], positions).norm () < NEEDLE * longest * longest;
  };
  // Flips an edge if that lowers the sum of bends around its two triangles.
  const auto flip = [&] (MeshEdge e) {
    const MeshEdge mate = mesh.mate (e);
    if (mate.triangle == NONE || mesh.hasEdge (mesh.corner (e), mesh.corner (mate)))
      return false;
    const Index t = std::min (e.triangle, mate.triangle), u = std::max (e.triangle, mate.triangle);
    const auto bends = [&] {
      double sum = 0.0;
      for (std::uint8_t side = 0; side < 3; ++side)
        sum += bendAt (t, side) + (mesh.neighbors[u][side] == t ? 0.0 : bendAt (u, side));
      return sum;
    };
    const double before = bends ();
    mesh.recordChanges ();
    mesh.flip (e);
    if (bends () < before - IMPROVES && !isLong (t) && !isLong (u) &&
        table.tryChange ({t, u}, 1) <= 0) {
      table.accept ({t, u});
      return true;
    }
    mesh.undo (0);
    table.reject ({t, u});
    return false;
  };
  std::size_t flips = 0;
  bool has_changed = true;
  for (int pass = 0; has_changed && pass < MOST_PASSES; ++pass) {
    has_changed = false;
    for (const auto [t, side] : findFolds (mesh, positions, run)) {
      run.poll ();
      const Index u = mesh.neighbors[t][side];
      for (std::uint8_t i = 0; i < 6 && bendAt (t, side) >= OF_FOLD; ++i)
        if (flip ({i < 3 ? t : u, static_cast<std::uint8_t> (i % 3)})) {
          ++flips;
          has_changed = true;
          break;
        }
    }
  }
  mesh.recordChanges (false);
  return flips;
}

std::size_t
moveVertices (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
              const std::vector<Eigen::Vector3d>& positions, const RepairLimits& limits,
              const RunContext& run)
{
  VertexRepair repair (mesh, neighbors, cost, limits, run);
  const std::size_t moves = repair.moveAll (
      findBadVertices (mesh, positions, cost, run),
      std::max (limits.fewest_costs, limits.costs_of_moves * mesh.triangle_of.size ()));
  return moves + repair.kickAll (verticesAt (findFolds (mesh, positions, run), mesh));
}

} // namespace pcl::floater
