// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_repair.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "mesh/fold_repair.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl::floater {
namespace {
constexpr std::uint8_t NO_PLACE = 255; // rank after all kicks have failed
} // namespace

std::size_t
VertexRepair::moveAll (std::vector<Index> vertices, std::size_t most_costs)
{
  most_costs_ = costs () + most_costs;
  std::size_t moves = 0;
  keepThoseToMove (vertices);
  for (int pass = 0; pass < limits_.passes && !vertices.empty (); ++pass) {
    mover_.dirty ().clear ();
    ProgressLoop progress (run_, vertices.size ());
    for (Index v : vertices) {
      progress.next ();
      if (isSpent ())
        return moves;
      mover_.start ();
      moves += mover_.move (v, limits_.places) < 0.0 ? 1 : 0;
    }
    vertices.swap (mover_.dirty ());
    sortUnique (vertices);
    keepThoseToMove (vertices);
  }
  return moves;
}

std::size_t
VertexRepair::kickAll (std::vector<Index> vertices)
{
  std::size_t kept = 0;
  next_rank_.assign (mesh_.triangle_of.size (), 0);
  kicks_left_ = mesh_.triangle_of.size () / limits_.points_per_kick + limits_.kicks;
  most_costs_ = costs () +
                std::max (limits_.fewest_costs, limits_.costs_of_kicks * mesh_.triangle_of.size ());
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

bool
VertexRepair::isBadTriangle (Index t)
{
  return isBad (mesh_, cost_.plain (), t, [this] (Index u) -> Eigen::Vector3d {
    return cost_ (mesh_.triangles[u]).unit_normal;
  });
}

void
VertexRepair::keepThoseToMove (std::vector<Index>& vertices)
{
  ProgressLoop progress (run_);
  vertices.erase (std::remove_if (vertices.begin (), vertices.end (),
                                  [&] (Index v) {
                                    progress.next ();
                                    return !isToMove (v);
                                  }),
                  vertices.end ());
}

// True for vertices at folds, and on surfaces also at bad triangles.
bool
VertexRepair::isToMove (Index v)
{
  if (isAtFold (v)) // sets fan_
    return true;
  return targets_[v] != RepairTarget::SCATTERED &&
         std::any_of (fan_.begin (), fan_.end (), [this] (Index t) { return isBadTriangle (t); });
}

// True if an edge of a triangle around a vertex is folded.
bool
VertexRepair::isAtFold (Index v)
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
bool
VertexRepair::kick (Index v, std::size_t times)
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
double
VertexRepair::moveAfterKick (double change_by_kick)
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
bool
VertexRepair::noteRing (Index v)
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

// After a successful kick: the corners of all changed triangles may be kicked again.
void
VertexRepair::allowKicksAround (std::vector<Index>& again)
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

} // namespace pcl::floater
