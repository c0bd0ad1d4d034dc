// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The consensus method for a large cloud: the meshes of its parts, stitched together.
#pragma once

#include "consensus/consensus_method.h"
#include "parts/part_finish.h"
#include "parts/part_rim.h"
#include "parts/parts.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Where the parts are meshed and finished: in this process, or in others. All results are those of
/// the functions that are named.
class PartWork
{
public:
  virtual ~PartWork () = default;

  /// See findRim; of the part's mesh by makePartMesh. May be asked for by several threads.
  virtual PartRim rim (std::size_t part, std::size_t rings) = 0;

  /// Finishes all parts, see finishPart. Called once, after all rims.
  /// \param changes of each part
  virtual void finish (std::vector<PartChange> changes, const RunContext& run) = 0;

  /// The finished part. Each is asked for once, in their order.
  virtual FinishedPart finished (std::size_t part) = 0;
};

/// Makes the surface of a cloud that has several parts. Runs through the stages CONSENSUS, HOLES
/// and FLIPS. What is decided for all parts together is where their meshes end: O(n / sqrt (m)) for
/// parts of m points, but for the mesh itself. O(n log n).
/// \param points their positions are read only to face the mesh
Surface
makeSurfaceOfParts (const Points& points, const Parts& parts, PartWork& work,
                    const SurfaceSettings& settings, const PartLimits& limits,
                    const RunContext& run);

} // namespace floater
} // namespace pcl
