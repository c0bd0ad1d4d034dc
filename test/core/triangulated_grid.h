// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet whose stars are known without a search, for the tests of weights and the linear system.
#pragma once

#include "local/stars.h"
#include "random_stream.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pcl::floater {
/// side x side points of a unit square in z = 0, row by row, interior ones moved at random by up to
/// `jitter` of the spacing (below 0.15, so that every star surrounds its centre); cells are cut
/// along one diagonal. Border stars are rotated so that their gap is at the end, as in Stars.
struct TriangulatedGrid
{
  std::vector<Eigen::Vector3d> positions;
  Stars stars;
  std::vector<Index> loop; ///< the border, anti-clockwise

  TriangulatedGrid (int side, double jitter, std::uint64_t seed)
  {
    RandomStream random (seed);
    const auto onBorder = [side] (int x, int y) {
      return x == 0 || y == 0 || x == side - 1 || y == side - 1;
    };
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const double reach = onBorder (x, y) ? 0.0 : jitter;
        const double dx = reach * (2.0 * random.uniform () - 1.0);
        const double dy = reach * (2.0 * random.uniform () - 1.0);
        positions.emplace_back ((x + dx) / (side - 1), (y + dy) / (side - 1), 0.0);
      }
    stars.neighbors.offsets.push_back (0);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        addStar (x, y, side, onBorder (x, y));
    for (int i = 0; i + 1 < side; ++i)
      loop.push_back (at (i, 0, side));
    for (int i = 0; i + 1 < side; ++i)
      loop.push_back (at (side - 1, i, side));
    for (int i = side - 1; i > 0; --i)
      loop.push_back (at (i, side - 1, side));
    for (int i = side - 1; i > 0; --i)
      loop.push_back (at (0, i, side));
  }

  /// Parameters of the loop: the positions of its points.
  std::vector<Eigen::Vector2d> loopInPlace () const
  {
    std::vector<Eigen::Vector2d> uv;
    for (const Index p : loop)
      uv.emplace_back (positions[p].head<2> ());
    return uv;
  }

  static Index at (int x, int y, int side) { return static_cast<Index> (y * side + x); }

private:
  void addStar (int x, int y, int side, bool open)
  {
    static constexpr std::array<std::array<int, 2>, 6> STEPS{
        {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}}};
    const auto exists = [&] (std::size_t step) {
      const int to_x = x + STEPS[step % 6][0], to_y = y + STEPS[step % 6][1];
      return to_x >= 0 && to_y >= 0 && to_x < side && to_y < side;
    };
    std::size_t first = 0; // the neighbour after the gap
    while (open && (exists (first + 5) || !exists (first)))
      ++first;
    const Index p = at (x, y, side);
    for (std::size_t step = first; step < first + 6; ++step) {
      if (!exists (step))
        continue;
      const Index q = at (x + STEPS[step % 6][0], y + STEPS[step % 6][1], side);
      stars.neighbors.ids.push_back (q);
      stars.offsets_in_plane.emplace_back ((positions[q] - positions[p]).head<2> ());
    }
    stars.neighbors.offsets.push_back (static_cast<Index> (stars.neighbors.ids.size ()));
    stars.open.push_back (open ? 1 : 0);
  }
};

} // namespace pcl::floater
