// SPDX-License-Identifier: GPL-3.0-or-later
#include "blocks/block_surface.h"

#include "blocks/block_neighbors.h"
#include "neighborhoods/mean_normals.h"
#include "neighborhoods/stars.h"
#include "neighborhoods/tangent_planes.h"

#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// Keeps the entries of own points.
template <typename Value>
void
keepOwn (const PointBlock& block, std::vector<Value>& values)
{
  values.erase (values.begin () + block.last, values.end ());
  values.erase (values.begin (), values.begin () + block.first);
}

template <typename Element>
void
renumber (const PointBlock& block, std::vector<Element>& triangles)
{
  for (Element& triangle : triangles)
    for (Index& corner : triangle.corners)
      corner = block.point (corner);
}

// All but the neighbours, from rows where planes, stars, and crease normals are needed.
BlockSurface
findTriangles (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
               const Selection& planes, const Selection& stars, const Selection& corners,
               const Selection& own, bool filter_sheets, int threads)
{
  BlockSurface surface;
  Stars made =
      makeStarsOf (stars, positions, near, fitTangentPlanes (planes, positions, near, threads),
                   filter_sheets, threads);
  surface.crease = creaseNormals (corners, positions, near, made.normals, threads);
  surface.spacing = localSpacing (corners, positions, near, threads);
  surface.candidates =
      findCandidates (own, positions, made, surface.crease, surface.spacing, {}, threads);
  surface.normals = std::move (made.normals);
  return surface;
}

} // namespace

BlockSurface
makeBlockSurface (const PointBlock& block, int k, bool filter_sheets, int threads)
{
  BlockNeighbors neighbors = findBlockNeighbors (block, static_cast<std::size_t> (k), threads);
  BlockSurface surface;
  surface.missing = std::move (neighbors.missing);
  if (!surface.missing.empty ())
    return surface;
  const FlatLists& near = neighbors.near;
  surface = findTriangles (block.positions, near, Selection::of (neighbors.found),
                           Selection::of (neighbors.stars), Selection::of (neighbors.corners),
                           Selection::range (block.first, block.last), filter_sheets, threads);
  renumber (block, surface.candidates.sure);
  renumber (block, surface.candidates.doubtful);
  surface.near.assign (near.ids.begin () + near.offsets[block.first],
                       near.ids.begin () + near.offsets[block.last]);
  for (Index& point : surface.near)
    point = block.point (point);
  keepOwn (block, surface.normals);
  keepOwn (block, surface.crease);
  keepOwn (block, surface.spacing);
  return surface;
}

BlockSurface
makeWholeSurface (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
                  bool filter_sheets, int threads)
{
  const Selection all = Selection::all (positions.size ());
  return findTriangles (positions, near, all, all, all, all, filter_sheets, threads);
}

} // namespace floater
} // namespace pcl
