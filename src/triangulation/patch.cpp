// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/patch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <tuple>

namespace pcl
{
namespace floater
{
namespace
{
// The sorted distinct elements.
void
makeSet (std::vector<Index>& list)
{
  std::sort (list.begin (), list.end ());
  list.erase (std::unique (list.begin (), list.end ()), list.end ());
}

Index
placeOf (const std::vector<Index>& sorted, Index element)
{
  const auto at = std::lower_bound (sorted.begin (), sorted.end (), element);
  return at != sorted.end () && *at == element ? static_cast<Index> (at - sorted.begin ()) : NONE;
}

const Patch::RimEdge*
rimEdge (const Patch& patch, Index from, Index to)
{
  const auto at =
      std::lower_bound (patch.rim.begin (), patch.rim.end (), std::make_pair (from, to),
                        [] (const Patch::RimEdge& edge, const std::pair<Index, Index>& ends) {
                          return std::tie (edge.from, edge.to) < std::tie (ends.first, ends.second);
                        });
  return at != patch.rim.end () && at->from == from && at->to == to ? &*at : nullptr;
}

} // namespace

Patch
cutPatch (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
          const std::vector<Eigen::Vector3f>& normals, const std::vector<Index>& triangles,
          int rings)
{
  Patch patch;
  patch.slots = triangles;
  std::vector<Index> fan_triangles;
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<Index> corners;
    for (Index t : patch.slots)
      corners.insert (corners.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
    makeSet (corners);
    for (Index p : corners) {
      mesh.fan (p, fan_triangles);
      patch.slots.insert (patch.slots.end (), fan_triangles.begin (), fan_triangles.end ());
    }
    makeSet (patch.slots);
  }
  for (Index t : patch.slots)
    patch.points.insert (patch.points.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  makeSet (patch.points);
  for (Index p : patch.points) {
    patch.positions.push_back (positions[p]);
    patch.normals.push_back (normals[p]);
  }

  patch.mesh.triangle_of.assign (patch.points.size (), NONE);
  for (Index slot = 0; slot < patch.slots.size (); ++slot) {
    const Index t = patch.slots[slot];
    Triangle local{};
    std::array<Index, 3> neighbors{};
    for (std::uint8_t side = 0; side < 3; ++side) {
      local[side] = placeOf (patch.points, mesh.triangles[t][side]);
      const Index u = mesh.neighbors[t][side];
      neighbors[side] = u == NONE ? NONE : placeOf (patch.slots, u);
      patch.mesh.triangle_of[local[side]] = slot;
    }
    for (std::uint8_t side = 0; side < 3; ++side) {
      const MeshEdge outside = mesh.mate ({t, side});
      if (outside.triangle == NONE || neighbors[side] != NONE)
        continue;
      const Triangle& corners = mesh.triangles[outside.triangle];
      const Eigen::Vector3d area_vector =
          (positions[corners[1]] - positions[corners[0]])
              .cross (positions[corners[2]] - positions[corners[0]]);
      patch.rim.push_back ({local[SurfaceMesh::next (side)], local[SurfaceMesh::previous (side)],
                            outside, area_vector.normalized ()});
    }
    patch.mesh.triangles.push_back (local);
    patch.mesh.neighbors.push_back (neighbors);
  }
  std::sort (patch.rim.begin (), patch.rim.end (),
             [] (const Patch::RimEdge& a, const Patch::RimEdge& b) {
               return std::tie (a.from, a.to) < std::tie (b.from, b.to);
             });
  return patch;
}

void
pastePatch (const Patch& patch, SurfaceMesh& mesh)
{
  for (Index slot = 0; slot < patch.slots.size (); ++slot) {
    const Index t = patch.slots[slot];
    for (std::uint8_t side = 0; side < 3; ++side) {
      mesh.triangles[t][side] = patch.points[patch.mesh.triangles[slot][side]];
      mesh.triangle_of[mesh.triangles[t][side]] = t;
      const Index inner = patch.mesh.neighbors[slot][side];
      mesh.neighbors[t][side] = inner == NONE ? NONE : patch.slots[inner];
      if (inner != NONE)
        continue;
      const Patch::RimEdge* edge =
          rimEdge (patch, patch.mesh.from ({slot, side}), patch.mesh.to ({slot, side}));
      if (edge == nullptr)
        continue;
      mesh.neighbors[t][side] = edge->outside.triangle;
      mesh.neighbors[edge->outside.triangle][edge->outside.side] = t;
    }
  }
}

bool
joinedOutside (const Patch& patch, const SurfaceMesh& whole, Index p, Index q)
{
  std::vector<Index> fan_triangles;
  whole.fan (patch.points[p], fan_triangles);
  for (Index t : fan_triangles) {
    if (placeOf (patch.slots, t) != NONE)
      continue;
    for (Index corner : whole.triangles[t])
      if (corner == patch.points[q])
        return true;
  }
  return false;
}

} // namespace floater
} // namespace pcl
