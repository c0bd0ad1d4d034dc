// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/chart_mesh.h"

#include "core/exact.h"
#include "core/order_statistics.h"

#include <Eigen/LU>

namespace pcl::floater {
MeshPiece
cutOut (const std::vector<Triangle>& triangles, const std::vector<Index>& piece,
        const Positions& positions)
{
  MeshPiece result;
  result.points.reserve (3 * piece.size ());
  for (const Index t : piece)
    result.points.insert (result.points.end (), triangles[t].begin (), triangles[t].end ());
  sortUnique (result.points);
  result.points.shrink_to_fit ();
  result.positions = valuesAt (positions, result.points);
  result.mesh.triangles.reserve (piece.size ());
  for (const Index t : piece) {
    const auto& [a, b, c] = triangles[t];
    result.mesh.triangles.push_back (
        {placeIn (result.points, a), placeIn (result.points, b), placeIn (result.points, c)});
  }
  if (!result.mesh.connect (result.points.size (), 1))
    return result;
  // By Euler's formula.
  std::vector<std::vector<Index>> loops = boundaryLoops (result.mesh, 1);
  if (loops.size () == 1 && 2 * result.points.size () == piece.size () + loops.front ().size () + 2)
    result.loop = std::move (loops.front ());
  return result;
}

MeshRings::MeshRings (const TriangleMesh& mesh)
    : leaving (makeCsrLists (mesh.triangle_of.size (),
                             [&mesh] (const auto& emit) {
                               for (Index t = 0; t < mesh.triangles.size (); ++t)
                                 for (std::uint8_t side = 0; side < 3; ++side)
                                   emit (mesh.from ({t, side}), 3 * t + side);
                             })),
      before (mesh.triangle_of.size (), NONE), after (before)
{
  for (const MeshEdge edge : boundaryEdges (mesh)) {
    after[mesh.from (edge)] = mesh.to (edge);
    before[mesh.to (edge)] = mesh.from (edge);
  }
  neighbors = makeCsrLists (before.size (), [&] (const auto& emit) {
    for (Index p = 0; p < before.size (); ++p) {
      for (const Index id : leaving.row (p))
        emit (p, mesh.to ({id / 3, static_cast<std::uint8_t> (id % 3)}));
      if (before[p] != NONE)
        emit (p, before[p]);
    }
  });
}

RestShapes
makeRestShapes (const MeshPiece& chart)
{
  RestShapes result;
  double longest = 0.0;
  for (const Triangle& t : chart.mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max (longest,
                          (chart.positions[t[(i + 1) % 3]] - chart.positions[t[i]]).squaredNorm ());
  const double shortest = longest > 0.0 ? LEAST_HEIGHT * std::sqrt (longest) : 1.0;
  result.shapes.reserve (chart.mesh.triangles.size ());
  for (const Triangle& t : chart.mesh.triangles) {
    const auto edgeAcross = [&] (std::size_t corner) -> Vector3d {
      return chart.positions[t[(corner + 2) % 3]] - chart.positions[t[(corner + 1) % 3]];
    };
    std::size_t apex = 0; // opposite to the longest edge, which comes to lie on the first axis
    for (const std::size_t i : {1U, 2U})
      if (edgeAcross (i).squaredNorm () > edgeAcross (apex).squaredNorm ())
        apex = i;
    const Vector3d base = edgeAcross (apex), up = -edgeAcross ((apex + 2) % 3);
    const double length = std::max (base.norm (), shortest);
    std::array<Vector2d, 3> corners{Vector2d::Zero (), Vector2d::Zero (), Vector2d::Zero ()};
    corners[(apex + 2) % 3] = {length, 0.0};
    corners[apex] = {up.dot (base) / length,
                     std::max (base.cross (up).norm () / length, LEAST_HEIGHT * length)};
    Eigen::Matrix2d edges;
    edges << corners[1] - corners[0], corners[2] - corners[0];
    result.shapes.push_back ({edges.inverse (), 0.5 * edges.determinant ()});
    result.area += result.shapes.back ().area;
  }
  const double scale = std::sqrt (result.area);
  for (RestShape& shape : result.shapes) {
    shape.to_unit *= scale;
    shape.area /= result.area;
  }
  return result;
}

void
StretchSums::add (const std::array<Vector3d, 3>& place, const std::array<Vector2d, 3>& uv)
{
  const double area = 0.5 * areaVector (place[0], place[1], place[2]).norm ();
  const Vector2d e = uv[1] - uv[0], f = uv[2] - uv[0];
  const double determinant = cross (e, f);
  plane_area_ += 0.5 * determinant;
  if (!(area > 0.0))
    return;
  area_ += area;
  if (!(determinant > 0.0)) {
    squares_ = largest_ = std::numeric_limits<double>::infinity ();
    return;
  }
  // Columns of the Jacobian of the map from the plane.
  const Vector3d E = place[1] - place[0], F = place[2] - place[0];
  const Vector3d along_u = (E * f.y () - F * e.y ()) / determinant;
  const Vector3d along_v = (F * e.x () - E * f.x ()) / determinant;
  const double a = along_u.squaredNorm (), b = along_u.dot (along_v), c = along_v.squaredNorm ();
  squares_ += area * 0.5 * (a + c);
  largest_ = std::max (largest_, std::sqrt (0.5 * (a + c + std::hypot (a - c, 2.0 * b))));
}

double
StretchSums::mean () const
{
  if (std::isinf (squares_)) // also if the area in the plane is negative
    return squares_;
  return area_ > 0.0 ? std::sqrt (squares_ * plane_area_) / area_ : 1.0;
}

double
StretchSums::largest () const
{
  if (std::isinf (largest_))
    return largest_;
  return area_ > 0.0 ? largest_ * std::sqrt (plane_area_ / area_) : 1.0;
}

StretchSums
stretchOf (const std::vector<Triangle>& triangles, const Positions& positions,
           const std::vector<Triangle>& corners, const std::vector<Vector2d>& uv)
{
  StretchSums sums;
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    const auto& [a, b, c] = triangles[t];
    const auto& [i, j, k] = corners[t];
    sums.add ({positions[a], positions[b], positions[c]}, {uv[i], uv[j], uv[k]});
  }
  return sums;
}

std::vector<Index>
flippedTriangles (const std::vector<Triangle>& triangles, const std::vector<Vector2d>& uv)
{
  return indicesWhere (triangles.size (), [&] (Index t) {
    const auto& [a, b, c] = triangles[t];
    return !isAntiClockwise (uv[a], uv[b], uv[c]);
  });
}

} // namespace pcl::floater
