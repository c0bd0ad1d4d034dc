// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/linear_system.h"

#include <algorithm>

namespace pcl::floater {
void
LinearSystem::addRow (std::vector<std::pair<int, double>>& row)
{
  std::sort (row.begin (), row.end ());
  for (const auto& [column, value] : row) {
    columns.push_back (column);
    values.push_back (value);
  }
  row_offsets.push_back (static_cast<int> (columns.size ()));
}

LinearSystem
assembleSystem (const CsrLists& neighbors, const std::vector<double>& weights,
                const std::vector<Index>& loop, const std::vector<Eigen::Vector2d>& loop_uv,
                const std::vector<std::uint8_t>& reachable, std::size_t most_entries)
{
  LinearSystem system;
  std::vector<Index> place_in_loop (neighbors.rows (), NONE);
  for (std::size_t i = 0; i < loop.size (); ++i)
    place_in_loop[loop[i]] = static_cast<Index> (i);
  system.unknown_of_point.assign (neighbors.rows (), NONE);
  for (std::size_t p = 0; p < neighbors.rows (); ++p)
    if (place_in_loop[p] == NONE && reachable[p] != 0) {
      system.unknown_of_point[p] = static_cast<Index> (system.point_of_unknown.size ());
      system.point_of_unknown.push_back (static_cast<Index> (p));
    }
  const std::size_t unknowns = system.point_of_unknown.size ();
  system.row_offsets.reserve (unknowns + 1);
  system.columns.reserve (unknowns + neighbors.ids.size ());
  system.values.reserve (unknowns + neighbors.ids.size ());
  system.rhs.setZero (static_cast<Eigen::Index> (unknowns), 2);
  std::vector<std::pair<int, double>> row;
  for (std::size_t i = 0; i < unknowns; ++i) {
    row.assign (1, {static_cast<int> (i), 0.0});
    const Index p = system.point_of_unknown[i];
    for (std::size_t entry = neighbors.offsets[p]; entry < neighbors.offsets[p + 1]; ++entry) {
      const Index q = neighbors.ids[entry];
      const double weight = weights[entry];
      if (system.unknown_of_point[q] != NONE)
        row.emplace_back (static_cast<int> (system.unknown_of_point[q]), -weight);
      else if (place_in_loop[q] != NONE)
        system.rhs.row (static_cast<Eigen::Index> (i)) +=
            weight * loop_uv[place_in_loop[q]].transpose ();
      else
        continue;
      row.front ().second += weight;
    }
    requireCountable (system.nonzeros () + row.size (), most_entries, "the linear system",
                      "use fewer points or fewer neighbours, or make a surface instead of a disc");
    system.addRow (row);
  }
  return system;
}

} // namespace pcl::floater
