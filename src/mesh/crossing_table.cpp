// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/crossing_table.h"

#include "mesh/vertex_stars.h"

#include <algorithm>

namespace pcl::floater {
namespace {
constexpr std::size_t TESTS_PER_EXACT = 9; // simple tests in the additional time of an exact test

bool
contains (const std::vector<Index>& ascending, Index t)
{
  return std::binary_search (ascending.begin (), ascending.end (), t);
}

std::vector<Index>
inverseOf (const std::vector<Index>& order)
{
  std::vector<Index> place (order.size ());
  for (Index i = 0; i < order.size (); ++i)
    place[order[i]] = i;
  return place;
}

// A pair of two changed triangles is counted at the smaller one.
long
countPairs (Index t, const std::vector<Index>& partners, const std::vector<Index>& changed)
{
  return std::count_if (partners.begin (), partners.end (),
                        [&] (Index u) { return t < u || !contains (changed, u); });
}

} // namespace

CrossingTable::CrossingTable (const TriangleMesh& mesh,
                              const std::vector<Eigen::Vector3d>& positions,
                              const std::vector<CrossingPair>& pairs, const RunContext& run)
    : mesh_ (mesh), positions_ (positions),
      order_ (orderByPoints (mesh.triangles, positions.size ())), place_ (inverseOf (order_)),
      tree_ (
          order_.size (),
          [this] (std::size_t i) { return boxOf (mesh_.triangles[order_[i]], positions_); }, run),
      pairs_ (pairs.size ())
{
  for (const CrossingPair& pair : pairs) {
    partners_[pair.first].push_back (pair.second);
    partners_[pair.second].push_back (pair.first);
  }
}

std::vector<Index>
CrossingTable::crossing () const
{
  std::vector<Index> triangles;
  for (const auto& [t, partners] : partners_)
    triangles.push_back (t);
  std::sort (triangles.begin (), triangles.end ());
  return triangles;
}

long
CrossingTable::pairsOf (const std::vector<Index>& triangles) const
{
  long pairs = 0;
  for (const Index t : triangles)
    if (const std::vector<Index>* const partners = partnersOf (t))
      pairs += countPairs (t, *partners, triangles);
  return pairs;
}

long
CrossingTable::tryChange (const std::vector<Index>& changed, long limit)
{
  renewBoxes (changed);
  long change = -pairsOf (changed);
  std::vector<Index> partners;
  for (const Index t : changed) {
    if (change >= limit)
      break;
    findPartners (t, partners);
    change += countPairs (t, partners, changed);
  }
  return change;
}

void
CrossingTable::accept (const std::vector<Index>& changed)
{
  for (const Index t : changed) {
    const auto known = partners_.find (t);
    if (known == partners_.end ())
      continue;
    for (const Index u : known->second) {
      const auto others = partners_.find (u);
      others->second.erase (std::find (others->second.begin (), others->second.end (), t));
      if (others->second.empty ())
        partners_.erase (others);
      --pairs_;
    }
    partners_.erase (t);
  }
  std::vector<Index> partners;
  for (const Index t : changed) {
    findPartners (t, partners);
    for (const Index u : partners)
      if (t < u || !contains (changed, u)) {
        partners_[t].push_back (u);
        partners_[u].push_back (t);
        ++pairs_;
      }
  }
}

void
CrossingTable::renewBoxes (const std::vector<Index>& changed)
{
  for (const Index t : changed)
    tree_.set (place_[t], boxOf (mesh_.triangles[t], positions_));
}

void
CrossingTable::findPartners (Index t, std::vector<Index>& partners)
{
  partners.clear ();
  std::size_t tests = 0, exact_tests = 0;
  const Triangle& own = mesh_.triangles[t];
  tree_.forOverlaps (boxOf (own, positions_), [&] (std::size_t i) {
    const Index u = order_[i];
    ++tests;
    if (u != t && doCross (own, mesh_.triangles[u], positions_, &exact_tests))
      partners.push_back (u);
  });
  tests_ += tests + TESTS_PER_EXACT * exact_tests;
}

} // namespace pcl::floater
