// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Interface to the processes that mesh and finish the parts of a cloud.
#pragma once

#include "parts/part_finish.h"
#include "parts/part_rim.h"

#include <numeric>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Data of some points.
struct PointValues
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<float> spacing; ///< local spacing on the mesh
};

/// The work on the parts: in this process, or in others. Results are those of the named functions.
/// Functions that return results are thread-safe.
class PartWork
{
public:
  virtual ~PartWork () = default;

  /// See findRim, on the part's mesh by makePartMesh.
  virtual PartRim rim (std::size_t part, std::size_t rings) = 0;

  /// Finishes all parts, see finishPart. Called once, after all rims.
  /// \param changes of each part
  virtual void finish (std::vector<PartChange> changes, const RunContext& run) = 0;

  /// The finished part, without its inner triangles and their buckets. Called once per part.
  virtual FinishedPart finished (std::size_t part) = 0;

  /// The buckets of the inner triangles of a finished part. Called once per part.
  virtual std::vector<Eigen::AlignedBox3d> buckets (std::size_t part) = 0;

  /// Ranges of triangles, ends excluded.
  using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

  /// Inner triangles of a finished part; corners are points.
  virtual std::vector<Triangle> triangles (std::size_t part, const Ranges& ranges) = 0;

  /// \param points ascending
  virtual PointValues valuesOf (const std::vector<Index>& points) = 0;
};

/// Data of all points of a cloud.
inline PointValues
valuesOfAll (PartWork& work, std::size_t points)
{
  std::vector<Index> all (points);
  std::iota (all.begin (), all.end (), Index{0});
  return work.valuesOf (all);
}

} // namespace pcl::floater
