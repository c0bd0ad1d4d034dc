// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stage results that were computed before, by other processes, each for a block of the points.
#pragma once

#include "consensus/consensus_mesh.h"
#include "local/local_geometry.h"
#include "options/stage_limits.h"
#include "parts/part_work.h"
#include "points/noise.h"
#include "points/points.h"
#include "view/ray_evidence.h"

#include <pcl/surface/floater/reconstruct.h>

#include <vector>

namespace pcl::floater {
/// Stage results that were computed before. They must equal what reconstruct () would compute; then
/// the mesh is the same. The functions are called in the order of a run.
class KnownStages
{
public:
  virtual ~KnownStages () = default;

  /// The points of takePoints (), which also fills the report.
  virtual Points points (Report& report) = 0;

  /// Points that lie off any surface, ascending.
  virtual std::vector<Index> outliers () = 0;

  /// Neighbours of points without outliers, far neighbours included. Row i belongs to points[i].
  virtual CsrLists neighborsOf (const std::vector<Index>& points) = 0;

  /// Planes of all points without outliers; only `neighbors`, far neighbours included, is read.
  virtual LocalPlanes planes () = 0;

  /// See takeAreaSamples.
  virtual std::vector<AreaSample> areaSamples () = 0;

  /// See measureNoise.
  virtual NoiseProbes noiseProbes () = 0;

  /// The geometry around each point.
  /// \param with_stars whether the star lists are read
  virtual LocalGeometry geometry (LocalPlanes planes, bool with_stars) = 0;

  /// The spacing of geometry ().
  virtual std::vector<float> spacing () = 0;

  /// The normals of the stars.
  virtual std::vector<Eigen::Vector3f> normals () = 0;

  /// What the parts of a large cloud are meshed from.
  /// \param parts must outlive it
  virtual PartSource parts (const Parts& parts) = 0;

  /// The candidates of the stars, for a cloud that is one part.
  virtual ProposedTriangles triangles () = 0;
};

/// Reconstructs a surface from known stages.
/// \param input without points; the rest as usual
Result
reconstruct (Input input, const Options& options, const Limits& limits, KnownStages& known);

} // namespace pcl::floater
