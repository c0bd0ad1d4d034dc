// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fold_repair.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "mesh/vertex_mover.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// Counts marked points in patches, each of so many points along the space-filling curve.
class PatchCounter
{
public:
  PatchCounter (const std::vector<std::uint8_t>& is_marked, std::size_t patch_points)
      : patch_points_ (patch_points), before_ (is_marked.size () + 1, 0)
  {
    for (std::size_t v = 0; v < is_marked.size (); ++v)
      before_[v + 1] = before_[v] + is_marked[v];
  }

  // Whether most points of the patch around a point are marked.
  bool areMost (Index v) const
  {
    const std::size_t half = patch_points_ / 2;
    const std::size_t first = v > half ? v - half : 0;
    const std::size_t last = std::min (first + patch_points_, before_.size () - 1);
    return std::size_t{2} * (before_[last] - before_[first]) > last - first;
  }

private:
  std::size_t patch_points_;
  std::vector<Index> before_; // how many of the points before each one are marked
};

class FoldRepair
{
public:
  FoldRepair (TriangleMesh& mesh, const CsrLists& neighbors, const std::vector<Index>& scatter,
              const TriangleCost& cost, const RepairLimits& limits, const RunContext& run)
      : mesh_ (mesh), limits_ (limits), run_ (run),
        mover_ (mesh, neighbors, cost, limits.largest_fan, run), is_left_ (patchesOf (scatter))
  {
  }

  std::size_t moveAll ()
  {
    std::size_t moves = 0;
    std::vector<Index> vertices = findVerticesToMove ();
    for (int pass = 0; pass < limits_.passes && !vertices.empty (); ++pass) {
      mover_.dirty ().clear ();
      ProgressLoop progress (run_, vertices.size ());
      for (Index v : vertices) {
        progress.next ();
        mover_.start ();
        moves += mover_.move (v, limits_.places) < 0.0 ? 1 : 0;
      }
      vertices.swap (mover_.dirty ());
      sortUnique (vertices);
      vertices.erase (std::remove_if (vertices.begin (), vertices.end (),
                                      [this] (Index v) { return !isToMove (v); }),
                      vertices.end ());
    }
    return moves;
  }

  std::size_t kickAll (std::vector<Index> vertices)
  {
    std::size_t kept = 0;
    next_rank_.assign (mesh_.triangle_of.size (), 0);
    kicks_left_ = mesh_.triangle_of.size () / limits_.points_per_kick + limits_.kicks;
    const std::size_t kicks = kicks_left_;
    ProgressLoop progress (run_, kicks);
    while (!vertices.empty ()) {
      const std::size_t share = std::min (limits_.kicks, 1 + kicks_left_ / vertices.size ());
      std::vector<Index> again;
      for (Index v : vertices) {
        progress.reach (kicks - kicks_left_);
        if (is_left_[v] != 0 || !isAtFold (v))
          continue;
        if (kick (v, share)) {
          ++kept;
          allowKicksAround (again);
        }
        else if (next_rank_[v] != NO_PLACE)
          again.push_back (v);
        if (kicks_left_ == 0)
          return kept;
      }
      sortUnique (again);
      vertices.swap (again);
    }
    return kept;
  }

private:
  static constexpr std::uint8_t NO_PLACE = 255; // all were tried in vain

  // The points of patches most of which are scatter.
  std::vector<std::uint8_t> patchesOf (const std::vector<Index>& scatter) const
  {
    std::vector<std::uint8_t> is_in (mesh_.triangle_of.size (), 0);
    if (scatter.empty ())
      return is_in;
    for (const Index v : scatter)
      is_in[v] = 1;
    const PatchCounter count (is_in, limits_.patch_points);
    for (Index v = 0; v < is_in.size (); ++v)
      is_in[v] = count.areMost (v) ? 1 : 0;
    return is_in;
  }

  // True if a triangle is turned, or more than 90 degrees from a neighbouring triangle.
  bool isBad (Index t)
  {
    if (cost_.plain ().isTurned (mesh_.triangles[t]))
      return true;
    const Eigen::Vector3d normal = cost_ (mesh_.triangles[t]).unit_normal;
    for (std::uint8_t side = 0; side < 3; ++side)
      if (normal.dot (normalAcross (mesh_, cost_, {t, side})) < 0.0)
        return true;
    return false;
  }

