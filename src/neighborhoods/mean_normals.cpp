// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighborhoods/mean_normals.h"

#include "common/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double PERPENDICULAR = 0.1; // cosine below which it does not tell the side
constexpr double CREASE = 0.9;        // cosine between own and mean normal
} // namespace

Eigen::Vector3d
meanNormal (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
            const std::vector<Eigen::Vector3f>& normals, Index p)
{
  const Eigen::Vector3d normal = normals[p].cast<double> ();
  Eigen::Vector3d sum = normal;
  const Row row = near.row (p);
  for (std::size_t i = 0; i < std::min (MEAN_OVER, row.size ()); ++i) {
    const Eigen::Vector3d other = normals[row[i]].cast<double> ();
    double same = normal.dot (other);
    if (std::abs (same) < PERPENDICULAR) {
      // Two faces at a right angle: each bends away from the other's normal, or both towards it.
      const Eigen::Vector3d step = positions[row[i]] - positions[p];
      same = -step.dot (normal) * step.dot (other);
    }
    sum += same < 0.0 ? Eigen::Vector3d (-other) : other;
  }
  const double length = sum.norm ();
  return length > 0.0 ? Eigen::Vector3d (sum / length) : normal;
}

std::vector<Eigen::Vector3f>
creaseNormals (const Selection& rows, const std::vector<Eigen::Vector3d>& positions,
               const FlatLists& near, const std::vector<Eigen::Vector3f>& normals, int threads)
{
  std::vector<Eigen::Vector3f> crease (normals.size ());
  parallelRanges (rows.size (), threads, [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Index p = rows[i];
      const Eigen::Vector3f mean = meanNormal (positions, near, normals, p).cast<float> ();
      crease[p] = std::abs (mean.dot (normals[p])) < CREASE ? mean : normals[p];
    }
  });
  return crease;
}

} // namespace floater
} // namespace pcl
