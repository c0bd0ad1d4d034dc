// SPDX-License-Identifier: GPL-3.0-or-later
#include "blocks/block_neighbors.h"

#include "common/parallel.h"
#include "neighborhoods/kd_tree.h"
#include "neighborhoods/mean_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl
{
namespace floater
{
namespace
{
// Above one by more than the rounding of a sum of distances.
constexpr double SAFELY = 1.0 + 1e-9;

// Finds neighbours wave by wave, each wave among the neighbours of the one before.
class WaveFinder
{
public:
  WaveFinder (const PointBlock& block, std::size_t k, int threads)
      : block_ (block), k_ (k), threads_ (threads), tree_ (block.positions, threads),
        slot_ (block.positions.size (), NONE),
        depth_ (block.positions.size (), std::numeric_limits<double>::infinity ())
  {
    for (Index row = block.first; row < block.last; ++row)
      depth_[row] = 0.0;
  }

  // Finds neighbours of rows that have none yet.
  void find (const std::vector<Index>& rows)
  {
    const std::size_t begin = ids_.size ();
    ids_.resize (begin + rows.size () * k_);
    std::vector<double> reach (rows.size ());
    parallelRanges (rows.size (), threads_, [&] (std::size_t first, std::size_t last) {
      std::vector<Neighbor> found;
      found.reserve (k_ + 2);
      for (std::size_t i = first; i < last; ++i) {
        tree_.nearest (block_.positions[rows[i]], k_ + 1, found);
        reach[i] = found.size () == k_ + 1 ? std::sqrt (found.back ().sqr_distance)
                                           : std::numeric_limits<double>::infinity ();
        Index* id = ids_.data () + begin + i * k_;
        for (const Neighbor& neighbor : found)
          if (neighbor.point != rows[i])
            *id++ = neighbor.point;
      }
    });
    for (std::size_t i = 0; i < rows.size (); ++i) {
      slot_[rows[i]] = static_cast<Index> (begin / k_ + i);
      check (rows[i], reach[i]);
    }
  }

  // Rows among the first `count` neighbours of some rows that have no neighbours yet. Ascending.
  std::vector<Index> around (const std::vector<Index>& rows, std::size_t count)
  {
    std::vector<Index> wave;
    for (Index row : rows)
      for (std::size_t i = 0; i < std::min (count, k_); ++i) {
        const Index q = ids_[slot_[row] * k_ + i];
        if (slot_[q] != NONE)
          continue;
        const double depth = depth_[row] + (block_.positions[q] - block_.positions[row]).norm ();
        if (depth_[q] == std::numeric_limits<double>::infinity ())
          wave.push_back (q);
        depth_[q] = std::min (depth_[q], depth);
      }
    std::sort (wave.begin (), wave.end ());
    return wave;
  }

  const std::vector<Ball>& missing () const { return missing_; }

  FlatLists lists () const
  {
    FlatLists near;
    near.offsets.reserve (slot_.size () + 1);
    near.offsets.push_back (0);
    near.ids.reserve (ids_.size ());
    for (const Index slot : slot_) {
      if (slot != NONE) {
        const auto first = ids_.begin () + static_cast<std::ptrdiff_t> (slot * k_);
        near.ids.insert (near.ids.end (), first, first + static_cast<std::ptrdiff_t> (k_));
      }
      near.offsets.push_back (static_cast<Index> (near.ids.size ()));
    }
    return near;
  }

private:
  // Notes a row whose neighbours may be others in the whole cloud.
  void check (Index row, double reach)
  {
    if (block_.is_all || (depth_[row] + reach) * SAFELY <= block_.halo)
      return;
    const Eigen::Vector3d& centre = block_.positions[row];
    for (const Ball& ball : block_.balls)
      if (((ball.centre - centre).norm () + reach) * SAFELY <= ball.radius)
        return;
    constexpr double EVERYWHERE = 1e100;
    missing_.push_back ({centre, std::min (EVERYWHERE, reach * SAFELY * SAFELY)});
  }

  const PointBlock& block_;
  std::size_t k_;
  int threads_;
  KdTree tree_;
  std::vector<Index> slot_;   // per row: where its neighbours are, NONE before they are found
  std::vector<double> depth_; // per row: upper bound of its distance to the own points
  std::vector<Index> ids_;    // k of each slot
  std::vector<Ball> missing_;
};

std::vector<Index>
merged (const std::vector<Index>& a, const std::vector<Index>& b)
{
  std::vector<Index> both (a.size () + b.size ());
  std::merge (a.begin (), a.end (), b.begin (), b.end (), both.begin ());
  return both;
}

} // namespace

BlockNeighbors
findBlockNeighbors (const PointBlock& block, std::size_t k, int threads)
{
  BlockNeighbors neighbors;
  WaveFinder finder (block, k, threads);
  std::vector<Index> own (block.ownPoints ());
  for (Index i = 0; i < own.size (); ++i)
    own[i] = block.first + i;
  finder.find (own);
  const std::vector<Index> next = finder.around (own, k);
  finder.find (next);
  const std::vector<Index> beyond = finder.around (next, MEAN_OVER);
  finder.find (beyond);
  const std::vector<Index> halo = merged (next, beyond);
  const std::vector<Index> outside = finder.around (halo, k);
  finder.find (outside);
  neighbors.missing = finder.missing ();
  if (!neighbors.missing.empty ())
    return neighbors;
  neighbors.near = finder.lists ();
  neighbors.corners = merged (own, next);
  neighbors.stars = merged (own, halo);
  neighbors.found = merged (neighbors.stars, outside);
  return neighbors;
}

} // namespace floater
} // namespace pcl
