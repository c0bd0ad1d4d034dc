// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/kd_tree.h"

#include "core/parallel.h"

#include <algorithm>
#include <array>

namespace pcl
{
namespace floater
{
namespace
{
constexpr Index BUCKET = 12;     // points in a leaf, at most
constexpr Index PARALLEL = 8192; // points from which on halves are built at the same time
} // namespace

KdTree::KdTree (const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
{
  items_.reserve (positions.size ());
  for (std::size_t p = 0; p < positions.size (); ++p) {
    items_.push_back ({positions[p], static_cast<Index> (p)});
    box_.extend (positions[p]);
  }
  if (!items_.empty ()) {
    nodes_.reserve (4 * items_.size () / BUCKET + 1);
    build (0, static_cast<Index> (items_.size ()), run, nodes_);
  }
}

void
KdTree::build (Index first, Index last, const RunContext& run, std::vector<Node>& nodes)
{
  const std::size_t self = nodes.size ();
  nodes.push_back ({0.0, first, last, NONE, 0});
  if (last - first <= BUCKET)
    return;
  Eigen::AlignedBox3d box;
  for (Index i = first; i < last; ++i)
    box.extend (items_[i].position);
  int axis = 0;
  box.sizes ().maxCoeff (&axis);
  const Index middle = first + (last - first) / 2;
  std::nth_element (items_.begin () + first, items_.begin () + middle, items_.begin () + last,
                    [axis] (const Item& a, const Item& b) {
                      return a.position[axis] != b.position[axis]
                                 ? a.position[axis] < b.position[axis]
                                 : a.point < b.point;
                    });
  nodes[self].split = items_[middle].position[axis];
  nodes[self].axis = static_cast<std::uint8_t> (axis);
  if (run.threads () < 2 || last - first < PARALLEL) {
    build (first, middle, run.withThreads (1), nodes);
    nodes[self].right = static_cast<Index> (nodes.size ());
    build (middle, last, run.withThreads (1), nodes);
    return;
  }
  std::array<std::vector<Node>, 2> halves;
  parallelTasks (run, 2, [&] (std::size_t half) {
    const int others = run.threads () / 2;
    const RunContext share = run.withThreads (half == 0 ? run.threads () - others : others);
    build (half == 0 ? first : middle, half == 0 ? middle : last, share, halves[half]);
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

// `sqr_offsets` holds, per axis, the squared distance from the query to the node's slab, so that
// their sum is a lower bound for all points below. A node exactly as far as the worst neighbour is
// still visited: it may hold a point of the same distance and smaller index.
template <typename Visit>
void
KdTree::search (Index node, const Eigen::Vector3d& query, Eigen::Vector3d& sqr_offsets,
                double sqr_box_distance, Visit& visit) const
{
  const Node& here = nodes_[node];
  if (here.right == NONE) {
    for (Index i = here.first; i < here.last; ++i)
      visit.add ({(items_[i].position - query).squaredNorm (), items_[i].point});
    return;
  }
  const int axis = here.axis;
  const double offset = query[axis] - here.split;
  const Index near_child = offset < 0.0 ? node + 1 : here.right;
  const Index far_child = offset < 0.0 ? here.right : node + 1;
  search (near_child, query, sqr_offsets, sqr_box_distance, visit);
  const double previous = sqr_offsets[axis];
  const double sqr_far = sqr_box_distance - previous + offset * offset;
  // The bound is a sum updated in place; leave room for its rounding.
  if (sqr_far * (1.0 - 1e-12) <= visit.reach ()) {
    sqr_offsets[axis] = offset * offset;
    search (far_child, query, sqr_offsets, sqr_far, visit);
    sqr_offsets[axis] = previous;
  }
}

void
KdTree::nearest (const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& result) const
{
  result.clear ();
  if (nodes_.empty () || k == 0)
    return;
  Nearest visit (result, std::min (k, items_.size ()));
  Eigen::Vector3d sqr_offsets = Eigen::Vector3d::Zero ();
  search (0, query, sqr_offsets, 0.0, visit);
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
  Eigen::Vector3d sqr_offsets = Eigen::Vector3d::Zero ();
  search (0, query, sqr_offsets, 0.0, visit);
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
  Eigen::Vector3d sqr_offsets = Eigen::Vector3d::Zero ();
  search (0, query, sqr_offsets, 0.0, visit);
  return points.size () <= most;
}

} // namespace floater
} // namespace pcl
