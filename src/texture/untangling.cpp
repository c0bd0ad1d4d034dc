// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/untangling.h"

#include "core/geometry.h"
#include "core/order_statistics.h"

#include <algorithm>
#include <numeric>

namespace pcl::floater {
namespace {
constexpr double EAR_HEIGHT = 0.2; // of a triangle with two edges on the boundary, over its base

class Untangler
{
public:
  Untangler (const ChartMesh& chart, const UntanglingLimits& limits,
             std::vector<Eigen::Vector2d>& uv)
      : chart_ (chart), limits_ (limits), uv_ (uv), before_ (uv.size (), NONE),
        after_ (uv.size (), NONE), corners_ (makeCsrLists (uv.size (), [&chart] (const auto& emit) {
          for (Index t = 0; t < chart.mesh.triangles.size (); ++t)
            for (std::uint8_t i = 0; i < 3; ++i)
              emit (chart.mesh.triangles[t][i], 3 * t + i);
        }))
  {
    for (std::size_t i = 0; i < chart.loop.size (); ++i) {
      const Index p = chart.loop[i], next = chart.loop[i + 1 == chart.loop.size () ? 0 : i + 1];
      after_[p] = next;
      before_[next] = p;
    }
  }

  bool untangle (const RunContext& run)
  {
    for (int round = 0; round < limits_.rounds; ++round) {
      run.poll ();
      bad_.clear ();
      const std::size_t flipped = findFlipped ();
      if (static_cast<double> (flipped) >
          limits_.most_flipped * static_cast<double> (chart_.mesh.triangles.size ()))
        break;
      findCrossing ();
      if (bad_.empty ())
        return true;
      markAround (1 + round / limits_.rounds_per_ring);
      for (int sweep = 0; sweep < limits_.sweeps; ++sweep)
        for (const Index p : marked_)
          uv_[p] = targetOf (p);
    }
    return false;
  }

private:
  // \return number of flipped triangles
  std::size_t findFlipped ()
  {
    std::size_t flipped = 0;
    for (const Triangle& t : chart_.mesh.triangles)
      if (!(cross (Eigen::Vector2d (uv_[t[1]] - uv_[t[0]]),
                   Eigen::Vector2d (uv_[t[2]] - uv_[t[0]])) > 0.0)) {
        ++flipped;
        bad_.insert (bad_.end (), t.begin (), t.end ());
      }
    return flipped;
  }

  // Boundary edges from left to right: an edge can only cross others that begin before it ends.
  void findCrossing ()
  {
    const std::vector<Index>& loop = chart_.loop;
    const std::size_t size = loop.size ();
    const auto from = [&] (std::size_t i) -> const Eigen::Vector2d& { return uv_[loop[i]]; };
    const auto to = [&] (std::size_t i) -> const Eigen::Vector2d& {
      return uv_[loop[i + 1 == size ? 0 : i + 1]];
    };
    std::vector<std::size_t> order (size);
    std::iota (order.begin (), order.end (), std::size_t{0});
    const auto begin = [&] (std::size_t i) { return std::min (from (i).x (), to (i).x ()); };
    std::sort (order.begin (), order.end (), [&] (std::size_t a, std::size_t b) {
      return begin (a) != begin (b) ? begin (a) < begin (b) : a < b;
    });
    std::vector<std::size_t> open; // edges that have not ended yet
    for (const std::size_t i : order) {
      open.erase (std::remove_if (open.begin (), open.end (),
                                  [&] (std::size_t j) {
                                    return std::max (from (j).x (), to (j).x ()) < begin (i);
                                  }),
                  open.end ());
      for (const std::size_t j : open)
        if ((i + 1) % size != j && (j + 1) % size != i &&
            haveCommon (from (i), to (i), from (j), to (j)))
          for (const std::size_t edge : {i, j}) {
            bad_.push_back (loop[edge]);
            bad_.push_back (loop[edge + 1 == size ? 0 : edge + 1]);
          }
      open.push_back (i);
    }
  }

  // Whether two segments have a point in common.
  static bool haveCommon (const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& c, const Eigen::Vector2d& d)
  {
    const auto side = [] (const Eigen::Vector2d& p, const Eigen::Vector2d& q,
                          const Eigen::Vector2d& r) {
      return cross (Eigen::Vector2d (q - p), Eigen::Vector2d (r - p));
    };
    if (std::max (a.y (), b.y ()) < std::min (c.y (), d.y ()) ||
        std::max (c.y (), d.y ()) < std::min (a.y (), b.y ()))
      return false;
    return side (a, b, c) * side (a, b, d) <= 0.0 && side (c, d, a) * side (c, d, b) <= 0.0;
  }

  // Marks bad vertices and some rings around them, in addition to earlier marks.
  void markAround (int rings)
  {
    std::vector<Index> found = bad_;
    std::vector<std::uint8_t> is_found (uv_.size (), 0);
    for (const Index p : found)
      is_found[p] = 1;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t before = found.size ();
      for (std::size_t i = 0; i < before; ++i)
        for (const Index id : corners_.row (found[i]))
          for (const Index q : chart_.mesh.triangles[id / 3])
            if (is_found[q] == 0) {
              is_found[q] = 1;
              found.push_back (q);
            }
    }
    marked_.insert (marked_.end (), found.begin (), found.end ());
    sortUnique (marked_);
  }

  // The mean of the neighbours; on the boundary, of those along it.
  Eigen::Vector2d targetOf (Index p) const
  {
    const Row row = corners_.row (p);
    if (before_[p] == NONE) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero ();
      for (const Index id : row)
        sum += cornerAfter (id, 1);
      return sum / static_cast<double> (row.size ());
    }
    const Eigen::Vector2d &before = uv_[before_[p]], &after = uv_[after_[p]];
    const Eigen::Vector2d middle = 0.5 * (before + after);
    if (row.size () > 1)
      return middle;
    // A vertex of one triangle lies to the right of the line from the vertex before to the one
    // after it.
    const Eigen::Vector2d way = after - before;
    return middle + EAR_HEIGHT * Eigen::Vector2d (way.y (), -way.x ());
  }

  // Corner of a triangle, as 3 triangle + corner, after a number of steps.
  const Eigen::Vector2d& cornerAfter (Index id, Index places) const
  {
    return uv_[chart_.mesh.triangles[id / 3][(id % 3 + places) % 3]];
  }

  const ChartMesh& chart_;
  const UntanglingLimits& limits_;
  std::vector<Eigen::Vector2d>& uv_;
  std::vector<Index> before_, after_; // per vertex: those along the boundary, NONE if it is inside
  CsrLists corners_;                  // per vertex: where it is a corner, as 3 triangle + corner
  std::vector<Index> bad_;            // vertices, some more than once
  std::vector<Index> marked_;         // to be moved
};

} // namespace

bool
untangle (const ChartMesh& chart, const UntanglingLimits& limits, const RunContext& run,
          std::vector<Eigen::Vector2d>& uv)
{
  return Untangler (chart, limits, uv).untangle (run);
}

} // namespace pcl::floater
