// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/row_evidence.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>

namespace pcl::floater {
RowEvidence
findRows (const Points& points, const NeighborTable& neighbors, std::size_t count,
          const RunContext& run)
{
  constexpr double OPPOSITE = -0.7; // cosine of 135 degrees
  constexpr double STRAIGHT = 0.2;  // noise of 0.3 spacings along the surface has 0.1, faces 0.3
  const std::vector<Eigen::Vector3d>& positions = points.positions;
  const std::size_t step = std::max<std::size_t> (1, positions.size () / count);
  std::size_t looked_at = 0, in_rows = 0;
  Eigen::Matrix3d along = Eigen::Matrix3d::Zero (); // sum of the squares of directions
  std::vector<Index> sample;
  for (std::size_t p = step / 2; p < positions.size (); p += step)
    sample.push_back (static_cast<Index> (p));
  const CsrLists rows_of_sample = neighbors.some (sample);
  for (std::size_t i = 0; i < sample.size (); ++i) {
    run.beginTask (); // each may load memory pages
    const Index p = sample[i];
    const Row row = rows_of_sample.row (i);
    if (row.size () < 2)
      continue;
    const Eigen::Vector3d u = (positions[row[0]] - positions[p]).normalized ();
    const Eigen::Vector3d v = (positions[row[1]] - positions[p]).normalized ();
    ++looked_at;
    if (u.dot (v) >= OPPOSITE)
      continue;
    ++in_rows;
    along += (u - v) * (u - v).transpose ();
  }
  RowEvidence rows;
  if (in_rows == 0)
    return rows;
  rows.share = static_cast<double> (in_rows) / static_cast<double> (looked_at);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes (along);
  rows.across = axes.eigenvectors ().col (0);
  rows.are_straight = axes.eigenvalues ()[1] < STRAIGHT * axes.eigenvalues ()[2];
  return rows;
}

std::vector<RayPatch>
findPointPatches (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  std::size_t count, std::size_t size, const RunContext& run)
{
  std::vector<RayPatch> patches (count);
  std::vector<Index> sorted;
  for (std::size_t k = 0; k < count; ++k) {
    run.beginTask (); // each may load memory pages
    const std::size_t seed = (2 * k + 1) * positions.size () / (2 * count);
    RayPatch& patch = patches[k];
    patch.assign (1, static_cast<Index> (seed));
    sorted = patch;
    for (std::size_t i = 0; i < patch.size () && patch.size () < size; ++i)
      for (const Index q : neighbors.row (patch[i])) {
        const auto place = std::lower_bound (sorted.begin (), sorted.end (), q);
        if (patch.size () == size || (place != sorted.end () && *place == q))
          continue;
        sorted.insert (place, q);
        patch.push_back (q);
      }
    const auto distance = [&] (Index p) { return (positions[p] - positions[seed]).squaredNorm (); };
    std::stable_sort (patch.begin (), patch.end (),
                      [&] (Index a, Index b) { return distance (a) < distance (b); });
  }
  return patches;
}

} // namespace pcl::floater
