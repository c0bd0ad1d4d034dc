// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/mesh_region.h"

#include <algorithm>

namespace pcl::floater {
// Each ring is a pass over all triangles, since a point may have several fans.
MeshRegion
regionAround (const std::vector<Triangle>& triangles, std::size_t points,
              const std::vector<Index>& seeds, std::size_t rings,
              const std::vector<std::uint8_t>& besides)
{
  std::vector<std::uint8_t> is_in = besides;
  is_in.resize (triangles.size (), 0);
  std::vector<Index> ring_of (points, NONE);
  for (const Index p : seeds)
    ring_of[p] = 0;
  bool has_grown = true;
  for (Index ring = 0; ring < rings && has_grown; ++ring) {
    has_grown = false;
    for (std::size_t t = 0; t < triangles.size (); ++t) {
      const Triangle& corners = triangles[t];
      if (std::none_of (corners.begin (), corners.end (),
                        [&] (Index p) { return ring_of[p] <= ring; }))
        continue;
      is_in[t] = 1;
      for (const Index p : corners)
        if (ring_of[p] == NONE) {
          ring_of[p] = ring + 1;
          has_grown = true;
        }
    }
  }
  constexpr std::uint8_t CORNER = 1, PARTIAL = 2;
  std::vector<std::uint8_t> marks (points, 0);
  for (const Index p : seeds)
    marks[p] = CORNER;
  MeshRegion region;
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    if (is_in[t] != 0)
      region.triangles.push_back (static_cast<Index> (t));
    for (const Index p : triangles[t])
      marks[p] = static_cast<std::uint8_t> (marks[p] | (is_in[t] != 0 ? CORNER : PARTIAL));
  }
  for (Index p = 0; p < points; ++p)
    if ((marks[p] & CORNER) != 0) {
      region.points.push_back (p);
      region.is_partial.push_back ((marks[p] & PARTIAL) != 0 ? 1 : 0);
    }
  return region;
}

} // namespace pcl::floater
