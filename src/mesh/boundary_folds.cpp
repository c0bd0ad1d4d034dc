// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/boundary_folds.h"

#include "core/geometry.h"
#include "mesh/boundary_peel.h"
#include "mesh/fold_repair.h"
#include "mesh/triangle_removal.h"

#include <limits>

namespace pcl::floater {
namespace {
class FoldOpener
{
public:
  FoldOpener (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const RunContext& run)
      : mesh_ (mesh), positions_ (positions), peel_ (mesh, positions.size (), run)
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
      area += areaVector (positions_[mesh_.corner (e)], positions_[mesh_.from (e)],
                          positions_[mesh_.to (e)])
                  .norm ();
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
  FoldOpener opener (mesh, positions, run);
  std::size_t count = 0;
  for (const MeshEdge fold : folds)
    count += opener.open (fold);
  if (count > 0)
    removeTriangles (mesh, std::move (opener).takenTriangles (), run);
  return count;
}

} // namespace pcl::floater
