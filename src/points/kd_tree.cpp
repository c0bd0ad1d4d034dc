// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/kd_tree.h"

#include "core/parallel.h"

namespace pcl::floater {
namespace {
constexpr Index LARGEST_LEAF = 12; // points in a leaf, at most
constexpr Index LARGEST_LEAF_OF_CURVE =
    20;                          // for points that keep their order; faster than 8 and 12
constexpr Index PARALLEL = 8192; // points from which on halves are built at the same time

// Points that share a ball. Larger groups need fewer balls, with more points in each. On a height
// field, this and the next two were the fastest of five choices: 16 or 24 points, margins of 1.3 to
// 1.5, widths of 2 to 3. The slowest took a fifth more.
constexpr std::size_t GROUP = 24;

// Radius around each point of the group that the ball covers, relative to the distance of the last
// neighbour of the point before the group.
constexpr double MARGIN = 1.3;

// Largest width of a group, in such distances: beyond, the curve has jumped.
constexpr double WIDEST = 2.5;

// Maximum number of points in a ball for each neighbour. With the widths above it would be (WIDEST
// / 2 + MARGIN)^2, or 7, on a plane of even density; with many more, the density varies and the
// tree is faster.
constexpr std::size_t MOST_POINTS = 32;

// Expected bound of the distance to the last neighbour, relative to the previous point. If it
// fails, all points within reach are sorted. 1.15 took as long.
constexpr double EXPECTED = 1.1;

// Squares of shorter distances are imprecise. Coordinates are of the order of one.
constexpr double SHORTEST = 1e-140;

// Exceeds one by more than the rounding of a sum of distances.
constexpr double SAFELY = 1.0 + 1e-9;

// Sorts by distance, then point: first by counting in this many classes of the squared distance,
// which is evenly spread on surfaces, and then by insertion.
constexpr std::size_t CLASSES = 64;

void
sortInto (const std::vector<Neighbor>& some, std::size_t count, double sqr_reach,
          std::vector<Neighbor>& sorted)
{
  const double classes_per_distance = static_cast<double> (CLASSES - 1) / sqr_reach;
  const auto classOf = [classes_per_distance] (const Neighbor& neighbor) {
    return static_cast<std::size_t> (neighbor.sqr_distance * classes_per_distance);
  };
  std::array<std::uint32_t, CLASSES + 1> ends{};
  for (std::size_t i = 0; i < count; ++i)
    ++ends[classOf (some[i]) + 1];
  for (std::size_t c = 1; c <= CLASSES; ++c)
    ends[c] += ends[c - 1];
  sorted.resize (count);
  for (std::size_t i = 0; i < count; ++i)
    sorted[ends[classOf (some[i])]++] = some[i];
  for (std::size_t i = 1; i < count; ++i) {
    const Neighbor moved = sorted[i];
    std::size_t at = i;
    for (; at > 0 && moved < sorted[at - 1]; --at)
      sorted[at] = sorted[at - 1];
    sorted[at] = moved;
  }
}

} // namespace

KdTree::KdTree (const Positions& positions, const RunContext& run, PointOrder order)
{
  items_.reserve (positions.size ());
  for (std::size_t p = 0; p < positions.size (); ++p)
    items_.push_back ({positions[p], static_cast<Index> (p)});
  nodes_.reserve (4 * items_.size () / LARGEST_LEAF + 1);
  build (0, static_cast<Index> (items_.size ()), run, order, nodes_);
}

void
KdTree::build (Index first, Index last, const RunContext& run, PointOrder order,
               std::vector<Node>& nodes)
{
  const std::size_t self = nodes.size ();
  Eigen::AlignedBox3d box;
  for (Index i = first; i < last; ++i)
    box.extend (items_[i].position);
  nodes.push_back ({box, first, last, NONE});
  if (last - first <= (order == PointOrder::ANY ? LARGEST_LEAF : LARGEST_LEAF_OF_CURVE))
    return;
  const Index middle = first + (last - first) / 2;
  if (order == PointOrder::ANY) {
    int axis = 0;
    box.sizes ().maxCoeff (&axis);
    std::nth_element (items_.begin () + first, items_.begin () + middle, items_.begin () + last,
                      [axis] (const Item& a, const Item& b) {
                        return a.position[axis] != b.position[axis]
                                   ? a.position[axis] < b.position[axis]
                                   : a.point < b.point;
                      });
  }
  if (run.threads () < 2 || last - first < PARALLEL) {
    build (first, middle, run.withThreads (1), order, nodes);
    nodes[self].right = static_cast<Index> (nodes.size ());
    build (middle, last, run.withThreads (1), order, nodes);
  }
  else {
    std::array<std::vector<Node>, 2> halves;
    parallelTasks (run, 2, [&] (std::size_t half) {
      const int others = run.threads () / 2;
      const RunContext share = run.withThreads (half == 0 ? run.threads () - others : others);
      build (half == 0 ? first : middle, half == 0 ? middle : last, share, order, halves[half]);
    });
    for (std::vector<Node>& half : halves) {
      const auto offset = static_cast<Index> (nodes.size ());
      if (&half == &halves[1])
        nodes[self].right = offset;
      for (Node& node : half) {
        if (node.right != NONE)
          node.right += offset;
        nodes.push_back (node);
      }
    }
  }
}

void
KdTree::nearest (const Vector3d& query, std::size_t k, std::vector<Neighbor>& result) const
{
  Nearest visit (result, std::min (k, items_.size ()));
  search (0, query, visit);
  visit.end ();
}

bool
KdTree::collect (const Vector3d& query, double radius, std::size_t most,
                 std::vector<Index>& points) const
{
  struct Collect
  {
    std::vector<Index>& points;
    double sqr_radius;
    std::size_t most;

    double reach () const { return points.size () <= most ? sqr_radius : -1.0; }
    bool skips (const Node&) const { return false; }
    void add (const Neighbor& candidate, const Vector3d& /*position*/)
    {
      if (candidate.sqr_distance <= sqr_radius)
        points.push_back (candidate.point);
    }
  };
  points.clear ();
  Collect visit{points, radius * radius, most};
  search (0, query, visit);
  return points.size () <= most;
}

// Gathers the points around a group that begins at `first`. Returns its end.
std::size_t
SequentialSearch::gatherBall (const std::vector<Index>& points, std::size_t first)
{
  radius_ = -1.0;
  const Vector3d& begin = positions_[points[first]];
  if (last_reach_ == KdTree::EVERYWHERE) // none found yet
    nearest (begin);
  if (!(last_reach_ > SHORTEST) || last_reach_ == KdTree::EVERYWHERE)
    return first + 1;
  Eigen::AlignedBox3d box (begin);
  std::size_t last = first + 1;
  for (; last < std::min (points.size (), first + GROUP); ++last) {
    const Eigen::AlignedBox3d wider = box.merged (Eigen::AlignedBox3d (positions_[points[last]]));
    if (!(wider.diagonal ().norm () <= WIDEST * last_reach_))
      break;
    box = wider;
  }
  centre_ = box.center ();
  double farthest = 0.0;
  for (std::size_t i = first; i < last; ++i)
    farthest = std::max (farthest, (positions_[points[i]] - centre_).norm ());
  const double radius = farthest + MARGIN * last_reach_;
  if (!tree_.collect (centre_, radius, MOST_POINTS * k_, ball_))
    return last;
  radius_ = radius;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double>& places = places_[static_cast<std::size_t> (axis)];
    places.clear ();
    for (const Index p : ball_)
      places.push_back (positions_[p][axis]);
  }
  return last;
}

