// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parts that are processed here, on all threads.
#pragma once

#include "local/local_geometry.h"
#include "parts/parts_method.h"
#include "points/neighbors.h"

#include <vector>

namespace pcl::floater {
/// Meshes the parts in the constructor.
class LocalParts : public PartWork
{
public:
  /// All arguments must outlive this.
  /// \param geometry star lists are freed as soon as possible
  LocalParts (const Points& points, const Parts& parts, LocalGeometry& geometry,
              const PartsSettings& settings, const RunContext& run);

  PartRim rim (std::size_t part, std::size_t rings) override;
  void finish (std::vector<PartChange> changes, const RunContext& run) override;
  FinishedPart finished (std::size_t part) override;
  std::vector<Eigen::AlignedBox3d> buckets (std::size_t part) override
  {
    return std::move (buckets_[part]);
  }
  std::vector<Triangle> triangles (std::size_t part, const Ranges& ranges) override;
  PointValues valuesOf (const std::vector<Index>& points) override;

private:
  PartPoints pointsOf (std::size_t part, const std::vector<Eigen::Vector3d>& positions,
                       const std::vector<float>& spacing) const;

  const Points& points_;
  const Parts& parts_;
  LocalGeometry& geometry_;
  const PartsSettings& settings_;
  std::vector<PartMesh> meshes_;
  NeighborRows neighbors_;
  std::vector<FinishedPart> finished_; // without the members below
  std::vector<std::vector<Triangle>> triangles_;
  std::vector<std::vector<Eigen::AlignedBox3d>> buckets_;
};

} // namespace pcl::floater
