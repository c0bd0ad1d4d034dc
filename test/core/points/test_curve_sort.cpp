// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/hilbert_curve.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace pcl::floater {
namespace {
using samples::indices;
using samples::Positions;

constexpr std::size_t MANY = 70'000; // more than one part

// Codes of the cell of a position and of its place in the cell, as they are documented.
std::pair<std::uint64_t, std::uint64_t>
codesOf (const Eigen::Vector3d& position)
{
  std::array<std::uint32_t, 3> cell{}, in_cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double place =
        ((1U << HILBERT_BITS) - 1.0) * (position[static_cast<Eigen::Index> (axis)] + 0.5);
    cell[axis] = static_cast<std::uint32_t> (place);
    in_cell[axis] = static_cast<std::uint32_t> ((place - cell[axis]) * (1U << HILBERT_BITS));
  }
  return {hilbertCode (cell), hilbertCode (in_cell)};
}

// All at once, by one sort.
CurveOrder
sortedAtOnce (const Positions& positions, const std::vector<Index>& cloud_index)
{
  using Key = std::tuple<std::pair<std::uint64_t, std::uint64_t>, std::array<double, 3>, Index>;
  std::vector<std::pair<Key, Eigen::Vector3d>> all;
  for (std::size_t row = 0; row < positions.size (); ++row) {
    const Eigen::Vector3d& p = positions[row];
    if (p.allFinite ())
      all.push_back ({{codesOf (p), {p.x (), p.y (), p.z ()}, cloud_index[row]}, p});
  }
  std::sort (all.begin (), all.end (),
             [] (const auto& a, const auto& b) { return a.first < b.first; });
  CurveOrder order;
  for (const auto& [key, position] : all) {
    order.positions.push_back (position);
    order.cloud_index.push_back (std::get<2> (key));
  }
  return order;
}

void
expectSorted (const Positions& positions, const std::vector<Index>& cloud_index)
{
  const CurveOrder expected = sortedAtOnce (positions, cloud_index);
  for (const int threads : {1, 3}) {
    const CurveOrder order =
        sortAlongCurve (positions, cloud_index, Eigen::Vector3d::Zero (), 1.0, threads);
    EXPECT_EQ (order.positions, expected.positions);
    EXPECT_EQ (order.cloud_index, expected.cloud_index);
  }
}

// From -1/2 to 1/2.
Positions
randomInBox (std::size_t count, unsigned seed)
{
  Positions positions = samples::randomPoints (count, seed);
  for (Eigen::Vector3d& p : positions)
    p = (p.array () - 0.5).cwiseMax (-0.5).cwiseMin (0.5);
  return positions;
}

TEST (CurveSort, InPartsAsAtOnce)
{
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{500}, MANY})
    expectSorted (randomInBox (count, 1), samples::permutation (count, 2));
}

TEST (CurveSort, RowsOfAGrid)
{
  Positions grid;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      grid.emplace_back (x / 256.0 - 0.5, y / 256.0 - 0.5, 0.0);
  expectSorted (grid, indices (grid.size ()));
}

TEST (CurveSort, SmallObjectInOneCell)
{
  Positions positions = randomInBox (MANY, 3);
  for (Eigen::Vector3d& p : positions)
    p *= 1e-8;
  positions.emplace_back (0.4, 0.4, 0.4);
  expectSorted (positions, indices (positions.size ()));
}

TEST (CurveSort, EqualPositionsAreInOrderOfTheCloud)
{
  Positions positions (MANY, Eigen::Vector3d (0.25, -0.125, 0.0));
  expectSorted (positions, samples::permutation (MANY, 4));
  for (std::size_t row = 0; row < MANY; row += 3)
    positions[row] = Eigen::Vector3d (0.01 * static_cast<double> (row % 7), 0.0, -0.0);
  expectSorted (positions, samples::permutation (MANY, 5));
}

TEST (CurveSort, LeavesOutWhatIsNotFinite)
{
  Positions positions = randomInBox (MANY, 6);
  for (std::size_t row = 0; row < MANY; row += 2)
    positions[row][static_cast<Eigen::Index> (row % 3)] =
        row % 4 == 0 ? std::numeric_limits<double>::quiet_NaN ()
                     : std::numeric_limits<double>::infinity ();
  expectSorted (positions, indices (MANY));
  for (Eigen::Vector3d& p : positions)
    p.z () = -std::numeric_limits<double>::infinity ();
  expectSorted (positions, indices (MANY));
}

TEST (CurveSort, ScalesWhatItSorts)
{
  const Positions unit = randomInBox (1000, 7);
  Positions moved;
  for (const Eigen::Vector3d& p : unit)
    moved.push_back (Eigen::Vector3d (8.0, 16.0, -4.0) + 4.0 * p);
  const CurveOrder order =
      sortAlongCurve (moved, indices (moved.size ()), {8.0, 16.0, -4.0}, 4.0, 1);
  const CurveOrder expected = sortedAtOnce (order.positions, order.cloud_index);
  EXPECT_EQ (order.positions, expected.positions);
  for (std::size_t i = 0; i < order.positions.size (); ++i)
    EXPECT_LT ((order.positions[i] - unit[order.cloud_index[i]]).norm (), 1e-14);
}

} // namespace
} // namespace pcl::floater
