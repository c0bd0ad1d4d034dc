// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours of all points, in memory or fetched on demand.
#pragma once

#include "core/csr_lists.h"

#include <functional>
#include <utility>
#include <vector>

namespace pcl::floater {
/// The neighbours of each point of a cloud, nearest first.
class NeighborTable
{
public:
  using Some = std::function<CsrLists (const std::vector<Index>& points)>;
  using All = std::function<const CsrLists&()>;

  /// Uses lists in memory, which must outlive this.
  NeighborTable (const CsrLists& lists) // implicit
      : some_ ([&lists] (const std::vector<Index>& points) {
          CsrLists rows;
          rows.offsets.push_back (0);
          for (const Index p : points) {
            const Row row = lists.row (p);
            rows.ids.insert (rows.ids.end (), row.begin (), row.end ());
            rows.offsets.push_back (static_cast<Index> (rows.ids.size ()));
          }
          return rows;
        }),
        all_ ([&lists] () -> const CsrLists& { return lists; })
  {
  }

  /// Fetches lists on demand.
  /// \param all fetches and keeps all lists
  NeighborTable (Some some, All all) : some_ (std::move (some)), all_ (std::move (all)) {}

  /// Row i belongs to points[i].
  /// \param points ascending
  CsrLists some (const std::vector<Index>& points) const { return some_ (points); }

  const CsrLists& all () const { return all_ (); }

private:
  Some some_;
  All all_;
};

} // namespace pcl::floater
