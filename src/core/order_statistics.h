// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Ranks in unsorted lists, sorting, selecting and erasing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace pcl::floater {
/// The value that has `rank` others before it. O(n).
/// \param[in,out] values more than `rank`; their order changes
template <typename Value>
Value
valueAtRank (std::vector<Value>& values, std::size_t rank)
{
  const auto place = values.begin () + static_cast<std::ptrdiff_t> (rank);
  std::nth_element (values.begin (), place, values.end ());
  return *place;
}

/// The values that have `low` and `high` others before them, low <= high. O(n); faster than two
/// calls of valueAtRank (), since the lower one is searched below the upper one.
/// \param[in,out] values more than `high`; their order changes
template <typename Value>
std::pair<Value, Value>
valuesAtRanks (std::vector<Value>& values, std::size_t low, std::size_t high)
{
  const auto at_low = values.begin () + static_cast<std::ptrdiff_t> (low);
  const auto at_high = values.begin () + static_cast<std::ptrdiff_t> (high);
  std::nth_element (values.begin (), at_high, values.end ());
  if (low < high)
    std::nth_element (values.begin (), at_low, at_high);
  return {*at_low, *at_high};
}

/// The median; for an even number of values, the upper one of the middle two. O(n).
/// \param[in,out] values at least one; their order changes
template <typename Value>
Value
median (std::vector<Value>& values)
{
  return valueAtRank (values, values.size () / 2);
}

/// The value that a share of the values does not exceed. O(n).
/// \param[in,out] values at least one; their order changes
/// \param share 0 for the smallest, 1 for the largest
template <typename Value>
Value
quantile (std::vector<Value>& values, double share)
{
  const auto rank = static_cast<std::size_t> (share * static_cast<double> (values.size ()));
  return valueAtRank (values, std::min (rank, values.size () - 1));
}

/// The values of some rows, in their order.
template <typename Value, typename Rows>
std::vector<Value>
valuesAt (const std::vector<Value>& values, const Rows& rows)
{
  std::vector<Value> some;
  some.reserve (rows.size ());
  for (const auto row : rows)
    some.push_back (values[row]);
  return some;
}

/// Erases the values of some rows. O(n).
/// \param rows ascending
template <typename Value, typename Rows>
void
eraseRows (std::vector<Value>& values, const Rows& rows)
{
  auto next = rows.begin ();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size (); ++i)
    if (next != rows.end () && *next == i)
      ++next;
    else
      values[kept++] = values[i];
  values.resize (kept);
}

/// Sorts ascending and removes repeated values. O(n log n).
template <typename Value>
void
sortUnique (std::vector<Value>& values)
{
  std::sort (values.begin (), values.end ());
  values.erase (std::unique (values.begin (), values.end ()), values.end ());
}

} // namespace pcl::floater
