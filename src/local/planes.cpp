// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/planes.h"

#include "core/geometry.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl::floater {
std::vector<float>
localSpacing (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const Rows& rows, const RunContext& run)
{
  std::vector<float> spacing (positions.size ());
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      spacing[rows[i]] =
          static_cast<float> (spacingOf (positions, rows[i], neighbors.row (rows[i])));
  });
  return spacing;
}

namespace {
constexpr std::size_t ADDED = 2; // neighbours added at a time, while all are collinear

Eigen::Vector3d
fitNormal (const std::vector<Eigen::Vector3d>& positions, Index p, Row neighbors,
           const PlaneLimits& limits)
{
  PlaneFit core;
  core.add (Eigen::Vector3d::Zero ()); // the point itself
  std::size_t used = 0;
  const auto addUpTo = [&] (std::size_t count) {
    for (; used < std::min (count, neighbors.size ()); ++used)
      core.add (positions[neighbors[used]] - positions[p]);
    return core.plane ();
  };
  Plane plane = addUpTo (limits.core_points);
  while (plane.aspect < limits.least_aspect && used < neighbors.size ())
    plane = addUpTo (used + ADDED);
  const Eigen::Vector3d first = plane.normal;
  PlaneFit sheet;
  sheet.add (Eigen::Vector3d::Zero ());
  for (Index q : neighbors) {
    const Eigen::Vector3d offset = positions[q] - positions[p];
    if (std::abs (first.dot (offset)) <= limits.sheet_sine * offset.norm ())
      sheet.add (offset);
  }
  const bool has_sheet = 2.0 * sheet.weight () > static_cast<double> (limits.core_points);
  return has_sheet ? sheet.plane ().normal : first;
}

} // namespace

std::vector<Eigen::Vector3f>
fitTangentPlanes (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  const Rows& rows, const RunContext& run, const PlaneLimits& limits)
{
  std::vector<Eigen::Vector3f> normals (positions.size (), Eigen::Vector3f::Zero ());
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      normals[rows[i]] =
          fitNormal (positions, rows[i], neighbors.row (rows[i]), limits).cast<float> ();
  });
  return normals;
}

namespace {
constexpr std::size_t FIRST_RING = 8; // neighbours in the mean: the first ring
constexpr double PERPENDICULAR = 0.1; // cosine below which its sign is unreliable
constexpr double EDGE = 0.9; // cosine, 26 degrees, between own and mean normal at a sharp edge
} // namespace

Eigen::Vector3d
meanNormal (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, Index p)
{
  const Eigen::Vector3d normal = normals[p].cast<double> ();
  Eigen::Vector3d sum = normal;
  const Row row = neighbors.row (p);
  for (std::size_t i = 0; i < std::min (FIRST_RING, row.size ()); ++i) {
    const Eigen::Vector3d other = normals[row[i]].cast<double> ();
    double same = normal.dot (other);
    if (std::abs (same) < PERPENDICULAR) {
      // Two faces at a right angle: either both bend towards the other's normal, or both away.
      const Eigen::Vector3d step = positions[row[i]] - positions[p];
      same = -step.dot (normal) * step.dot (other);
    }
    sum += same < 0.0 ? Eigen::Vector3d (-other) : other;
  }
  const double length = sum.norm ();
  return length > 0.0 ? Eigen::Vector3d (sum / length) : normal;
}

std::vector<Eigen::Vector3f>
smoothedNormals (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                 const std::vector<Eigen::Vector3f>& normals, const RunContext& run)
{
  std::vector<Eigen::Vector3f> smoothed (normals.size ());
  parallelRanges (run, normals.size (), [&] (std::size_t first, std::size_t last) {
    for (auto p = static_cast<Index> (first); p < last; ++p) {
      const Eigen::Vector3f mean = meanNormal (positions, neighbors, normals, p).cast<float> ();
      smoothed[p] = std::abs (mean.dot (normals[p])) < EDGE ? mean : normals[p];
    }
  });
  return smoothed;
}

} // namespace pcl::floater
