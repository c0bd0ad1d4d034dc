// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Exact nearest neighbours among points in space.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

namespace pcl::floater {
/// A neighbour and its squared distance. Ordered by distance, then index.
struct Neighbor
{
  double sqr_distance;
  Index point;

  bool operator<(const Neighbor& other) const
  {
    return sqr_distance != other.sqr_distance ? sqr_distance < other.sqr_distance
                                              : point < other.point;
  }
};

/// Order of the points that a tree is built from.
enum class PointOrder
{
  ANY,        ///< the tree sorts them: O(n log n)
  ALONG_CURVE ///< most are near their predecessor, as in a working set; kept in this order
};

/// Tree of boxes with buckets of points at its leaves: a kd-tree by medians, or halves of the
/// points in their given order. 46 bytes per point for any number of threads. Queries are exact,
/// ties in distance are broken by index, and queries are thread-safe. The order of the points
/// affects only their time.
class KdTree
{
public:
  explicit KdTree (const Positions& positions, const RunContext& run = 1,
                   PointOrder order = PointOrder::ANY);

  /// Is told the ball that each search covered: the result depends on all points of the cloud in it. In
  /// a tree of a block, this shows whether the block was large enough. Several threads may call it.
  std::function<void (const Vector3d& centre, double radius)> watch;

  /// Tells the watch, if there is one; to be called after searches around a point of the cloud.
  void looked (const Vector3d& centre, double radius) const
  {
    if (watch)
      watch (centre, radius);
  }

  /// A radius beyond all points of a working set.
  static constexpr double EVERYWHERE = 1e100;

  /// The k nearest points to `query`, nearest first; fewer if the tree has fewer. Overwrites the
  /// result. O(k + log n) on clouds of bounded density.
  void nearest (const Vector3d& query, std::size_t k, std::vector<Neighbor>& result) const;

  /// All points within `radius` of `query` (that distance included), unordered.
  /// \return false if there are more than `most`; then some are missing
  bool collect (const Vector3d& query, double radius, std::size_t most,
                std::vector<Index>& points) const;

  /// The k nearest points to `query` within `radius` for which accept (neighbor, position) is true,
  /// nearest first. Points behind the plane through `query` with the normal `ahead` may be skipped,
  /// and accept must reject them; a zero normal means no plane. Overwrites the result.
  /// \return the radius that the search has covered
  template <typename Accept>
  double nearestIf (const Vector3d& query, const Vector3d& ahead, double radius, std::size_t k,
                    Accept&& accept, std::vector<Neighbor>& result) const;

private:
  struct Node
  {
    Eigen::AlignedBox3d box; // of the points below this node
    Index first;             // first of these points
    Index last;              // one past
    Index right;             // the left child is the next node; NONE at a leaf

    double sqrDistance (const Vector3d& query) const
    {
      return (box.min () - query).cwiseMax (query - box.max ()).cwiseMax (0.0).squaredNorm ();
    }
    double sqrDistanceOfCentre (const Vector3d& query) const
    {
      return (0.5 * (box.min () + box.max ()) - query).squaredNorm ();
    }
  };
  struct Item
  {
    Vector3d position;
    Index point;
  };
  // Visitor of a search: the nearest points found so far, at most k within the reach.
  class Nearest
  {
  public:
    Nearest (std::vector<Neighbor>& found, std::size_t k,
             double sqr_radius = std::numeric_limits<double>::infinity ())
        : found_ (found), k_ (k), sqr_reach_ (k > 0 ? sqr_radius : -1.0)
    {
      found.resize (k);
    }

    double reach () const { return sqr_reach_; }
    bool skips (const Node&) const { return false; }
    void add (const Neighbor& candidate, const Vector3d& /*position*/)
    {
      if (candidate.sqr_distance > sqr_reach_)
        return;
      if (count_ == k_) {
        if (!(candidate < found_[count_ - 1]))
          return;
        --count_;
      }
      std::size_t at = count_++;
      for (; at > 0 && candidate < found_[at - 1]; --at)
        found_[at] = found_[at - 1];
      found_[at] = candidate;
      if (count_ == k_)
        sqr_reach_ = found_[count_ - 1].sqr_distance;
    }
    void end () { found_.resize (count_); }

  private:
    std::vector<Neighbor>& found_;
    std::size_t k_, count_ = 0;
    double sqr_reach_;
  };

