// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/mesh_piece.h"

#include "core/order_statistics.h"

#include <algorithm>

namespace pcl::floater {
MeshPiece
cutOut (const std::vector<Triangle>& triangles, const std::vector<Index>& piece,
        const std::vector<Eigen::Vector3d>& positions)
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
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = static_cast<Index> (
          std::lower_bound (result.points.begin (), result.points.end (), triangles[t][i]) -
          result.points.begin ());
    result.mesh.triangles.push_back (corners);
  }
  if (!result.mesh.connect (result.points.size (), 1))
    return result;
  // By Euler's formula.
  std::vector<std::vector<Index>> loops = boundaryLoops (result.mesh, 1);
  if (loops.size () == 1 && 2 * result.points.size () == piece.size () + loops.front ().size () + 2)
    result.loop = std::move (loops.front ());
  return result;
}

} // namespace pcl::floater
