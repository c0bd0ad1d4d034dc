// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Joint decisions for all parts: triangles between them, orientation, open and filled loops.
#pragma once

#include "consensus/consensus_method.h"
#include "parts/joined_rims.h"

#include <optional>
#include <vector>

namespace pcl::floater {
/// Changes of a part by the stitching.
struct PartChange
{
  std::vector<Index> dropped;  ///< numbers of removed triangles, ascending
  std::vector<Index> turned;   ///< flipped components, ascending
  std::vector<Triangle> added; ///< with all corners in the part; corners are points
  std::vector<Triangle> seam;  ///< with a corner in the part and another one in another part
  std::vector<Index> beside;   ///< neighbours of points without a triangle in other parts,
                               ///< ascending
};

/// Result of the stitching.
struct Stitching
{
  std::vector<PartChange> parts;
  std::vector<Triangle> seam;             ///< all triangles with corners in several parts
  ClosedHoles holes;                      ///< loops of points
  std::vector<Triangle> orientation_seam; ///< see Surface
};

/// Offers the free candidates of all parts, decides which loops stay open, and fills the others
/// (see extendConsensus, manifoldPart and closeHoles). The result is the same as for the whole
/// mesh: loops are filled only where all triangles are known. O(m log m) for m points in all rims.
/// \param joined rims of all parts; freed after reading
/// \param unit length of one unit of the cloud in the unit of the positions
/// \return nothing if wider rims are needed
std::optional<Stitching>
stitch (JoinedRims joined, const Parts& parts, double unit, const SurfaceSettings& settings,
        const RunContext& run);

} // namespace pcl::floater
