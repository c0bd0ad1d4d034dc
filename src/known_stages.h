// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Results of a run that were made before: by other processes, each for a block of the points.
#pragma once

#include "consensus/consensus_mesh.h"
#include "local/local_geometry.h"
#include "options/request.h"
#include "parts/parts_method.h"
#include "points/noise.h"
#include "points/points.h"
#include "view/area_evidence.h"

#include <pcl/surface/floater/reconstruct.h>

#include <memory>
#include <vector>

namespace pcl::floater {
/// Stage results that were computed before. They must equal what reconstruct () would compute; then
/// the mesh is the same. The functions are called in the order of a run.
class KnownStages
{
public:
  virtual ~KnownStages () = default;

  /// The points of takePoints, and what that told the report.
  virtual Points points (Report& report) = 0;

  /// Points that lie off any surface, ascending.
  virtual std::vector<Index> outliers () = 0;

  /// Of points without outliers: the neighbours, with those beside lines. Row i is that of
  /// points[i].
  virtual CsrLists neighborsOf (const std::vector<Index>& points) = 0;

  /// Of all points without outliers: `neighbors`, with those beside lines. The rest is not read.
  virtual LocalPlanes planes () = 0;

  /// See takeAreaSamples.
  virtual std::vector<AreaSample> areaSamples () = 0;

  /// See measureNoise.
  virtual NoiseProbes noiseProbes () = 0;

  /// The geometry around each point.
  /// \param with_stars whether their lists are read
  virtual LocalGeometry geometry (LocalPlanes planes, bool with_stars) = 0;

  /// The spacing of that geometry alone.
  virtual std::vector<float> spacing () = 0;

  /// The parts of a cloud that has several, as they are meshed where that geometry is known.
  /// \param scatter points around which the cloud is flat at no scale, ascending
  virtual std::unique_ptr<PartWork> parts (const std::vector<Index>& scatter,
                                           const PartsSettings& settings) = 0;

  /// The candidates of these stars, of a cloud that is one part.
  virtual ProposedTriangles triangles () = 0;

  /// Takes the mesh of a cloud that has several parts. The result has no triangles then.
  /// \param mesh with cloud indices as corners of its seam
  virtual void keepMesh (MeshOfParts mesh) = 0;
};

/// Reconstructs a surface of which these stages are known.
/// \param input without points: what else is known of the cloud
Result
reconstruct (Input input, const Options& options, const Limits& limits, KnownStages& known);

} // namespace pcl::floater
