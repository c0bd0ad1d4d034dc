// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/fold_repair.h"

#include "triangulation/polygon_filling.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double FOLD_COSINE = -0.5; // 120 degrees between the normals of neighbours
constexpr int PASSES = 12;
constexpr std::size_t LARGEST_FAN = 16; // vertices of more triangles are not moved
constexpr std::size_t PLACES = 16;      // cheapest triangles into which a vertex is tried
constexpr std::size_t KICKS = 16;       // places to which a vertex of a fold is forced
constexpr std::size_t PLACES_AFTER_KICK = 3;
constexpr int KICK_PASSES = 3;
constexpr double IMPROVES = 1e-6; // of the cost of a triangle of equal sides

class VertexMover
{
public:
  VertexMover (SurfaceMesh& mesh, const FlatLists& near, const TriangleCost& cost)
      : mesh_ (mesh), near_ (near), cost_ (cost), flipper_ (mesh, cost)
  {
    mesh_.journal = &journal_;
  }
  VertexMover (const VertexMover&) = delete;
  VertexMover& operator= (const VertexMover&) = delete;
  ~VertexMover () { mesh_.journal = nullptr; }

  std::size_t run ()
  {
    std::size_t moves = 0;
    std::vector<Index> vertices = badVertices ();
    for (int pass = 0; pass < PASSES && !vertices.empty (); ++pass) {
      touched_.clear ();
      for (Index v : vertices) {
        journal_.clear ();
        moves += move (v, PLACES) < 0.0 ? 1 : 0;
      }
      makeSet (touched_);
      vertices.swap (touched_);
    }
    return moves;
  }

  // Where no single move helps, a vertex of a fold goes to a place that is worse, and its old and
  // new neighbours move after it; kept if the whole gains. Returns the number of such kicks.
  std::size_t kick (const std::vector<Index>& vertices)
  {
    std::size_t kicks = 0;
    for (Index v : vertices)
      for (std::size_t rank = 0; rank < KICKS; ++rank) {
        journal_.clear ();
        touched_.clear ();
        double change = moveTo (v, rank);
        if (touched_.empty ())
          break;
        for (int pass = 0; pass < 2; ++pass) {
          std::vector<Index> around;
          around.swap (touched_);
          makeSet (around);
          for (Index w : around)
            change += move (w, PLACES_AFTER_KICK);
        }
        if (change < -IMPROVES) {
          ++kicks;
          break;
        }
        mesh_.undo (0);
      }
    return kicks;
  }

private:
  static void makeSet (std::vector<Index>& list)
  {
    std::sort (list.begin (), list.end ());
    list.erase (std::unique (list.begin (), list.end ()), list.end ());
  }

  // Corners of the triangles that are penalized or folded against a neighbour.
  std::vector<Index> badVertices () const
  {
    std::vector<Index> vertices;
    for (Index t = 0; t < mesh_.triangles.size (); ++t) {
      const Triangle& corners = mesh_.triangles[t];
      const Eigen::Vector3d normal = cost_.unitNormal (corners);
      bool bad = cost_.isTurned (corners);
      for (std::uint8_t side = 0; side < 3 && !bad; ++side)
        bad = edgeCost (mesh_, cost_, {t, side}, normal) > 0.0;
      if (bad)
        vertices.insert (vertices.end (), corners.begin (), corners.end ());
    }
    makeSet (vertices);
    return vertices;
  }

