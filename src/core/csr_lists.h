// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of indices, many in compressed sparse rows, and the limits of 32-bit indices.
#pragma once

#include "core/types.h"

#include <stdexcept>
#include <string>

namespace pcl::floater {
/// A table would exceed its index type. The message names the table and a remedy. The run ends with
/// RunStatus::OUT_OF_MEMORY.
class IndexLimitReached : public std::length_error
{
public:
  using std::length_error::length_error;
};

/// Largest number of matrix entries in libraries with indices of type int.
constexpr std::size_t MOST_MATRIX_ENTRIES = std::numeric_limits<int>::max ();

/// \param what remedy, for the message
/// \throws IndexLimitReached if there are more than `most` entries
inline void
requireCountable (std::size_t entries, std::size_t most, const char* table, const char* what)
{
  if (entries > most)
    throw IndexLimitReached (std::string (table) + " would have " + std::to_string (entries) +
                             " entries, more than the " + std::to_string (most) +
                             " that 32-bit indices can count: " + what);
}

/// Consecutive values of an array.
template <typename Value>
struct Span
{
  const Value* first;
  const Value* last;

  const Value* begin () const { return first; }
  const Value* end () const { return last; }
  std::size_t size () const { return static_cast<std::size_t> (last - first); }
  const Value& operator[] (std::size_t i) const { return first[i]; }
};

/// A row of a table.
using Row = Span<Index>;

/// A function that gives the row of a point. The row is valid until the next call.
using RowOf = std::function<Row (Index)>;

/// One list of indices for each row, all in one array: row r is ids[begin (r)] to
/// ids[begin (r + 1)], the end not included.
struct CsrLists
{
  std::vector<Index> offsets; ///< one more than there are rows; empty if there is no row
  std::vector<Index> ids;

  std::size_t rows () const { return offsets.empty () ? 0 : offsets.size () - 1; }

  Row row (std::size_t r) const { return {ids.data () + offsets[r], ids.data () + offsets[r + 1]}; }

  /// The first `count` entries of a row, or all of them if there are fewer.
  Row first (std::size_t r, std::size_t count) const
  {
    const Row whole = row (r);
    return {whole.first, whole.first + std::min (count, whole.size ())};
  }
};

/// \throws IndexLimitReached if lists have so many entries that their offsets cannot count them
inline void
requireListed (std::size_t entries)
{
  requireCountable (entries, NONE - 1, "a table of points, neighbours or triangles",
                    "use fewer points or fewer neighbours");
}

/// Turns row lengths into offsets: offsets[r + 1] is the length of row r before the call, and its
/// end after it. O(rows).
inline void
sumRowLengths (std::vector<Index>& offsets)
{
  std::partial_sum (offsets.begin (), offsets.end (), offsets.begin ());
}

/// Makes lists by counting sort, O(rows + entries). `visit` is called twice. Both times it has to
/// call its argument `emit (row, id)` for each entry, in the same order; each row keeps that order.
/// \throws IndexLimitReached if there are 2^32 - 1 entries or more
template <typename Visit>
CsrLists
makeCsrLists (std::size_t rows, Visit&& visit)
{
  CsrLists lists;
  lists.offsets.assign (rows + 2, 0);
  std::size_t entries = 0;
  visit ([&] (std::size_t row, Index) {
    ++lists.offsets[row + 2];
    ++entries;
  });
  requireListed (entries);
  sumRowLengths (lists.offsets);
  lists.ids.resize (entries);
  // offsets[row + 1]: where the row's next entry goes; at the end, where the row ends.
  visit ([&] (std::size_t row, Index id) { lists.ids[lists.offsets[row + 1]++] = id; });
  lists.offsets.pop_back ();
  return lists;
}

/// The indices below `count` for which a test is true, ascending.
template <typename Test>
std::vector<Index>
indicesWhere (std::size_t count, Test&& test)
{
  std::vector<Index> indices;
  for (Index i = 0; i < count; ++i)
    if (test (i))
      indices.push_back (i);
  return indices;
}

/// The place of a value in an ascending list; NONE if it is not there. O(log n).
inline Index
placeIn (const std::vector<Index>& ascending, Index value)
{
  const auto at = std::lower_bound (ascending.begin (), ascending.end (), value);
  return at != ascending.end () && *at == value ? static_cast<Index> (at - ascending.begin ())
                                                : NONE;
}

/// The rows of some ids, with these ids only, by their places among them.
/// \param ids ascending
inline CsrLists
rowsWithin (const CsrLists& lists, const std::vector<Index>& ids)
{
  return makeCsrLists (ids.size (), [&] (const auto& emit) {
    for (std::size_t i = 0; i < ids.size (); ++i)
      for (const Index id : lists.row (ids[i]))
        if (const Index place = placeIn (ids, id); place != NONE)
          emit (i, place);
  });
}

} // namespace pcl::floater
