// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/planes.h"

#include "core/geometry.h"
#include "core/parallel.h"

namespace pcl::floater {
std::vector<float>
localSpacing (const Positions& positions, const CsrLists& neighbors, const RunContext& run)
{
  std::vector<float> spacing (positions.size ());
  parallelPoints (run, spacing.size (), [&] (Index p) {
    spacing[p] = static_cast<float> (spacingOf (positions, p, neighbors.row (p)));
  });
  return spacing;
}

Vector3d
meanNormal (const Positions& positions, const CsrLists& neighbors, const Normals& normals, Index p)
{
  constexpr std::size_t FIRST_RING = 8; // neighbours in the mean: the first ring
  constexpr double PERPENDICULAR = 0.1; // cosine below which its sign is unreliable
  const Vector3d normal = normals[p].cast<double> ();
  Vector3d sum = normal;
  const Row row = neighbors.row (p);
  for (std::size_t i = 0; i < std::min (FIRST_RING, row.size ()); ++i) {
    const Vector3d other = normals[row[i]].cast<double> ();
    double same = normal.dot (other);
    if (std::abs (same) < PERPENDICULAR) {
      // Two faces at a right angle: either both bend towards the other's normal, or both away.
      const Vector3d step = positions[row[i]] - positions[p];
      same = -step.dot (normal) * step.dot (other);
    }
    sum += same < 0.0 ? Vector3d (-other) : other;
  }
  const double length = sum.norm ();
  return length > 0.0 ? Vector3d (sum / length) : normal;
}

} // namespace pcl::floater
