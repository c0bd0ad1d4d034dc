// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/nested_dissection.h"

#include "floater/grid_system.h"
#include "floater/solvers/solver.h"
#include "floater/solvers/umfpack_solver.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl::floater {
namespace {
// Random rows: distant points are joined as well as close ones.
LinearSystem
randomPattern (std::size_t unknowns, RandomStream& random)
{
  LinearSystem system;
  system.row_offsets.push_back (0);
  for (std::size_t i = 0; i < unknowns; ++i) {
    std::vector<int> row{static_cast<int> (i)};
    for (int entry = 0; entry < 4; ++entry)
      row.push_back (static_cast<int> (random.below (unknowns)));
    std::sort (row.begin (), row.end ());
    row.erase (std::unique (row.begin (), row.end ()), row.end ());
    system.columns.insert (system.columns.end (), row.begin (), row.end ());
    system.row_offsets.push_back (static_cast<int> (system.columns.size ()));
    system.point_of_unknown.push_back (static_cast<Index> (unknowns - 1 - i));
  }
  system.values.assign (system.columns.size (), 1.0);
  return system;
}

void
expectPermutation (std::vector<int> order, std::size_t count)
{
  ASSERT_EQ (order.size (), count);
  std::sort (order.begin (), order.end ());
  for (std::size_t i = 0; i < count; ++i)
    ASSERT_EQ (order[i], static_cast<int> (i));
}

double
largestDifference (const Solution& a, const Solution& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.uv.size (); ++i)
    largest = std::max (largest, (a.uv[i] - b.uv[i]).cwiseAbs ().maxCoeff ());
  return largest;
}

TEST (NestedDissection, FactorsAreAsSmallAsWithMetis)
{
  const TriangulatedGrid grid (120, 0.1, 7101);
  const LinearSystem system = gridSystem (grid);
  const std::vector<int> order = dissectUnknowns (system, grid.positions, 1);
  expectPermutation (order, system.unknowns ());
  const Solution dissected = solveWithUmfpack (system, order, 1);
  const Solution metis = solveWithUmfpack (system, Ordering::METIS, 1);
  ASSERT_EQ (dissected.outcome, Solution::Outcome::OK);
  const auto fill = static_cast<double> (dissected.nnz_factors);
  EXPECT_LT (fill, 1.1 * static_cast<double> (metis.nnz_factors));
  EXPECT_LT (fill, 0.5 * static_cast<double> (
                             solveWithUmfpack (system, Ordering::NATURAL, 1).nnz_factors));
  EXPECT_LT (dissected.residual, 1e-14);
  EXPECT_LT (largestDifference (dissected, metis), 1e-13);
}

// Expects that each set consists of its halves and its cut, and that no pair of the pattern joins
// two halves, even if the pair is longer than any band is wide.
void
expectSeparated (const CsrLists& pattern, const Dissection& dissection)
{
  std::vector<Index> place (pattern.rows ());
  for (std::size_t i = 0; i < place.size (); ++i)
    place[static_cast<std::size_t> (dissection.order[i])] = static_cast<Index> (i);
  ASSERT_EQ (dissection.sets[0].begin, 0U);
  ASSERT_EQ (dissection.sets[0].end, pattern.rows ());
  for (const DissectedSet& set : dissection.sets) {
    Index next = set.begin;
    for (const Index half : set.halves)
      if (half != NONE) {
        ASSERT_EQ (dissection.sets[half].begin, next);
        next = dissection.sets[half].end;
      }
    ASSERT_EQ (set.cut, next);
    ASSERT_LE (set.cut, set.end);
    if (set.halves[0] == NONE || set.halves[1] == NONE)
      continue;
    const DissectedSet& second = dissection.sets[set.halves[1]];
    for (Index i = set.begin; i < second.begin; ++i)
      for (const Index neighbor : pattern.row (static_cast<std::size_t> (dissection.order[i])))
        ASSERT_FALSE (place[neighbor] >= second.begin && place[neighbor] < second.end);
  }
}

TEST (NestedDissection, HalvesAreNotJoined)
{
  const TriangulatedGrid grid (60, 0.1, 7102);
  const LinearSystem system = gridSystem (grid);
  const CsrLists pattern = symmetricPattern (system);
  const Dissection dissection = dissect (pattern, system.point_of_unknown, grid.positions, 1);
  expectSeparated (pattern, dissection);
  const DissectedSet& whole = dissection.sets[0];
  EXPECT_LE (whole.end - whole.cut, 58U); // there are 58 x 58 unknowns
  for (const Index half : whole.halves)
    EXPECT_LT (dissection.sets[half].end - dissection.sets[half].begin, 6 * whole.end / 10);
}

TEST (NestedDissection, DoesNotDependOnTheThreads)
{
  const TriangulatedGrid grid (150, 0.1, 7103);
  const LinearSystem system = gridSystem (grid);
  const std::vector<int> order = dissectUnknowns (system, grid.positions, 1);
  EXPECT_EQ (order, dissectUnknowns (system, grid.positions, 2));
  EXPECT_EQ (order, dissectUnknowns (system, grid.positions, 7));
}

TEST (NestedDissection, OfAnyPatternAndAnyPlaces)
{
  RandomStream random (7104);
  for (const std::size_t unknowns : {0U, 1U, 2U, 8U, 9U, 50U, 700U}) {
    const LinearSystem system = randomPattern (unknowns, random);
    const CsrLists pattern = symmetricPattern (system);
    std::vector<Eigen::Vector3d> positions (unknowns);
    const auto expectDissected = [&] {
      const Dissection dissection = dissect (pattern, system.point_of_unknown, positions, 2);
      expectPermutation (dissection.order, unknowns);
      expectSeparated (pattern, dissection);
    };
    for (Eigen::Vector3d& position : positions)
      position = {random.uniform (), random.uniform (), random.uniform ()};
    expectDissected ();
    for (Eigen::Vector3d& position : positions)
      position.tail<2> ().setZero (); // on a line
    expectDissected ();
    for (Eigen::Vector3d& position : positions)
      position.setOnes (); // in one place
    expectDissected ();
  }
}

TEST (NestedDissection, IsTheAutomaticOrderOfLargeSystems)
{
  const TriangulatedGrid grid (320, 0.1, 7105);
  const LinearSystem system = gridSystem (grid);
  const SolverOptions options;
  const Solution dissected = solve (system, options, &grid.positions, 1);
  const Solution amd = solve (system, options, nullptr, 1);
  ASSERT_EQ (dissected.outcome, Solution::Outcome::OK);
  EXPECT_LT (dissected.nnz_factors, amd.nnz_factors);
  EXPECT_LT (dissected.residual, 1e-14);
  EXPECT_LT (largestDifference (dissected, amd), 1e-12);
  for (std::size_t i = 0; i < system.unknowns (); ++i)
    ASSERT_LT ((dissected.uv[i] - grid.positions[system.point_of_unknown[i]].head<2> ()).norm (),
               1e-11);
}

} // namespace
} // namespace pcl::floater
