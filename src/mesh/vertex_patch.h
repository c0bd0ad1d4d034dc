// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Patches of vertices for reinsertion in several orders.
#pragma once

#include "core/order_statistics.h"
#include "mesh/triangle_mesh.h"

#include <random>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Adds one ring of vertices to a patch, and sorts it.
inline void
addRing (const TriangleMesh& mesh, std::vector<Index>& patch)
{
  std::vector<Index> wider, fan;
  for (const Index v : patch) {
    mesh.fan (v, fan);
    for (const Index t : fan)
      wider.insert (wider.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  }
  sortUnique (wider);
  patch.swap (wider);
}

/// Calls attempt (patch) for some orders of a patch, until it returns true. The orders are
/// deterministic.
/// \return whether an attempt returned true
template <typename Attempt>
bool
tryOrders (std::vector<Index> patch, std::size_t orders, Attempt&& attempt)
{
  std::mt19937 random (1);
  for (std::size_t order = 0; order < orders; ++order) {
    if (attempt (patch))
      return true;
    for (std::size_t i = patch.size (); i > 1; --i)
      std::swap (patch[i - 1], patch[random () % i]);
  }
  return false;
}

} // namespace pcl::floater
