// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/kd_tree.h"

#include "core/parallel.h"

#include <algorithm>
#include <array>

namespace pcl::floater {
namespace {
constexpr Index LARGEST_LEAF = 12; // points in a leaf, at most
constexpr Index LARGEST_LEAF_OF_CURVE =
    20;                          // for points that keep their order; faster than 8 and 12
constexpr Index PARALLEL = 8192; // points from which on halves are built at the same time
} // namespace

KdTree::KdTree (const std::vector<Eigen::Vector3d>& positions, const RunContext& run,
                PointOrder order)
{
  items_.reserve (positions.size ());
  for (std::size_t p = 0; p < positions.size (); ++p)
    items_.push_back ({positions[p], static_cast<Index> (p)});
  if (!items_.empty ()) {
    nodes_.reserve (4 * items_.size () / LARGEST_LEAF + 1);
    build (0, static_cast<Index> (items_.size ()), run, order, nodes_);
  }
}

void
KdTree::build (Index first, Index last, const RunContext& run, PointOrder order,
               std::vector<Node>& nodes)
{
  const std::size_t self = nodes.size ();
  nodes.push_back ({{}, first, last, NONE});
  const bool is_leaf =
      last - first <= (order == PointOrder::ANY ? LARGEST_LEAF : LARGEST_LEAF_OF_CURVE);
  if (is_leaf || order == PointOrder::ANY) {
    Eigen::AlignedBox3d box;
    for (Index i = first; i < last; ++i)
      box.extend (items_[i].position);
    nodes[self].box = box;
  }
  if (is_leaf)
    return;
  const Index middle = first + (last - first) / 2;
  if (order == PointOrder::ANY) {
    int axis = 0;
    nodes[self].box.sizes ().maxCoeff (&axis);
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
  if (order == PointOrder::ALONG_CURVE)
    nodes[self].box = nodes[self + 1].box.merged (nodes[nodes[self].right].box);
}

// Nodes exactly as far as the worst neighbour are visited: they may contain a point of the same
// distance and smaller index.
template <typename Visit>
void
KdTree::search (Index node, const Eigen::Vector3d& query, Visit& visit) const
{
  const Node& here = nodes_[node];
  if (here.right == NONE) {
    for (Index i = here.first; i < here.last; ++i)
      visit.add ({(items_[i].position - query).squaredNorm (), items_[i].point});
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

void
KdTree::nearest (const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& result) const
{
  result.clear ();
  if (nodes_.empty () || k == 0)
    return;
  Nearest visit (result, std::min (k, items_.size ()));
  search (0, query, visit);
  visit.end ();
}

void
KdTree::within (const Eigen::Vector3d& query, double radius, std::vector<Neighbor>& result) const
{
  struct Within
  {
    std::vector<Neighbor>& found;
    double sqr_radius;

    double reach () const { return sqr_radius; }
    void add (const Neighbor& candidate)
    {
      if (candidate.sqr_distance <= sqr_radius)
        found.push_back (candidate);
    }
  };
  result.clear ();
  if (nodes_.empty ())
    return;
  Within visit{result, radius * radius};
  search (0, query, visit);
  std::sort (result.begin (), result.end ());
}

bool
KdTree::collect (const Eigen::Vector3d& query, double radius, std::size_t most,
                 std::vector<Index>& points) const
{
  struct Collect
  {
    std::vector<Index>& points;
    double sqr_radius;
    std::size_t most;

    double reach () const { return points.size () <= most ? sqr_radius : -1.0; }
    void add (const Neighbor& candidate)
    {
      if (candidate.sqr_distance <= sqr_radius)
        points.push_back (candidate.point);
    }
  };
  points.clear ();
  if (nodes_.empty ())
    return true;
  Collect visit{points, radius * radius, most};
  search (0, query, visit);
  return points.size () <= most;
}

} // namespace pcl::floater
