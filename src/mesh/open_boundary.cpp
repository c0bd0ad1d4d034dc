// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/open_boundary.h"

#include "core/geometry.h"
#include "mesh/fold_repair.h"
#include "mesh/trimming.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace pcl::floater {
namespace {
class FoldOpener
{
public:
  FoldOpener (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions)
      : mesh_ (mesh), positions_ (positions), peel_ (mesh, positions.size ())
  {
  }

  // Removes the triangles that end a fold, if there are any. Returns their number.
  std::size_t open (MeshEdge fold)
  {
    const MeshEdge other = mesh_.mate (fold);
    if (peel_.isBoundary (fold) || peel_.isBoundary (other))
      return 0;
    best_.clear ();
    least_area_ = std::numeric_limits<double>::infinity ();
    offerAround (fold);
    offerAround (other);
    for (const MeshEdge e : best_)
      peel_.take (e);
    return best_.size ();
  }

  std::vector<std::uint8_t> takenTriangles () && { return std::move (peel_).takenTriangles (); }

private:
  // Offers the triangle of a folded edge, or, if it is not at the boundary, a triangle beside it
  // first.
  void offerAround (MeshEdge fold)
  {
    for (const std::uint8_t side : otherSides (fold)) {
      const MeshEdge e{fold.triangle, side};
      if (peel_.isBoundary (e)) {
        if (peel_.mayTake (e))
          offer ({e});
        continue;
      }
      const MeshEdge beside = mesh_.mate (e);
      if (beside.triangle == NONE) // border of a submesh
        continue;
      for (const std::uint8_t outer : otherSides (beside)) {
        const MeshEdge first{beside.triangle, outer};
        if (!peel_.isBoundary (first) || !peel_.mayTake (first))
          continue;
        peel_.take (first);
        if (peel_.mayTake (e))
          offer ({first, e});
        peel_.putBack (first);
      }
    }
  }

  void offer (const std::vector<MeshEdge>& triangles)
  {
    double area = 0.0;
    for (const MeshEdge e : triangles)
      area += areaVectorOf (mesh_.triangles[e.triangle], positions_).norm ();
    if (area < least_area_) {
      least_area_ = area;
      best_ = triangles;
    }
  }

  static std::array<std::uint8_t, 2> otherSides (MeshEdge e)
  {
    return {TriangleMesh::next (e.side), TriangleMesh::previous (e.side)};
  }

  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  BoundaryPeel peel_;
  std::vector<MeshEdge> best_; // boundary edges of triangles, in the order of removal
  double least_area_ = 0.0;
};

} // namespace

std::size_t
openBoundaryFolds (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                   const RunContext& run)
{
  const std::vector<MeshEdge> folds = findFolds (mesh, positions, run);
  if (folds.empty ())
    return 0;
  FoldOpener opener (mesh, positions);
  std::size_t count = 0;
  for (const MeshEdge fold : folds)
    count += opener.open (fold);
  if (count > 0)
    removeTriangles (mesh, std::move (opener).takenTriangles (), run);
  return count;
}

namespace {
using Positions = std::vector<Eigen::Vector3d>;

// Cosine of the angle opposite to an edge; 1 if points coincide.
double
cosineAt (MeshEdge e, const TriangleMesh& mesh, const Positions& positions)
{
  const Eigen::Vector3d& corner = positions[mesh.corner (e)];
  const Eigen::Vector3d a = positions[mesh.from (e)] - corner;
  const Eigen::Vector3d b = positions[mesh.to (e)] - corner;
  const double product = a.norm () * b.norm ();
  return product > 0.0 ? a.dot (b) / product : 1.0;
}

// Cosine that a share of all corners does not exceed.
double
usualCosine (std::vector<double> corners, double share)
{
  const auto at = corners.begin () +
                  static_cast<std::ptrdiff_t> (share * static_cast<double> (corners.size ()));
  std::nth_element (corners.begin (), at, corners.end ());
  return *at;
}

class NotchOpener
{
public:
  NotchOpener (const TriangleMesh& mesh, const Positions& positions)
      : mesh_ (mesh), positions_ (positions), peel_ (mesh, positions.size ())
  {
  }

  /// Removes notches with cosines below the limit. Returns the number of triangles.
  std::size_t run (std::vector<double> corners, const NotchLimits& limits)
  {
    if (peel_.edges ().empty ())
      return 0;
    limit_ =
        std::min (limits.largest_cosine, usualCosine (std::move (corners), limits.usual_share));
    for (const MeshEdge e : peel_.edges ())
      offer (e);
    std::size_t count = 0;
    while (!notches_.empty ()) {
      const auto [cosine, triangle, side] = notches_.top ();
      notches_.pop ();
      const MeshEdge e{triangle, side};
      if (!peel_.mayTake (e))
        continue;
      peel_.take (e);
      ++count;
      offer (mesh_.mate ({triangle, TriangleMesh::next (side)}));
      offer (mesh_.mate ({triangle, TriangleMesh::previous (side)}));
    }
    return count;
  }

  std::vector<std::uint8_t> takenTriangles () && { return std::move (peel_).takenTriangles (); }

private:
  using Notch = std::tuple<double, Index, std::uint8_t>; // cosine, triangle, side of the boundary

  void offer (MeshEdge e)
  {
    const double cosine = cosineAt (e, mesh_, positions_);
    if (cosine < limit_)
      notches_.emplace (cosine, e.triangle, e.side);
  }

  const TriangleMesh& mesh_;
  const Positions& positions_;
  double limit_ = 0.0;
  BoundaryPeel peel_;
  std::priority_queue<Notch, std::vector<Notch>, std::greater<>> notches_;
};

// Cosines of the corners of some triangles, spread evenly over the mesh.
std::vector<double>
sampleCorners (const TriangleMesh& mesh, const Positions& positions, const RunContext& run)
{
  constexpr std::size_t SAMPLE = 20'000; // triangles
  const std::size_t step = std::max<std::size_t> (1, mesh.triangles.size () / SAMPLE);
  std::vector<double> cosines;
  ProgressLoop progress (run); // each triangle may load memory pages
  for (std::size_t t = 0; t < mesh.triangles.size (); t += step) {
    progress.next ();
    for (std::uint8_t side = 0; side < 3; ++side)
      cosines.push_back (cosineAt ({static_cast<Index> (t), side}, mesh, positions));
  }
  return cosines;
}

} // namespace

std::size_t
openNotches (TriangleMesh& mesh, const Positions& positions, const NotchLimits& limits,
             const RunContext& run)
{
  NotchOpener opener (mesh, positions);
  const std::size_t count = opener.run (sampleCorners (mesh, positions, run), limits);
  if (count > 0)
    removeTriangles (mesh, std::move (opener).takenTriangles (), run);
  return count;
}

} // namespace pcl::floater
