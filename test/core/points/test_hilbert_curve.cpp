// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The space-filling curve against the algorithm that it is made from, and what makes it one.
#include "points/hilbert_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace pcl::floater {
namespace {
using Cell = std::array<std::uint32_t, 3>;

/// Bit by bit, as Skilling (2004) gives it.
std::uint64_t
codeBitByBit (Cell x)
{
  constexpr std::uint32_t HIGHEST = 1U << (HILBERT_BITS - 1);
  for (std::uint32_t bit = HIGHEST; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& axis : x) {
      if ((axis & bit) != 0) {
        x[0] ^= below;
      }
      else {
        const std::uint32_t swapped = (x[0] ^ axis) & below;
        x[0] ^= swapped;
        axis ^= swapped;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t parity = 0;
  for (std::uint32_t bit = HIGHEST; bit > 1; bit >>= 1)
    if ((x[2] & bit) != 0)
      parity ^= bit - 1;
  std::uint64_t code = 0;
  for (int b = HILBERT_BITS - 1; b >= 0; --b)
    for (const std::uint32_t axis : x)
      code = (code << 1) | (((axis ^ parity) >> b) & 1U);
  return code;
}

TEST (HilbertCurve, IsThatOfTheAlgorithm)
{
  std::mt19937 random (1);
  constexpr std::uint32_t MASK = (1U << HILBERT_BITS) - 1;
  for (int i = 0; i < 200'000; ++i) {
    const Cell cell{static_cast<std::uint32_t> (random ()) & MASK,
                    static_cast<std::uint32_t> (random ()) & MASK,
                    static_cast<std::uint32_t> (random ()) & MASK};
    ASSERT_EQ (hilbertCode (cell), codeBitByBit (cell))
        << cell[0] << ' ' << cell[1] << ' ' << cell[2];
  }
  for (const std::uint32_t x : {0U, 1U, MASK - 1, MASK})
    for (const std::uint32_t y : {0U, MASK})
      for (const std::uint32_t z : {0U, 1U, MASK})
        EXPECT_EQ (hilbertCode ({x, y, z}), codeBitByBit ({x, y, z}));
}

/// Cells that follow each other on the curve share a face.
TEST (HilbertCurve, GoesFromCellToCell)
{
  constexpr std::uint32_t SIDE = 16;
  std::vector<std::pair<std::uint64_t, Cell>> cells;
  for (std::uint32_t x = 0; x < SIDE; ++x)
    for (std::uint32_t y = 0; y < SIDE; ++y)
      for (std::uint32_t z = 0; z < SIDE; ++z)
        cells.emplace_back (hilbertCode ({x, y, z}), Cell{x, y, z});
  std::sort (cells.begin (), cells.end ());
  for (std::size_t i = 0; i + 1 < cells.size (); ++i) {
    std::uint32_t steps = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t a = cells[i].second[axis], b = cells[i + 1].second[axis];
      steps += std::max (a, b) - std::min (a, b);
    }
    ASSERT_EQ (steps, 1U) << i;
    ASSERT_EQ (cells[i + 1].first, cells[i].first + 1);
  }
}

} // namespace
} // namespace pcl::floater