void
SequentialSearch::nearest (const Vector3d& query)
{
  // All neighbours of the last query are within this distance; so are as many points of the ball,
  // if it covers this distance. If not, a smaller ball may still contain enough.
  const double reach = (last_reach_ + (query - last_).norm ()) * SAFELY;
  const double inside = radius_ / SAFELY - (query - centre_).norm () * SAFELY;
  if (!searchBall (query, std::min (reach, inside)))
    tree_.nearest (query, k_, found_);
  last_ = query;
  last_reach_ =
      found_.size () == k_ && k_ > 0 ? std::sqrt (found_.back ().sqr_distance) : KdTree::EVERYWHERE;
}

// \return false if there are too few points within reach
bool
SequentialSearch::searchBall (const Vector3d& query, double reach)
{
  if (!(reach > SHORTEST))
    return false;
  const std::size_t count = ball_.size ();
  // The same sum as in the tree: the order of neighbours depends on the last bit.
  sqr_distances_.resize (count);
  const auto array = [count] (std::vector<double>& values) {
    return Eigen::Map<Eigen::ArrayXd> (values.data (), static_cast<Eigen::Index> (count));
  };
  array (sqr_distances_) = (array (places_[0]) - query.x ()).square () +
                           (array (places_[1]) - query.y ()).square () +
                           (array (places_[2]) - query.z ()).square ();
  near_.resize (count + 1);
  // The last neighbour is mostly about as far as for the previous query.
  for (const double within : {std::min (reach, EXPECTED * last_reach_), reach}) {
    const double sqr_reach = within * within;
    std::size_t near = 0;
    for (std::size_t i = 0; i < count; ++i) {
      near_[near] = {sqr_distances_[i], ball_[i]};
      near += near_[near].sqr_distance <= sqr_reach ? 1 : 0;
    }
    if (near < k_)
      continue;
    sortInto (near_, near, sqr_reach, found_);
    found_.resize (k_);
    return true;
  }
  return false;
}

} // namespace pcl::floater
