// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a cloud, from their candidates to their finished triangles, on all threads.
#pragma once

#include "local/local_geometry.h"
#include "parts/part_finish.h"

#include <functional>
#include <utility>
#include <vector>

namespace pcl::floater {
/// What a part is meshed from.
struct ProposedPart
{
  PartCandidates candidates;
  std::vector<Eigen::Vector3f> smoothed; ///< smoothed normals of its points
};

/// Where that comes from. All functions are thread-safe.
struct PartSource
{
  std::function<ProposedPart (std::size_t part)> propose; ///< called once per part
  std::function<NeighborRows ()> neighbors; ///< rows for one thread; far neighbours included
};

/// The source from the geometry around each point.
/// \param points, parts, geometry must outlive it. Star lists are freed when they are used
PartSource
sourceOf (const Points& points, const Parts& parts, LocalGeometry& geometry,
          const CandidateLimits& limits, const RunContext& run);

/// Data of some points.
struct PointValues
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<float> spacing; ///< local spacing on the mesh
};

/// Meshes the parts in the constructor.
class PartWork
{
public:
  /// \param points, parts, geometry must outlive this
  /// \param geometry spacing, and the normals of the stars
  PartWork (const Points& points, const Parts& parts, LocalGeometry& geometry, PartSource source,
            const ConsensusLimits& limits, const RunContext& run);

  /// See findRim.
  PartRim rim (std::size_t part, std::size_t rings) const;

  /// Finishes all parts, see finishPart. Called once, after all rims.
  /// \param changes of each part
  /// \param facing_normals see PartPoints; nullptr: none
  void finish (std::vector<PartChange> changes, const PartFinishSettings& settings,
               const std::vector<Eigen::Vector3f>* facing_normals, const RunContext& run);

  /// The finished part, without its inner triangles and their buckets. Called once per part.
  FinishedPart finished (std::size_t part) { return std::move (finished_[part]); }

  /// The buckets of the inner triangles of a finished part. Called once per part.
  std::vector<Eigen::AlignedBox3d> buckets (std::size_t part) { return std::move (buckets_[part]); }

  /// Ranges of triangles, ends excluded.
  using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

  /// Inner triangles of a finished part; corners are points.
  std::vector<Triangle> triangles (std::size_t part, const Ranges& ranges) const;

  PointValues valuesOf (const std::vector<Index>& points) const;

private:
  PartPoints pointsOf (std::size_t part, const std::vector<Eigen::Vector3d>& positions,
                       const std::vector<float>& spacing) const;

  const Points& points_;
  const Parts& parts_;
  LocalGeometry& geometry_;
  PartSource source_;
  std::size_t smallest_island_;
  std::vector<PartMesh> meshes_;
  std::vector<FinishedPart> finished_; // without the members below
  std::vector<std::vector<Triangle>> triangles_;
  std::vector<std::vector<Eigen::AlignedBox3d>> buckets_;
};

} // namespace pcl::floater
