// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/outward.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// Least volume of an open piece, closed over its rim from its middle, that tells an inside from an
// outside: as a share of what it would be if all of it faced straight away from there. A half
// sphere has 0.8, a round bowl that is half as deep as that 0.5, a volcano 0.25, terrain less.
constexpr double HAS_INSIDE = 0.3;
constexpr double ALIKE = 0.9; // lengths along two axes, relative

// Sums over the triangles of a piece.
struct Piece
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero (); // first times the area
  Eigen::Vector3d area_vector = Eigen::Vector3d::Zero ();
  double area = 0.0;
  double volume = 0.0;         // six times that of the pyramids from the middle to all triangles
  double largest_volume = 0.0; // if all faced away from the middle
  bool is_closed = true;
};

Eigen::Vector3d
areaVector (const Triangle& t, const std::vector<Eigen::Vector3d>& positions)
{
  return (positions[t[1]] - positions[t[0]]).cross (positions[t[2]] - positions[t[0]]);
}

Eigen::Vector3d
threeCentroids (const Triangle& t, const std::vector<Eigen::Vector3d>& positions)
{
  return positions[t[0]] + positions[t[1]] + positions[t[2]];
}

std::vector<Piece>
measurePieces (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const std::vector<Index>& piece_of, Index count)
{
  std::vector<Piece> pieces (count);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    Piece& piece = pieces[piece_of[t]];
    const Eigen::Vector3d area_vector = areaVector (mesh.triangles[t], positions);
    const double area = area_vector.norm ();
    piece.middle += area / 3.0 * threeCentroids (mesh.triangles[t], positions);
    piece.area_vector += area_vector;
    piece.area += area;
    for (const Index u : mesh.neighbors[t])
      piece.is_closed = piece.is_closed && u != NONE;
  }
  for (Piece& piece : pieces)
    if (piece.area > 0.0)
      piece.middle /= piece.area;
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    Piece& piece = pieces[piece_of[t]];
    const Eigen::Vector3d area_vector = areaVector (mesh.triangles[t], positions);
    const Eigen::Vector3d away = threeCentroids (mesh.triangles[t], positions) / 3.0 - piece.middle;
    piece.volume += away.dot (area_vector);
    piece.largest_volume += away.norm () * area_vector.norm ();
  }
  return pieces;
}

bool
facesDown (const Eigen::Vector3d& normal)
{
  const double longest = normal.cwiseAbs ().maxCoeff ();
  for (const int axis : {2, 1})
    if (std::abs (normal[axis]) >= ALIKE * longest)
      return normal[axis] < 0.0;
  return normal.x () < 0.0;
}

bool
facesInwards (const Piece& piece)
{
  if (piece.is_closed || std::abs (piece.volume) >= HAS_INSIDE * piece.largest_volume)
    return piece.volume < 0.0;
  return facesDown (piece.area_vector);
}

} // namespace

std::size_t
faceOutwards (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions)
{
  Index count = 0;
  const std::vector<Index> piece_of = findPieces (mesh, count);
  const std::vector<Piece> pieces = measurePieces (mesh, positions, piece_of, count);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (facesInwards (pieces[piece_of[t]])) {
      std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
      std::swap (mesh.neighbors[t][1], mesh.neighbors[t][2]);
    }
  return static_cast<std::size_t> (std::count_if (pieces.begin (), pieces.end (), facesInwards));
}

} // namespace floater
} // namespace pcl
