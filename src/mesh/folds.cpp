// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/folds.h"

#include "core/parallel.h"

namespace pcl::floater {
namespace {
// Six times the volume between each component and its middle; positive if it faces outwards.
std::vector<double>
volumesOf (const TriangleMesh& mesh, const MeshComponents& components, const Positions& positions)
{
  std::vector<Vector3d> middle (components.count, Vector3d::Zero ());
  std::vector<double> volume (components.count, 0.0), area (components.count, 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size (); ++i) {
    const Triangle& t = mesh.triangles[i];
    const double own = areaVectorOf (t, positions).norm ();
    middle[components.of_triangle[i]] += own * middleOf (t, positions);
    area[components.of_triangle[i]] += own;
  }
  for (std::size_t i = 0; i < mesh.triangles.size (); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Index c = components.of_triangle[i];
    if (area[c] > 0.0)
      volume[c] +=
          (middleOf (t, positions) - middle[c] / area[c]).dot (areaVectorOf (t, positions));
  }
  return volume;
}
} // namespace

std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const Positions& positions, const RunContext& run,
           AreFolded are_folded)
{
  RangeLists<MeshEdge> folds (mesh.triangles.size ());
  parallelRanges (run, mesh.triangles.size (), [&] (std::size_t first, std::size_t last) {
    for (auto t = static_cast<Index> (first); t < last; ++t) {
      const Vector3d own = areaVectorOf (mesh.triangles[t], positions);
      for (std::uint8_t side = 0; side < 3; ++side)
        if (const Index u = mesh.neighbors[t][side];
            u != NONE && t < u && are_folded (own, areaVectorOf (mesh.triangles[u], positions)))
          folds.of (first).push_back ({t, side});
    }
  });
  return folds.join ();
}

Ridges
findRidges (const TriangleMesh& mesh, const Positions& positions, const CrossingPairs& crossing,
            const Flags& is_remade, const RunContext& run)
{
  Ridges ridges;
  if (std::find (is_remade.begin (), is_remade.end (), 1) == is_remade.end ())
    return ridges;
  const MeshComponents components = findComponents (mesh, run);
  const std::vector<double> volume = volumesOf (mesh, components, positions);
  Flags is_trusted (mesh.triangles.size ());
  for (std::size_t t = 0; t < is_trusted.size (); ++t)
    is_trusted[t] =
        anyCorner (mesh.triangles[t], [&] (Index p) { return is_remade[p] != 0; }) ? 1 : 0;
  for (const CrossingPair& pair : crossing)
    is_trusted[pair.first] = is_trusted[pair.second] = 0;
  for (Index t = 0; t < is_trusted.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const MeshEdge e{t, side}, mate = mesh.mate (e);
      if (mate.triangle == NONE || mate.triangle < t || is_trusted[t] == 0 ||
          is_trusted[mate.triangle] == 0)
        continue;
      const Index a = mesh.from (e), b = mesh.to (e);
      const Vector3d own = areaVectorOf (mesh.triangles[t], positions),
                     other = areaVectorOf (mesh.triangles[mate.triangle], positions);
      const double above = (positions[mesh.corner (mate)] - positions[a]).dot (own);
      if (own.dot (other) < 0.0 && above * volume[components.of_triangle[t]] < 0.0)
        ridges.ends.push_back ({std::min (a, b), std::max (a, b)});
    }
  std::sort (ridges.ends.begin (), ridges.ends.end ());
  return ridges;
}

} // namespace pcl::floater
