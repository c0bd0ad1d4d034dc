// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are hard on a reconstruction: no result is wrong.
#include "attack.h"

#include <gtest/gtest.h>

#include <ctime>
#include <random>

namespace pcl::floater {
namespace {
using RandomClouds = testing::TestWithParam<std::size_t>;

TEST_P (RandomClouds, GiveNoWrongResult)
{
  // Clouds of each size; the longest time of one, which no test has that may run on a busy machine.
  const std::uint64_t clouds = fuzz::wantedBy ("PCL_FLOATER_RANDOM_CLOUDS", 60);
  const std::uint64_t first = fuzz::wantedBy ("PCL_FLOATER_FIRST_SEED", 1);
  const auto longest =
      static_cast<double> (fuzz::wantedBy ("PCL_FLOATER_LONGEST", 1000)); // seconds
  std::size_t meshes = 0;
  for (std::uint64_t seed = first; seed < first + clouds; ++seed) {
    std::mt19937_64 engine (seed);
    std::array<std::uint8_t, 4096> bytes{}; // more than a recipe takes, but for raw points
    for (std::uint8_t& byte : bytes)
      byte = static_cast<std::uint8_t> (engine ());
    fuzz::ByteSource source (bytes.data (), bytes.size ());
    const fuzz::Attack attack = fuzz::decodeAttack (source, GetParam ());
    const std::clock_t begin = std::clock ();
    const Result result = reconstruct (attack.input, attack.options);
    EXPECT_LT (static_cast<double> (std::clock () - begin) / CLOCKS_PER_SEC, longest) << seed;
    EXPECT_EQ (fuzz::findFault (attack.input, result), "") << "seed " << seed;
    meshes += result.report.status == RunStatus::SUCCESS ? 1 : 0;
  }
  EXPECT_GE (4 * meshes, clouds) << "the clouds are too hopeless to test much";
}

INSTANTIATE_TEST_SUITE_P (Points, RandomClouds, testing::Values (12, 60, 300),
                          testing::PrintToStringParamName ());
INSTANTIATE_TEST_SUITE_P (DISABLED_ManyPoints, RandomClouds,
                          testing::Values (3000), // see attack.sh
                          testing::PrintToStringParamName ());

} // namespace
} // namespace pcl::floater
