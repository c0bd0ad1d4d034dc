// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/insertion.h"

#include <limits>
#include <queue>
#include <tuple>
#include <vector>

namespace pcl::floater {
namespace {
constexpr std::size_t LARGEST_STAR = 200; // triangles: the largest k of the options

// Inserts points one by one, always the one with the cheapest split.
class PointInserter
{
public:
  PointInserter (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost, bool flip,
                 const RunContext& run)
      : mesh_ (mesh), neighbors_ (neighbors), cost_ (cost), run_ (run), flipper_ (mesh, cost_, run),
        flip_ (flip), queued_ (mesh.triangle_of.size (), 0)
  {
  }

  std::size_t run ()
  {
    std::vector<Index> missing;
    for (Index p = 0; p < mesh_.triangle_of.size (); ++p)
      if (mesh_.triangle_of[p] == NONE)
        missing.push_back (p);
    if (missing.empty ())
      return 0;
    seen_.assign (mesh_.triangles.size () + 2 * missing.size (), 0); // each adds two triangles
    std::size_t inserted = 0;
    ProgressLoop progress (run_, missing.size ());
    awaiting_ = makeCsrLists (mesh_.triangle_of.size (), [&] (const auto& emit) {
      for (const Index p : missing)
        for (const Index q : neighbors_.row (p))
          if (mesh_.triangle_of[q] == NONE)
            emit (q, p);
    });
    ProgressLoop offers (run_);
    for (Index p : missing) {
      offers.next ();
      offer (p);
    }
    while (!queue_.empty ()) {
      progress.reach (inserted);
      const Place place = queue_.top ();
      queue_.pop ();
      if (mesh_.triangle_of[place.point] != NONE)
        continue;
      const Place now = cheapest (place.point);
      if (now.triangle == NONE)
        continue;
      insert (now);
      ++inserted;
    }
    return inserted;
  }

private:
  struct Place
  {
    double added;
    Index point, triangle;

    bool operator<(const Place& other) const // puts the cheapest on top of the queue
    {
      return std::tie (other.added, other.point) < std::tie (added, point);
    }
  };

  // Queues a point if it can be inserted. Its cheapest triangle is searched again later.
  void offer (Index p)
  {
    if (queued_[p] != 0)
      return;
    const Place place = cheapest (p);
    if (place.triangle == NONE)
      return;
    queue_.push (place);
    queued_[p] = 1;
  }

  // The triangle at a neighbour of p with the cheapest split at p.
  Place cheapest (Index p)
  {
    Place best{0.0, p, NONE};
    ++search_;
    hubs_.clear ();
    for (Index q : neighbors_.row (p))
      if (isHub (q))
        hubs_.push_back (q);
      else
        tryFan (q, best);
    // The triangles of a hub beside p are also in the fans of other neighbours.
    for (std::size_t i = 0; i < hubs_.size () && best.triangle == NONE; ++i)
      tryFan (hubs_[i], best);
    return best;
  }

  void tryFan (Index q, Place& best)
  {
    mesh_.fan (q, fan_);
    for (Index t : fan_) {
      if (seen_[t] == search_)
        continue;
      seen_[t] = search_;
      const double limit =
          best.triangle == NONE ? std::numeric_limits<double>::infinity () : best.added;
      const double added = splitCost (mesh_, cost_, t, best.point, limit);
      if (best.triangle == NONE || added < best.added)
        best = {added, best.point, t};
    }
  }

  // Whether q has more triangles than any star.
  bool isHub (Index q) const
  {
    std::size_t count = 0;
    for (FanWalk walk (mesh_, q); walk.triangle () != NONE && count <= LARGEST_STAR;
         walk.advance ())
      ++count;
    return count > LARGEST_STAR;
  }

  void insert (const Place& place)
  {
    mesh_.split (place.triangle, place.point);
    if (flip_) {
      mesh_.fan (place.point, fan_);
      for (Index t : fan_)
        for (std::uint8_t side = 0; side < 3; ++side)
          flipper_.push ({t, side});
      flipper_.run ();
    }
    for (const Index p : awaiting_.row (place.point))
      if (mesh_.triangle_of[p] == NONE)
        offer (p);
  }

  TriangleMesh& mesh_;
  const CsrLists& neighbors_;
  CachedCost cost_;
  RunContext run_;
  EdgeFlipper flipper_;
  bool flip_;
  CsrLists awaiting_; // of each missing point: those that can be inserted after it
  std::priority_queue<Place> queue_;
  std::vector<std::uint8_t> queued_; // per point
  std::vector<Index> seen_;          // per triangle: the last search that visited it
  Index search_ = 0;
  std::vector<Index> fan_, hubs_;
};

} // namespace

std::size_t
insertMissingPoints (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
                     bool flip, const RunContext& run)
{
  return PointInserter (mesh, neighbors, cost, flip, run).run ();
}

} // namespace pcl::floater
