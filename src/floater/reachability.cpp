// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/reachability.h"

#include "core/order_statistics.h"
#include "core/run_context.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// The reversed lists: row q holds the points p, ascending, whose row holds q. Only entries for
// which use (p, q) is true.
template <typename Use>
CsrLists
reverse (const CsrLists& lists, Use&& use)
{
  return makeCsrLists (lists.rows (), [&] (const auto& emit) {
    for (std::size_t p = 0; p < lists.rows (); ++p)
      for (const Index q : lists.row (p))
        if (use (p, q))
          emit (q, static_cast<Index> (p));
  });
}

// Marks and appends all points that lead to the entries of the queue from `head` on.
void
search (const CsrLists& leading_to, std::vector<Index>& queue, std::size_t head,
        std::vector<std::uint8_t>& reachable, const RunContext& run)
{
  ProgressLoop progress (run);
  for (; head < queue.size (); ++head) {
    progress.next ();
    for (const Index p : leading_to.row (queue[head]))
      if (reachable[p] == 0) {
        reachable[p] = 1;
        queue.push_back (p);
      }
  }
}

// Links point p to the nearest reached points. Ties go to the smaller point.
void
linkPoint (Index p, const CsrLists& nearest, const CsrLists& nearest_of,
           const std::vector<Eigen::Vector3d>& positions,
           const std::vector<std::uint8_t>& reachable, std::size_t most,
           std::vector<std::array<Index, 2>>& links)
{
  std::vector<std::pair<double, Index>> candidates;
  for (const Row row : {nearest.row (p), nearest_of.row (p)})
    for (const Index q : row)
      if (reachable[q] != 0)
        candidates.emplace_back ((positions[q] - positions[p]).squaredNorm (), q);
  sortUnique (candidates);
  candidates.resize (std::min (candidates.size (), most));
  for (const auto& candidate : candidates)
    links.push_back ({p, candidate.second});
}

} // namespace

Reachability
reachLoop (const CsrLists& neighbors, const CsrLists& nearest,
           const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
           const RunContext& run, const DiscLimits& limits)
{
  Reachability result;
  std::vector<std::uint8_t>& reachable = result.reachable;
  reachable.assign (positions.size (), 0);
  std::vector<Index> queue;
  queue.reserve (positions.size ());
  for (const Index p : loop)
    if (reachable[p] == 0) {
      reachable[p] = 1;
      queue.push_back (p);
    }
  const CsrLists leading_to =
      reverse (neighbors, [&] (std::size_t p, Index) { return reachable[p] == 0; });
  search (leading_to, queue, 0, reachable, run);
  if (queue.size () == positions.size ())
    return result;

  // Most entries are between two reached points, and are not needed.
  const CsrLists nearest_of = reverse (
      nearest, [&] (std::size_t p, Index q) { return reachable[p] == 0 || reachable[q] == 0; });
  std::vector<std::uint8_t> waiting (positions.size (), 0); // listed for linking
  std::vector<Index> round;
  for (std::size_t head = 0; head < queue.size ();) {
    // Unreached points next to a point that was reached since the last round.
    round.clear ();
    for (; head < queue.size (); ++head)
      for (const Row row : {nearest.row (queue[head]), nearest_of.row (queue[head])})
        for (const Index p : row)
          if (reachable[p] == 0 && waiting[p] == 0) {
            waiting[p] = 1;
            round.push_back (p);
          }
    for (const Index p : round)
      linkPoint (p, nearest, nearest_of, positions, reachable, limits.links_per_point,
                 result.links);
    for (const Index p : round)
      reachable[p] = 1;
    queue.insert (queue.end (), round.begin (), round.end ());
    result.linked_points += round.size ();
    search (leading_to, queue, head, reachable, run);
  }
  std::sort (result.links.begin (), result.links.end ());
  return result;
}

} // namespace pcl::floater
