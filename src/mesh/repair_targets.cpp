// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair_targets.h"

#include "core/geometry.h"
#include "core/parallel.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// Counts marked points in patches along the space-filling curve.
class PatchCounter
{
public:
  PatchCounter (const std::vector<std::uint8_t>& is_marked, std::size_t patch_points)
      : patch_points_ (patch_points), before_ (is_marked.size () + 1, 0)
  {
    for (std::size_t v = 0; v < is_marked.size (); ++v)
      before_[v + 1] = before_[v] + is_marked[v];
  }

  // Whether most points of the patch around a point are marked.
  bool areMost (Index v) const
  {
    const std::size_t half = patch_points_ / 2;
    const std::size_t first = v > half ? v - half : 0;
    const std::size_t last = std::min (first + patch_points_, before_.size () - 1);
    return std::size_t{2} * (before_[last] - before_[first]) > last - first;
  }

private:
  std::size_t patch_points_;
  std::vector<Index> before_; // number of marked points before each one
};

// Of each triangle: 1 if it is bad.
std::vector<std::uint8_t>
findBadTriangles (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                  const TriangleCost& cost, const RunContext& run)
{
  std::vector<std::uint8_t> is_bad (mesh.triangles.size ());
  parallelRanges (run, is_bad.size (), [&] (std::size_t first, std::size_t last) {
    for (auto t = static_cast<Index> (first); t < last; ++t) {
      const bool is = isBad (mesh, cost, t, [&] (Index u) -> Eigen::Vector3d {
        const auto [a, b, c] = mesh.triangles[u];
        return areaVector (positions[a], positions[b], positions[c]);
      });
      is_bad[t] = is ? 1 : 0;
    }
  });
  return is_bad;
}
} // namespace

std::vector<RepairTarget>
findRepairTargets (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                   const std::vector<Index>& scatter, const TriangleCost& cost,
                   std::size_t patch_points, const RunContext& run)
{
  const std::size_t points = mesh.triangle_of.size ();
  std::vector<std::uint8_t> is_corner (points, 0), is_scatter (points, 0);
  const std::vector<std::uint8_t> is_bad = findBadTriangles (mesh, positions, cost, run);
  for (Index t = 0; t < is_bad.size (); ++t)
    if (is_bad[t] != 0)
      for (const Index v : mesh.triangles[t])
        is_corner[v] = 1;
  for (const Index v : scatter)
    is_scatter[v] = 1;
  const PatchCounter corners (is_corner, patch_points), scattered (is_scatter, patch_points);
  std::vector<RepairTarget> targets (points, RepairTarget::NOTHING);
  for (Index v = 0; v < points; ++v)
    if (!scatter.empty () && scattered.areMost (v))
      targets[v] = RepairTarget::LEFT;
    else if (is_corner[v] != 0)
      targets[v] = corners.areMost (v) ? RepairTarget::SCATTERED : RepairTarget::BAD;
  return targets;
}

} // namespace pcl::floater