  // Cost of some triangles and all their edges, those between two of them once.
  double costOf (const Index* first, const Index* last) const
  {
    double sum = 0.0;
    for (const Index* t = first; t != last; ++t) {
      const Eigen::Vector3d normal = cost_.unitNormal (mesh_.triangles[*t]);
      sum += cost_ (mesh_.triangles[*t]);
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index other = mesh_.neighbors[*t][side];
        if (other != NONE && (std::find (first, last, other) == last || *t < other))
          sum += edgeCost (mesh_, cost_, {*t, side}, normal);
      }
    }
    return sum;
  }

  // Takes the vertex out, if that can be done. Returns the change of cost.
  bool takeOut (Index v, double& change)
  {
    mesh_.fan (v, fan_);
    if (fan_.size () < 3 || fan_.size () > LARGEST_FAN)
      return false;
    const Index last = fan_.back ();
    if (mesh_.neighbors[last][SurfaceMesh::next (mesh_.sideOf (last, v))] != fan_.front ())
      return false; // at the boundary
    polygon_.clear ();
    for (Index t : fan_)
      polygon_.push_back (mesh_.from ({t, mesh_.sideOf (t, v)}));
    filled_ = filling_.fill (polygon_, cost_,
                             [this] (Index p, Index q) { return !mesh_.hasEdge (p, q); });
    if (filled_.empty () || (filled_.size () == 1 && isTriangle (filled_.front ())))
      return false;
    slots_ = fan_;
    change = -costOf (slots_.data (), slots_.data () + slots_.size ());
    mesh_.replaceFan (v, slots_, filled_);
    change += costOf (slots_.data (), slots_.data () + filled_.size ());
    return true;
  }

  // Moves the vertex to the place where the cost of the mesh gets least, if less than now. Returns
  // the change of cost, 0 if it stays.
  double move (Index v, std::size_t tried)
  {
    const std::size_t before = journal_.mark ();
    double change = 0.0;
    if (!takeOut (v, change))
      return 0.0;
    const std::size_t without = journal_.mark ();
    double best = -IMPROVES;
    Index best_place = NONE;
    for (const auto& [added, t] : places (v, tried)) {
      const double total = change + added + settleAt (v, t);
      mesh_.undo (without);
      if (total < best) {
        best = total;
        best_place = t;
      }
    }
    if (best_place == NONE) {
      mesh_.undo (before);
      return 0.0;
    }
    settleAt (v, best_place);
    touch (v);
    return best;
  }

  // Moves the vertex to the place of a rank by the cost that it adds there. Returns the change.
  double moveTo (Index v, std::size_t rank)
  {
    double change = 0.0;
    if (!takeOut (v, change))
      return 0.0;
    const std::vector<std::pair<double, Index>> ranked = places (v, KICKS);
    if (rank >= ranked.size ()) {
      mesh_.undo (0);
      return 0.0;
    }
    change += ranked[rank].first + settleAt (v, ranked[rank].second);
    touch (v);
    return change;
  }

  // Notes the old and the new neighbours of a vertex that has been moved.
  void touch (Index v)
  {
    touched_.insert (touched_.end (), polygon_.begin (), polygon_.end ());
    mesh_.fan (v, fan_);
    for (Index u : fan_)
      touched_.insert (touched_.end (), mesh_.triangles[u].begin (), mesh_.triangles[u].end ());
  }

  // Splits a triangle at a vertex, in the slots that its fan has left, and flips edges from there
  // and from the filling. Returns the change of cost by the flips.
  double settleAt (Index v, Index t)
  {
    mesh_.split (t, v, slots_[slots_.size () - 2], slots_.back ());
    mesh_.fan (v, fan_);
    fan_.insert (fan_.end (), slots_.begin (), slots_.end () - 2);
    for (Index u : fan_)
      for (std::uint8_t side = 0; side < 3; ++side)
        flipper_.push ({u, side});
    return flipper_.run ();
  }

  // True if the mesh has a triangle of these corners, the other way round: the tetrahedron's last.
  bool isTriangle (const Triangle& corners)
  {
    std::vector<Index> around;
    mesh_.fan (corners[0], around);
    return std::any_of (around.begin (), around.end (), [&] (Index t) {
      const Triangle& c = mesh_.triangles[t];
      return std::find (c.begin (), c.end (), corners[1]) != c.end () &&
             std::find (c.begin (), c.end (), corners[2]) != c.end ();
    });
  }

  // The triangles in which the vertex costs least, with the cost that its split adds.
  std::vector<std::pair<double, Index>> places (Index v, std::size_t most)
  {
    std::vector<Index> candidates (slots_.begin (), slots_.end () - 2);
    for (Index q : near_.row (v)) {
      mesh_.fan (q, fan_);
      candidates.insert (candidates.end (), fan_.begin (), fan_.end ());
    }
    makeSet (candidates);
    std::vector<std::pair<double, Index>> places;
    for (Index t : candidates)
      places.emplace_back (splitCost (mesh_, cost_, t, v), t);
    const std::size_t kept = std::min (most, places.size ());
    std::partial_sort (places.begin (), places.begin () + static_cast<std::ptrdiff_t> (kept),
                       places.end ());
    places.resize (kept);
    return places;
  }

  SurfaceMesh& mesh_;
  const FlatLists& near_;
  const TriangleCost& cost_;
  MeshJournal journal_;
  EdgeFlipper flipper_;
  PolygonFilling filling_;
  std::vector<Triangle> filled_; // of the hole that the vertex taken out has left ...
  std::vector<Index> slots_;     // ... in these but for the last two, which are free
  std::vector<Index> fan_, polygon_, touched_;
};

} // namespace

std::vector<MeshEdge>
findFolds (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions)
{
  const auto areaVector = [&positions] (const Triangle& t) -> Eigen::Vector3d {
    return (positions[t[1]] - positions[t[0]]).cross (positions[t[2]] - positions[t[0]]);
  };
  std::vector<MeshEdge> folds;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index u = mesh.neighbors[t][side];
      if (u == NONE || u < t)
        continue;
      const Eigen::Vector3d a = areaVector (mesh.triangles[t]);
      const Eigen::Vector3d b = areaVector (mesh.triangles[u]);
      if (a.dot (b) < FOLD_COSINE * a.norm () * b.norm ())
        folds.push_back ({t, side});
    }
  return folds;
}

std::size_t
moveVertices (SurfaceMesh& mesh, const FlatLists& near, const TriangleCost& cost,
              const std::vector<Eigen::Vector3d>& positions)
{
  VertexMover mover (mesh, near, cost);
  std::size_t moves = mover.run ();
  for (int pass = 0; pass < KICK_PASSES; ++pass) {
    std::vector<Index> vertices;
    for (const MeshEdge& fold : findFolds (mesh, positions))
      for (Index p :
           {mesh.corner (fold), mesh.from (fold), mesh.to (fold), mesh.corner (mesh.mate (fold))})
        vertices.push_back (p);
    std::sort (vertices.begin (), vertices.end ());
    vertices.erase (std::unique (vertices.begin (), vertices.end ()), vertices.end ());
    const std::size_t kicks = mover.kick (vertices);
    if (kicks == 0)
      break;
    moves += kicks;
  }
  return moves;
}

} // namespace floater
} // namespace pcl