  template <typename Visit>
  void search (Index node, const Vector3d& query, Visit& visit) const;
  void build (Index first, Index last, const RunContext& run, PointOrder order,
              std::vector<Node>& nodes);

  std::vector<Item> items_; // in the order of the leaves
  std::vector<Node> nodes_;
};

// Nodes exactly as far as the worst neighbour are visited: they may contain a point of the same
// distance and smaller index.
template <typename Visit>
void
KdTree::search (Index node, const Vector3d& query, Visit& visit) const
{
  const Node& here = nodes_[node];
  if (visit.skips (here))
    return;
  if (here.right == NONE) {
    for (Index i = here.first; i < here.last; ++i)
      visit.add ({(items_[i].position - query).squaredNorm (), items_[i].point},
                 items_[i].position);
    return;
  }
  constexpr double ROUNDED = 1.0 - 1e-12; // leaves room for the rounding of a sum of squares
  const double left = ROUNDED * nodes_[node + 1].sqrDistance (query);
  const double right = ROUNDED * nodes_[here.right].sqrDistance (query);
  const bool left_first = left != right ? left < right
                                        : nodes_[node + 1].sqrDistanceOfCentre (query) <=
                                              nodes_[here.right].sqrDistanceOfCentre (query);
  if ((left_first ? left : right) <= visit.reach ())
    search (left_first ? node + 1 : here.right, query, visit);
  if ((left_first ? right : left) <= visit.reach ())
    search (left_first ? here.right : node + 1, query, visit);
}

template <typename Accept>
double
KdTree::nearestIf (const Vector3d& query, const Vector3d& ahead, double radius, std::size_t k,
                   Accept&& accept, std::vector<Neighbor>& result) const
{
  struct Accepted
  {
    Nearest nearest;
    const Vector3d &query, &ahead;
    Accept& accept;

    double reach () const { return nearest.reach (); }
    bool skips (const Node& node) const
    {
      const Vector3d farthest =
          (ahead.array () < 0.0).select (node.box.min (), node.box.max ()) - query;
      return ahead.dot (farthest) < 0.0;
    }
    void add (const Neighbor& candidate, const Vector3d& position)
    {
      if (candidate.sqr_distance <= reach () && accept (candidate, position))
        nearest.add (candidate, position);
    }
  };
  Accepted visit{{result, std::min (k, items_.size ()), radius * radius}, query, ahead, accept};
  search (0, query, visit);
  visit.nearest.end ();
  return !result.empty () && result.size () == k ? std::sqrt (result.back ().sqr_distance) : radius;
}

/// The k nearest points to points that mostly are near their predecessors, as along a space-filling
/// curve. Same result as KdTree::nearest, in less than half of the time: consecutive points share
/// the points of one ball, and the previous result bounds the distance of the next.
class SequentialSearch
{
public:
  /// \param tree, positions the tree, and the positions it was made from; must outlive this
  SequentialSearch (const KdTree& tree, const Positions& positions, std::size_t k)
      : tree_ (tree), positions_ (positions), k_ (k)
  {
  }

  /// Calls visit (i, found) for each of the points: `found` holds the k nearest to points[i],
  /// itself among them, nearest first; fewer if the tree holds fewer.
  template <typename Visit>
  void search (const std::vector<Index>& points, Visit&& visit)
  {
    for (std::size_t first = 0, last = 0; first < points.size (); first = last) {
      last = gatherBall (points, first);
      for (std::size_t i = first; i < last; ++i) {
        nearest (positions_[points[i]]);
        visit (i, found_);
      }
    }
  }

private:
  std::size_t gatherBall (const std::vector<Index>& points, std::size_t first);
  void nearest (const Vector3d& query);
  bool searchBall (const Vector3d& query, double reach);

  const KdTree& tree_;
  const Positions& positions_;
  std::size_t k_;
  std::vector<Neighbor> found_;
  Vector3d last_ = Vector3d::Zero (); // last query, and the distance to its last
                                      // neighbour
  double last_reach_ = KdTree::EVERYWHERE;
  Vector3d centre_ = Vector3d::Zero (); // of the ball
  double radius_ = -1.0;                // of the ball; negative: there is none
  std::vector<Index> ball_;             // points in the ball, and their coordinates: without memory
                                        // to grow, an array of Eigen would be freed twice
  std::array<std::vector<double>, 3> places_;
  std::vector<double> sqr_distances_; // of these to the query
  std::vector<Neighbor> near_;        // points within reach, unordered
};

} // namespace pcl::floater