  // The corners of bad triangles; but where most points of the patch around are corners of bad
  // triangles, only those at folds.
  std::vector<Index> findVerticesToMove ()
  {
    std::vector<std::uint8_t> is_bad (mesh_.triangle_of.size (), 0);
    ProgressLoop progress (run_);
    for (Index t = 0; t < mesh_.triangles.size (); ++t) {
      progress.next ();
      if (isBad (t))
        for (const Index v : mesh_.triangles[t])
          is_bad[v] = 1;
    }
    const PatchCounter count (is_bad, limits_.patch_points);
    is_scattered_.assign (is_bad.size (), 0);
    std::vector<Index> vertices;
    for (Index v = 0; v < is_bad.size (); ++v) {
      if (is_bad[v] == 0 || is_left_[v] != 0)
        continue;
      is_scattered_[v] = count.areMost (v) ? 1 : 0;
      if (is_scattered_[v] == 0 || isAtFold (v))
        vertices.push_back (v);
    }
    return vertices;
  }

  // True of a vertex at a fold, and where there is a surface, of one at a bad triangle.
  bool isToMove (Index v)
  {
    if (is_left_[v] != 0)
      return false;
    if (isAtFold (v)) // sets fan_
      return true;
    return is_scattered_[v] == 0 &&
           std::any_of (fan_.begin (), fan_.end (), [this] (Index t) { return isBad (t); });
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

  // Kicks a vertex to its next places until one is kept. After the flips, several places may turn
  // out to be the same one, or the one where the vertex was: then it has the same neighbours there.
  bool kick (Index v, std::size_t times)
  {
    rings_.clear ();
    noteRing (v);
    const std::vector<VertexMover::Place> places = mover_.placesFor (v, limits_.kicks);
    for (; times > 0 && kicks_left_ > 0 && next_rank_[v] < places.size (); ++next_rank_[v]) {
      run_.poll ();
      mover_.start ();
      mover_.dirty ().clear ();
      const double change = mover_.moveTo (v, places[next_rank_[v]]);
      if (noteRing (v)) {
        --times;
        --kicks_left_;
        if (change + moveAfterKick (change) < -VertexMover::IMPROVES)
          return true;
      }
      mover_.undo ();
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
          return change; // the mesh is as it was before the kick
      }
    }
    return change;
  }

  // Notes the neighbours of a vertex. Returns false if they were noted before.
  bool noteRing (Index v)
  {
    mesh_.fan (v, fan_);
    std::vector<Index> ring;
    for (Index t : fan_)
      ring.push_back (mesh_.from ({t, mesh_.sideOf (t, v)}));
    std::sort (ring.begin (), ring.end ());
    if (std::find (rings_.begin (), rings_.end (), ring) != rings_.end ())
      return false;
    rings_.push_back (std::move (ring));
    return true;
  }

  // After a kick that is kept: the corners of all changed triangles may be kicked again.
  void allowKicksAround (std::vector<Index>& again)
  {
    changed_.clear ();
    mover_.journal ().appendTriangles (changed_);
    sortUnique (changed_);
    for (Index t : changed_)
      for (Index p : mesh_.triangles[t]) {
        next_rank_[p] = 0;
        again.push_back (p);
      }
  }

  TriangleMesh& mesh_;
  RepairLimits limits_;
  RunContext run_;
  VertexMover mover_;
  CachedCost& cost_ = mover_.cost ();
  std::vector<std::uint8_t> is_left_; // per point: most points of the patch around are scatter
  std::vector<std::uint8_t>
      is_scattered_; // per point: most points of the patch around are at bad triangles
  std::vector<std::uint8_t> next_rank_; // per point: rank of the place to which it is kicked next
  std::size_t kicks_left_ = 0;
  std::vector<std::vector<Index>> rings_; // neighbours at the places tried so far
  std::vector<Index> fan_, around_, changed_;
};

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

} // namespace

std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const RunContext& run)
{
  const auto areaVectorOf = [&] (Index t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return areaVector (positions[a], positions[b], positions[c]);
  };
  std::vector<MeshEdge> folds;
  ProgressLoop progress (run);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    progress.next ();
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index u = mesh.neighbors[t][side];
      if (u != NONE && t < u && isFold (areaVectorOf (t), areaVectorOf (u)))
        folds.push_back ({t, side});
    }
  }
  return folds;
}

std::size_t
moveVertices (TriangleMesh& mesh, const CsrLists& neighbors, const std::vector<Index>& scatter,
              const TriangleCost& cost, const std::vector<Eigen::Vector3d>& positions,
              const RepairLimits& limits, const RunContext& run)
{
  FoldRepair repair (mesh, neighbors, scatter, cost, limits, run);
  const std::size_t moves = repair.moveAll ();
  return moves + repair.kickAll (verticesAt (findFolds (mesh, positions, run), mesh));
}

} // namespace floater
} // namespace pcl
