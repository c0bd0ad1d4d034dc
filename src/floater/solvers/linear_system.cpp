// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/linear_system.h"

#include "core/parallel.h"

namespace pcl::floater {
namespace {
// Per point: its place in the loop, NONE if it is not on it.
std::vector<Index>
placesInLoop (const std::vector<Index>& loop, std::size_t points)
{
  std::vector<Index> places (points, NONE);
  for (std::size_t i = 0; i < loop.size (); ++i)
    places[loop[i]] = static_cast<Index> (i);
  return places;
}

void
numberUnknowns (const std::vector<Index>& place_in_loop, const std::vector<std::uint8_t>& reachable,
                LinearSystem& system)
{
  const std::size_t points = place_in_loop.size ();
  system.unknown_of_point.assign (points, NONE);
  system.point_of_unknown.reserve (points);
  for (std::size_t p = 0; p < points; ++p)
    if (place_in_loop[p] == NONE && reachable[p] != 0) {
      system.unknown_of_point[p] = static_cast<Index> (system.point_of_unknown.size ());
      system.point_of_unknown.push_back (static_cast<Index> (p));
    }
}

// Counts the entries of each row.
void
placeRows (const CsrLists& neighbors, std::size_t most_entries, const RunContext& run,
           LinearSystem& system)
{
  const std::size_t unknowns = system.unknowns ();
  system.row_offsets.assign (unknowns + 1, 0);
  parallelRanges (run, unknowns, [&] (std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      int length = 1; // the diagonal
      for (const Index q : neighbors.row (system.point_of_unknown[i]))
        length += system.unknown_of_point[q] != NONE ? 1 : 0;
      system.row_offsets[i + 1] = length;
    }
  });
  std::size_t entries = 0;
  for (std::size_t i = 0; i < unknowns; ++i)
    entries += static_cast<std::size_t> (system.row_offsets[i + 1]);
  requireCountable (entries, most_entries, "the linear system",
                    "use fewer points or fewer neighbours, or make a surface instead of a disc");
  for (std::size_t i = 0; i < unknowns; ++i)
    system.row_offsets[i + 1] += system.row_offsets[i];
}

// Inserts an entry into the sorted entries [first, last) of a row. Rows are short.
void
insertEntry (LinearSystem& system, std::size_t first, std::size_t last, int column, double value)
{
  std::size_t at = last;
  for (; at > first && system.columns[at - 1] > column; --at) {
    system.columns[at] = system.columns[at - 1];
    system.values[at] = system.values[at - 1];
  }
  system.columns[at] = column;
  system.values[at] = value;
}

} // namespace

LinearSystem
assembleSystem (const CsrLists& neighbors, const std::vector<double>& weights,
                const std::vector<Index>& loop, const std::vector<Eigen::Vector2d>& loop_uv,
                const std::vector<std::uint8_t>& reachable, const RunContext& run,
                std::size_t most_entries)
{
  LinearSystem system;
  const std::vector<Index> place_in_loop = placesInLoop (loop, neighbors.rows ());
  numberUnknowns (place_in_loop, reachable, system);
  placeRows (neighbors, most_entries, run, system);
  const std::size_t unknowns = system.unknowns ();
  system.columns.resize (static_cast<std::size_t> (system.row_offsets.back ()));
  system.values.resize (system.columns.size ());
  system.rhs_u.resize (unknowns);
  system.rhs_v.resize (unknowns);

  parallelRanges (run, unknowns, [&] (std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index p = system.point_of_unknown[i];
      const auto first = static_cast<std::size_t> (system.row_offsets[i]);
      std::size_t last = first;
      double diagonal = 0.0;
      Eigen::Vector2d rhs = Eigen::Vector2d::Zero ();
      for (std::size_t entry = neighbors.offsets[p]; entry < neighbors.offsets[p + 1]; ++entry) {
        const Index q = neighbors.ids[entry];
        if (system.unknown_of_point[q] != NONE)
          insertEntry (system, first, last++, static_cast<int> (system.unknown_of_point[q]),
                       -weights[entry]);
        else if (place_in_loop[q] != NONE)
          rhs += weights[entry] * loop_uv[place_in_loop[q]];
        else
          continue;
        diagonal += weights[entry];
      }
      insertEntry (system, first, last, static_cast<int> (i), diagonal);
      system.rhs_u[i] = rhs.x ();
      system.rhs_v[i] = rhs.y ();
    }
  });
  return system;
}

} // namespace pcl::floater
