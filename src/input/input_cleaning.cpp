// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/input_cleaning.h"

#include "report/report_cloud.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// Removes the points whose rows are flagged. Returns their cloud indices, ascending.
std::vector<Index>
takeOut (Input& input, const std::vector<std::uint8_t>& is_taken)
{
  std::vector<Index> taken;
  std::size_t kept = 0;
  for (std::size_t row = 0; row < is_taken.size (); ++row) {
    if (is_taken[row] != 0) {
      taken.push_back (input.cloud_index[row]);
      continue;
    }
    input.positions[kept] = input.positions[row];
    input.cloud_index[kept] = input.cloud_index[row];
    ++kept;
  }
  input.positions.resize (kept);
  input.cloud_index.resize (kept);
  std::sort (taken.begin (), taken.end ());
  return taken;
}

} // namespace

Problem
cleanInput (Input& input, const Options& options, const GrossOutlierLimits& limits,
            const RunContext& run, Report& report)
{
  constexpr std::size_t LARGEST_SHARE = 4; // a quarter of the points are not outliers
  const GrossOutliers found = findGrossOutliers (input.positions, run, limits);
  if (found.isolated.empty () && found.unbearable.empty ())
    return {};
  std::vector<Index> given = options.disc.boundary.loop;
  std::sort (given.begin (), given.end ());
  const auto mayGo = [&] (Index row) {
    return options.remove_outliers &&
           !std::binary_search (given.begin (), given.end (), input.cloud_index[row]);
  };
  const bool are_few = LARGEST_SHARE * found.unbearable.size () <= input.positions.size ();
  std::vector<std::uint8_t> is_taken (input.positions.size (), 0);
  for (const Index row : found.unbearable) {
    if (!are_few || !mayGo (row))
      return tooFarAway (input.cloud_index[row], input.positions[row]);
    is_taken[row] = 1;
  }
  for (const Index row : found.isolated)
    is_taken[row] = mayGo (row) ? 1 : 0;
  reportGrossOutliers (takeOut (input, is_taken), report);
  return {};
}

} // namespace pcl::floater
