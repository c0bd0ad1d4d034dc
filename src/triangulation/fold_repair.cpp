// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/fold_repair.h"

#include "triangulation/flips.h"
#include "triangulation/patch.h"
#include "triangulation/polygon_filling.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double FOLD_COSINE = -0.5; // 120 degrees between the normals of neighbours
constexpr double FOLD_COST = 200.0; // of an edge, per unit of negative cosine between its triangles
constexpr int RINGS = 2;            // of triangles around a fold that may change
constexpr int PASSES = 6;
constexpr std::size_t LARGEST_FAN = 14; // vertices of more triangles are not moved
constexpr std::size_t PLACES = 4;       // cheapest triangles into which a vertex is tried
constexpr double IMPROVES = 1e-6;

Eigen::Vector3d
areaVector (const std::vector<Eigen::Vector3d>& positions, const Triangle& t)
{
  return (positions[t[1]] - positions[t[0]]).cross (positions[t[2]] - positions[t[0]]);
}

double
foldCost (const Eigen::Vector3d& unit_a, const Eigen::Vector3d& unit_b)
{
  return FOLD_COST * std::max (0.0, -unit_a.dot (unit_b));
}

// Moves the vertices of one patch to where they fit.
class PatchRepair
{
public:
  PatchRepair (Patch& patch, const SurfaceMesh& whole)
      : patch_ (patch), whole_ (whole), cost_ (patch.positions, patch.normals),
        energy_ (energy (patch.mesh))
  {
  }

  /// Returns true if anything got better.
  bool run ()
  {
    bool better = false;
    for (int pass = 0; pass < PASSES; ++pass) {
      std::vector<Index> vertices = foldedVertices ();
      bool moved = false;
      for (Index v : vertices)
        moved = relocate (v) || moved;
      better = better || moved;
      if (!moved)
        break;
    }
    return better;
  }

private:
  double energy (const SurfaceMesh& mesh) const
  {
    std::vector<Eigen::Vector3d> units;
    units.reserve (mesh.triangles.size ());
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
      units.push_back (areaVector (patch_.positions, t).normalized ());
      sum += cost_ (t);
    }
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index u = mesh.neighbors[t][side];
        if (u != NONE && t < u)
          sum += foldCost (units[t], units[u]);
        else if (u == NONE)
          for (const Patch::RimEdge& edge : patch_.rim)
            if (edge.from == mesh.from ({t, side}) && edge.to == mesh.to ({t, side}))
              sum += foldCost (units[t], edge.normal);
      }
    return sum;
  }

  // Corners of the triangles at folds.
  std::vector<Index> foldedVertices () const
  {
    std::vector<Index> vertices;
    for (const MeshEdge& fold : findFolds (patch_.mesh, patch_.positions))
      for (const Index t : {fold.triangle, patch_.mesh.neighbors[fold.triangle][fold.side]})
        vertices.insert (vertices.end (), patch_.mesh.triangles[t].begin (),
                         patch_.mesh.triangles[t].end ());
    std::sort (vertices.begin (), vertices.end ());
    vertices.erase (std::unique (vertices.begin (), vertices.end ()), vertices.end ());
    return vertices;
  }

  bool relocate (Index v)
  {
    const SurfaceMesh& mesh = patch_.mesh;
    mesh.fan (v, fan_);
    const bool closed =
        mesh.neighbors[fan_.back ()][SurfaceMesh::next (mesh.sideOf (fan_.back (), v))] ==
        fan_.front ();
    if (!closed || fan_.size () < 3 || fan_.size () > LARGEST_FAN)
      return false;
    std::vector<Index> polygon;
    for (Index t : fan_)
      polygon.push_back (mesh.from ({t, mesh.sideOf (t, v)}));
    const auto allowed = [&] (Index p, Index q) {
      return !mesh.hasEdge (p, q) && !joinedOutside (patch_, whole_, p, q);
    };
    const std::vector<Triangle> filling = filling_.fill (polygon, cost_, allowed);
    if (filling.empty ())
      return false;
    std::vector<Triangle> without = filling;
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      if (std::find (fan_.begin (), fan_.end (), t) == fan_.end ())
        without.push_back (mesh.triangles[t]);

    // Places for the vertex by the cost that they add.
    std::vector<std::pair<double, std::size_t>> places;
    for (std::size_t t = 0; t < without.size (); ++t) {
      const Triangle& c = without[t];
      places.emplace_back (
          cost_ (v, c[1], c[2]) + cost_ (v, c[2], c[0]) + cost_ (v, c[0], c[1]) - cost_ (c), t);
    }
    const std::size_t tried = std::min (PLACES, places.size ());
    std::partial_sort (places.begin (), places.begin () + static_cast<std::ptrdiff_t> (tried),
                       places.end ());
    bool improved = false;
    SurfaceMesh best;
    for (std::size_t i = 0; i < tried; ++i) {
      SurfaceMesh trial;
      trial.triangles = without;
      if (!trial.connect (patch_.points.size ()))
        continue;
      trial.split (static_cast<Index> (places[i].second), v);
      flipEdges (trial, cost_,
                 [&] (Index p, Index q) { return !joinedOutside (patch_, whole_, p, q); });
      const double reached = energy (trial);
      if (reached < energy_ - IMPROVES * std::abs (energy_)) {
        energy_ = reached;
        best = std::move (trial);
        improved = true;
      }
    }
    if (improved)
      patch_.mesh = std::move (best);
    return improved;
  }

  Patch& patch_;
  const SurfaceMesh& whole_;
  TriangleCost cost_;
  double energy_;
  PolygonFilling filling_;
  std::vector<Index> fan_;
};

} // namespace

std::vector<MeshEdge>
findFolds (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions)
{
  std::vector<MeshEdge> folds;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index u = mesh.neighbors[t][side];
      if (u == NONE || u < t)
        continue;
      const Eigen::Vector3d a = areaVector (positions, mesh.triangles[t]);
      const Eigen::Vector3d b = areaVector (positions, mesh.triangles[u]);
      if (a.dot (b) < FOLD_COSINE * a.norm () * b.norm ())
        folds.push_back ({t, side});
    }
  return folds;
}

std::vector<MeshEdge>
repairFolds (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const std::vector<Eigen::Vector3f>& normals, std::vector<MeshEdge> folds)
{
  std::set<std::pair<Index, Index>> hopeless; // edges whose patch did not get better
  for (int pass = 0; pass < PASSES; ++pass) {
    bool better = false;
    for (const MeshEdge& fold : folds) {
      // The edge may have gone with the repair of another fold; its place is still worth a look.
      const Index t = fold.triangle;
      const Index u = mesh.neighbors[t][fold.side];
      const std::pair<Index, Index> edge = std::minmax ({mesh.from (fold), mesh.to (fold)});
      if (u == NONE || hopeless.count (edge) != 0)
        continue;
      Patch patch = cutPatch (mesh, positions, normals, {t, u}, RINGS);
      if (findFolds (patch.mesh, patch.positions).empty ())
        continue;
      if (PatchRepair (patch, mesh).run ()) {
        pastePatch (patch, mesh);
        better = true;
      }
      else {
        hopeless.insert (edge);
      }
    }
    if (!better)
      break;
    folds = findFolds (mesh, positions);
  }
  return folds;
}

} // namespace floater
} // namespace pcl
