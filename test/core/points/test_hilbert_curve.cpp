// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The space-filling curve against the algorithm that it is made from; sorting along it against one sort.
#include "points/hilbert_curve.h"

#include "points/point_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

namespace pcl::floater {
namespace {
using samples::Positions;
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

constexpr std::size_t MANY = 70'000; // more than one part

// All at once, by one sort: by the codes of the cell of a position and of its place in the cell, as they
// are documented.
CurveOrder
sortedAtOnce (const Positions& positions, const std::vector<Index>& cloud_index)
{
  using Key = std::tuple<std::uint64_t, std::uint64_t, std::array<double, 3>, Index>;
  std::vector<std::pair<Key, Eigen::Vector3d>> all;
  for (std::size_t row = 0; row < positions.size (); ++row) {
    const Eigen::Vector3d& p = positions[row];
    if (!p.allFinite ())
      continue;
    Cell cell{}, in_cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place =
          ((1U << HILBERT_BITS) - 1.0) * (p[static_cast<Eigen::Index> (axis)] + 0.5);
      cell[axis] = static_cast<std::uint32_t> (place);
      in_cell[axis] = static_cast<std::uint32_t> ((place - cell[axis]) * (1U << HILBERT_BITS));
    }
    all.push_back (
        {{hilbertCode (cell), hilbertCode (in_cell), {p.x (), p.y (), p.z ()}, cloud_index[row]},
         p});
  }
  std::sort (all.begin (), all.end (),
             [] (const auto& a, const auto& b) { return a.first < b.first; });
  CurveOrder order;
  for (const auto& [key, position] : all) {
    order.positions.push_back (position);
    order.cloud_index.push_back (std::get<Index> (key));
  }
  return order;
}

// From -1/2 to 1/2.
Positions
randomInBox (std::size_t count, unsigned seed)
{
  return samples::placed (samples::randomPoints (count, seed), Eigen::Vector3d::Constant (-0.5));
}

TEST (CurveSort, InPartsAsAtOnce)
{
  Positions grid, equal (MANY, Eigen::Vector3d (0.25, -0.125, 0.0));
  for (int i = 0; i < 65536; ++i)
    grid.emplace_back (i % 256 / 256.0 - 0.5, i / 256 / 256.0 - 0.5, 0.0); // NOLINT
  Positions in_one_cell = samples::placed (randomInBox (MANY, 3), {0, 0, 0}, 1e-8);
  in_one_cell.emplace_back (0.4, 0.4, 0.4);
  Positions mostly_equal = equal, not_finite = randomInBox (MANY, 6);
  for (std::size_t row = 0; row < MANY; row += 3)
    mostly_equal[row] = Eigen::Vector3d (0.01 * static_cast<double> (row % 7), 0.0, -0.0);
  for (std::size_t row = 0; row < MANY; row += 2)
    not_finite[row][static_cast<Eigen::Index> (row % 3)] = row % 4 == 0 ? NAN : INFINITY;
  const std::vector<Positions> clouds{{},
                                      randomInBox (1, 1),
                                      randomInBox (500, 1),
                                      randomInBox (MANY, 1),
                                      grid,
                                      in_one_cell,
                                      equal,
                                      mostly_equal,
                                      not_finite,
                                      Positions (MANY, Eigen::Vector3d (0.0, 0.0, -INFINITY))};
  for (std::size_t cloud = 0; cloud < clouds.size (); ++cloud) {
    SCOPED_TRACE (cloud);
    const std::vector<Index> cloud_index = samples::permutation (clouds[cloud].size (), 2);
    const CurveOrder expected = sortedAtOnce (clouds[cloud], cloud_index);
    for (const int threads : {1, 3}) {
      const CurveOrder order =
          sortAlongCurve (clouds[cloud], cloud_index, Eigen::Vector3d::Zero (), 1.0, threads);
      EXPECT_EQ (order.positions, expected.positions);
      EXPECT_EQ (order.cloud_index, expected.cloud_index);
    }
  }
}

TEST (CurveSort, ScalesWhatItSorts)
{
  const Positions unit = randomInBox (1000, 7);
  const Eigen::Vector3d centre (8.0, 16.0, -4.0);
  const CurveOrder order =
      sortAlongCurve (samples::placed (unit, centre, 4.0), samples::indices (1000), centre, 4.0, 1);
  const CurveOrder expected = sortedAtOnce (order.positions, order.cloud_index);
  EXPECT_EQ (order.positions, expected.positions);
  for (std::size_t i = 0; i < order.positions.size (); ++i)
    EXPECT_LT ((order.positions[i] - unit[order.cloud_index[i]]).norm (), 1e-14);
}

} // namespace
} // namespace pcl::floater
