// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_spacing.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

#include <algorithm>
#include <iterator>

namespace pcl::floater {
std::vector<float>
spacingOfMesh (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const RunContext& run)
{
  std::vector<float> spacing (positions.size (), 0.0F);
  parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Index> fan;
    std::vector<float> lengths;
    for (auto p = static_cast<Index> (first); p < last; ++p) {
      if (mesh.triangle_of[p] == NONE)
        continue;
      mesh.fan (p, fan);
      lengths.clear ();
      const auto add = [&] (Index q) {
        lengths.push_back (static_cast<float> ((positions[q] - positions[p]).norm ()));
      };
      for (const Index t : fan)
        add (mesh.triangles[t][TriangleMesh::next (mesh.sideOf (t, p))]);
      add (mesh.triangles[fan.back ()][TriangleMesh::previous (mesh.sideOf (fan.back (), p))]);
      spacing[p] = median (lengths);
    }
  });
  std::vector<float> known;
  std::copy_if (spacing.begin (), spacing.end (), std::back_inserter (known),
                [] (float value) { return value > 0.0F; });
  if (!known.empty ())
    std::replace (spacing.begin (), spacing.end (), 0.0F, median (known));
  return spacing;
}

} // namespace pcl::floater
