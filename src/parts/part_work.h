// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where the parts of a cloud are meshed and finished.
#pragma once

#include "parts/part_finish.h"
#include "parts/part_rim.h"

#include <numeric>
#include <utility>
#include <vector>

namespace pcl::floater {
/// What is known of some points.
struct PointValues
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<float> spacing; ///< local spacing on the mesh
};

/// The work on the parts: in this process, or in others. All results are those of the functions
/// that are named. What is not void may be asked for by several threads.
class PartWork
{
public:
  virtual ~PartWork () = default;

  /// See findRim; of the part's mesh by makePartMesh.
  virtual PartRim rim (std::size_t part, std::size_t rings) = 0;

  /// Finishes all parts, see finishPart. Called once, after all rims.
  /// \param changes of each part
  virtual void finish (std::vector<PartChange> changes, const RunContext& run) = 0;

  /// The finished part, without its inner triangles and their buckets. Asked for once.
  virtual FinishedPart finished (std::size_t part) = 0;

  /// The buckets of the inner triangles of a finished part. Asked for once.
  virtual std::vector<Eigen::AlignedBox3d> buckets (std::size_t part) = 0;

  /// From a triangle to before another one.
  using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

  /// Inner triangles of a finished part; corners are points.
  virtual std::vector<Triangle> triangles (std::size_t part, const Ranges& ranges) = 0;

  /// \param points ascending
  virtual PointValues valuesOf (const std::vector<Index>& points) = 0;
};

/// What is known of all points of a cloud.
inline PointValues
valuesOfAll (PartWork& work, std::size_t points)
{
  std::vector<Index> all (points);
  std::iota (all.begin (), all.end (), Index{0});
  return work.valuesOf (all);
}

} // namespace pcl::floater
