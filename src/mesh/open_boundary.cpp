// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/open_boundary.h"

#include "core/order_statistics.h"
#include "mesh/folds.h"
#include "mesh/trimming.h"

#include <queue>
#include <tuple>

namespace pcl::floater {
namespace {
std::array<std::uint8_t, 2>
otherSides (MeshEdge e)
{
  return {TriangleMesh::next (e.side), TriangleMesh::previous (e.side)};
}

// Calls offer (edges) for the triangle of a folded edge, or, if it is not at the boundary, for a
// triangle beside it and this one, by boundary edges in the order of removal.
template <typename Offer>
void
offerAround (MeshEdge fold, const TriangleMesh& mesh, BoundaryPeel& peel, Offer&& offer)
{
  for (const std::uint8_t side : otherSides (fold)) {
    const MeshEdge e{fold.triangle, side};
    if (peel.isBoundary (e)) {
      if (peel.mayTake (e))
        offer ({e});
      continue;
    }
    const MeshEdge beside = mesh.mate (e);
    for (const std::uint8_t outer : otherSides (beside)) {
      const MeshEdge first{beside.triangle, outer};
      if (!peel.isBoundary (first) || !peel.mayTake (first))
        continue;
      peel.take (first);
      if (peel.mayTake (e))
        offer ({first, e});
      peel.putBack (first);
    }
  }
}

// Cosine of the angle opposite to an edge; 1 if points coincide.
double
cosineAt (MeshEdge e, const TriangleMesh& mesh, const Positions& positions)
{
  const Vector3d& corner = positions[mesh.corner (e)];
  const Vector3d a = positions[mesh.from (e)] - corner;
  const Vector3d b = positions[mesh.to (e)] - corner;
  const double product = a.norm () * b.norm ();
  return product > 0.0 ? a.dot (b) / product : 1.0;
}

} // namespace

void
openBoundaryFolds (TriangleMesh& mesh, const Positions& positions, const RunContext& run)
{
  BoundaryPeel peel{mesh};
  for (const MeshEdge fold : findFolds (mesh, positions, run)) {
    const MeshEdge other = mesh.mate (fold);
    if (peel.isBoundary (fold) || peel.isBoundary (other))
      continue;
    std::vector<MeshEdge> best;
    double least_area = std::numeric_limits<double>::infinity ();
    const auto offer = [&] (const std::vector<MeshEdge>& triangles) {
      double area = 0.0;
      for (const MeshEdge e : triangles)
        area += areaVectorOf (mesh.triangles[e.triangle], positions).norm ();
      if (area < least_area) {
        least_area = area;
        best = triangles;
      }
    };
    offerAround (fold, mesh, peel, offer);
    offerAround (other, mesh, peel, offer);
    for (const MeshEdge e : best)
      peel.take (e);
  }
  removeTriangles (mesh, std::move (peel.is_taken), run);
}

Flags
chooseCrossingAtBoundary (const TriangleMesh& mesh, const std::vector<CrossingPair>& pairs)
{
  BoundaryPeel peel{mesh};
  bool has_any = false;
  for (const CrossingPair& pair : pairs)
    for (const Index t : {pair.first, pair.second}) {
      if (peel.isTaken (pair.first) || peel.isTaken (pair.second))
        break;
      std::vector<MeshEdge> open;
      for (std::uint8_t side = 0; side < 3; ++side)
        if (peel.isBoundary ({t, side}))
          open.push_back ({t, side});
      if (open.size () == 2 || (open.size () == 1 && peel.mayTake (open.front ()))) {
        peel.take (open.front ());
        has_any = true;
      }
    }
  return has_any ? std::move (peel.is_taken) : Flags ();
}

void
openNotches (TriangleMesh& mesh, const Positions& positions, const RunContext& run)
{
  // Share of the corners of all triangles. An angle that at least this share reaches may belong to the
  // surface: among random points in the plane, 3 % of all corners have 120 degrees or more. With 1 %, 31
  // of the 48 areas were within 1 %; with 2 %, 35; with 3 or 5 %, 36, and 5 % removes half as many true
  // triangles again.
  constexpr double USUAL_SHARE = 0.03;
  constexpr double LARGEST_COSINE = -0.02; // 91 degrees: rounding does not decide in a grid
  constexpr std::size_t SAMPLE = 20'000;   // triangles whose corners are asked
  using Notch = std::tuple<double, Index, std::uint8_t>; // cosine, triangle, side of the boundary
  const std::vector<MeshEdge> edges = boundaryEdges (mesh);
  if (edges.empty ())
    return;
  std::vector<double> corners; // cosines, of triangles that are spread evenly over the mesh
  const std::size_t step = std::max<std::size_t> (1, mesh.triangles.size () / SAMPLE);
  ProgressLoop progress (run); // each triangle may load memory pages
  for (std::size_t t = 0; t < mesh.triangles.size (); t += step) {
    progress.next ();
    for (std::uint8_t side = 0; side < 3; ++side)
      corners.push_back (cosineAt ({static_cast<Index> (t), side}, mesh, positions));
  }
  const double limit = std::min (LARGEST_COSINE, quantile (corners, USUAL_SHARE));
  std::priority_queue<Notch, std::vector<Notch>, std::greater<>> notches;
  const auto offer = [&] (MeshEdge e) {
    const double cosine = cosineAt (e, mesh, positions);
    if (cosine < limit)
      notches.emplace (cosine, e.triangle, e.side);
  };
  std::for_each (edges.begin (), edges.end (), offer);
  BoundaryPeel peel{mesh};
  while (!notches.empty ()) {
    const auto [cosine, triangle, side] = notches.top ();
    notches.pop ();
    const MeshEdge e{triangle, side};
    if (!peel.mayTake (e))
      continue;
    peel.take (e);
    for (const std::uint8_t beside : otherSides (e))
      offer (mesh.mate ({triangle, beside}));
  }
  removeTriangles (mesh, std::move (peel.is_taken), run);
}

} // namespace pcl::floater
