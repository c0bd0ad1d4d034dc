// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is decided of all parts together: triangles between them, orientation, loops kept or closed.
#pragma once

#include "consensus/consensus_method.h"
#include "parts/joined_rims.h"

#include <optional>
#include <vector>

namespace pcl::floater {
/// What the stitching changes in a part.
struct PartChange
{
  std::vector<Index> dropped;  ///< numbers of triangles that are taken out, ascending
  std::vector<Index> turned;   ///< components that are turned round, ascending
  std::vector<Triangle> added; ///< with all corners in the part; corners are points
  std::vector<Triangle> seam;  ///< with a corner in the part and another one in another part
  std::vector<Index> beside;   ///< points that are neighbours of points of other parts that have no
                               ///< triangle, ascending
};

/// What the stitching has found.
struct Stitching
{
  std::vector<PartChange> parts;
  std::vector<Triangle> seam;             ///< all triangles with corners in several parts
  ClosedHoles holes;                      ///< loops of points
  std::vector<Triangle> orientation_seam; ///< see Surface
};

/// Offers the candidates for which there is room in the meshes of all parts, chooses the loops that
/// are kept open, and fills the others (see extendConsensus, manifoldPart and closeHoles). The
/// result is the same as for the whole mesh: loops are filled only where all triangles are known.
/// O(m log m) for m points in all rims.
/// \param rims of all parts; freed as soon as they have been read
/// \param unit length of one unit of the cloud in the unit of the positions
/// \return nothing if more of the parts has to be seen
std::optional<Stitching>
stitch (JoinedRims joined, const Parts& parts, double unit, const SurfaceSettings& settings,
        const RunContext& run);

} // namespace pcl::floater
