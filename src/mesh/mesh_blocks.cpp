// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_blocks.h"

#include "core/parallel.h"

#include <algorithm>

namespace pcl::floater {
namespace {
constexpr int SMALLEST_SHIFT = 12, LARGEST_SHIFT = 16; // 4,096 and 65,536 points
constexpr std::size_t BLOCKS = 16;

// The smallest power of two that makes at most BLOCKS blocks, within these bounds.
int
shiftFor (std::size_t points)
{
  int shift = SMALLEST_SHIFT;
  while (shift < LARGEST_SHIFT && (points - 1) >> shift >= BLOCKS)
    ++shift;
  return shift;
}
} // namespace

MeshBlocks::MeshBlocks (const TriangleMesh& mesh, const RunContext& run)
{
  const std::size_t points = mesh.triangle_of.size ();
  if (points == 0)
    return;
  shift_ = shiftFor (points);
  const std::size_t blocks = ((points - 1) >> shift_) + 1;
  is_partial_.assign (points, 0);
  slot_of_.assign (mesh.triangles.size (), NONE);
  run.poll ();
  triangles_ = makeCsrLists (blocks, [&] (const auto& emit) {
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      if (areInOneBlock (mesh.triangles[t]))
        emit (mesh.triangles[t][0] >> shift_, t);
  });
  parallelTasks (run, blocks, [this] (std::size_t b) {
    const Row block = triangles_.row (b);
    for (Index i = 0; i < block.size (); ++i)
      slot_of_[block[i]] = i;
  });
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (slot_of_[t] == NONE)
      for (const Index p : mesh.triangles[t])
        is_partial_[p] = 1;
}

bool
MeshBlocks::hasAllNeighbors (const TriangleMesh& mesh, Index t, Row block) const
{
  const std::array<Index, 3>& around = mesh.neighbors[t];
  return std::all_of (around.begin (), around.end (),
                      [&] (Index u) { return u == NONE || inBlock (u, block) != NONE; });
}

bool
MeshBlocks::isFree (const TriangleMesh& mesh, Index t) const
{
  return slot_of_[t] != NONE &&
         hasAllNeighbors (mesh, t, triangles_.row (mesh.triangles[t][0] >> shift_));
}

MeshBlock
MeshBlocks::cutOut (const TriangleMesh& mesh, std::size_t block) const
{
  MeshBlock part;
  part.first = first (block);
  const Index points = last (block) - part.first;
  const Row ids = triangles_.row (block);
  part.mesh.triangles.resize (ids.size ());
  part.mesh.neighbors.resize (ids.size ());
  part.mesh.triangle_of.assign (points, NONE);
  part.mesh.is_fixed.resize (ids.size ());
  part.mesh.is_partial.assign (is_partial_.begin () + part.first,
                               is_partial_.begin () + part.first + points);
  for (Index i = 0; i < ids.size (); ++i) {
    const Index t = ids[i];
    for (std::uint8_t corner = 0; corner < 3; ++corner) {
      const Index p = mesh.triangles[t][corner] - part.first;
      part.mesh.triangles[i][corner] = p;
      part.mesh.triangle_of[p] = i;
      part.mesh.neighbors[i][corner] = inBlock (mesh.neighbors[t][corner], ids);
    }
    part.mesh.is_fixed[i] = hasAllNeighbors (mesh, t, ids) ? 0 : 1;
  }
  return part;
}

void
MeshBlocks::putBack (const MeshBlock& part, std::size_t block, TriangleMesh& mesh) const
{
  const Row ids = triangles_.row (block);
  for (Index i = 0; i < ids.size (); ++i) {
    const bool is_fixed = part.mesh.is_fixed[i] != 0;
    for (std::uint8_t corner = 0; corner < 3; ++corner) {
      mesh.triangles[ids[i]][corner] = part.first + part.mesh.triangles[i][corner];
      const Index neighbor = part.mesh.neighbors[i][corner];
      if (neighbor != NONE)
        mesh.neighbors[ids[i]][corner] = ids[neighbor];
      else if (!is_fixed) // otherwise unchanged: at the boundary, or in no block
        mesh.neighbors[ids[i]][corner] = NONE;
    }
  }
  for (Index p = 0; p < part.mesh.triangle_of.size (); ++p)
    if (part.mesh.triangle_of[p] != NONE)
      mesh.triangle_of[part.first + p] = ids[part.mesh.triangle_of[p]];
}

} // namespace pcl::floater
