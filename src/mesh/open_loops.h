// SPDX-License-Identifier: GPL-3.0-or-later
// Which boundary loops are boundaries and holes of the surface, and which are mere defects.
#pragma once

#include "core/csr_lists.h"
#include "mesh/boundary_loops.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// When the automatic policy takes a loop for the end of the surface. The shares and the lengths in
/// roots were chosen on the 43 clouds of the first benchmark. They are not certain.
///
/// A share is one of the points of the loop. A width in steps is divided by the mean edge of the
/// loop: that of a regular polygon of m sides is about m / pi. A length in roots is the number of
/// points of the loop divided by the square root of the number of points of its component; a flat
/// square sheet has 4.
struct OpenLoopLimits
{
  double empty_sector = 130.0; ///< degrees; a larger sector without neighbours counts as empty.
                               ///< Theory: 180 less the bend of a hole that is 6 spacings wide
  double sheet_sine = 0.75;    ///< between a neighbour and a tangent plane; above: another sheet.
                               ///< As for the stars
  double sheet_cosine = 0.3;   ///< between two normals; below: another sheet. As for the stars

  double open_share = 0.8;      ///< with an empty sector, at a loop of wide_steps or whole_roots
  double wide_steps = 6.0;      ///< the width of a regular polygon of 19 sides (theory)
  double whole_roots = 1.0;     ///< a loop as long is no hole but the boundary of its component
  double all_open_share = 0.97; ///< with an empty sector, at a loop of small_steps
  double small_steps = 4.0;     ///< the width of a regular polygon of 13 sides (theory)
  double half_open_share = 0.5; ///< with an empty sector, at a loop of long_roots
  double long_roots = 2.0;      ///< ragged and noisy boundaries are as long
};

/// What the points of a loop see beyond it: shares of these points.
struct LoopEvidence
{
  double open_share = 0.0;  ///< see no neighbour on their own sheet in a sector of
                            ///< OpenLoopLimits::empty_sector degrees or more
  double empty_share = 0.0; ///< see no neighbour on any sheet in such a sector
};

/// Looks at the neighbours of the points of each loop. O(k log k) for a point of k neighbours.
/// \param neighbors of each point of the mesh
/// \param normals   of each point of the mesh, unit length, any sign
/// \return evidence of each loop, in the order of the loops
std::vector<LoopEvidence>
findEvidence (const std::vector<BoundaryLoop>& loops, const std::vector<Eigen::Vector3d>& positions,
              const CsrLists& neighbors, const std::vector<Eigen::Vector3f>& normals,
              const OpenLoopLimits& limits, const RunContext& run);

/// Decides which loops are kept open: sets BoundaryLoop::keep_open.
///
/// The automatic policy keeps a loop open in any of three cases: 80 % of its points see an empty
/// sector, and it is at least 6 steps wide or as long as a whole boundary; 97 % of them do, and it
/// is at least 4 steps wide; or half of them do, and it is very long (see OpenLoopLimits). Gaps in
/// the sampling are narrower, and defects of the consensus have points on their other side. The
/// policies that keep the largest loop or a number of them prefer loops that the automatic policy
/// would keep, then go by the length along which points see an empty sector. O(m log m) for m
/// loops.
/// \param evidence         of each loop
/// \param component_points number of vertices of each component
/// \param unit             length of one unit of the cloud in the unit of the positions
void
chooseOpenLoops (std::vector<BoundaryLoop>& loops, const std::vector<LoopEvidence>& evidence,
                 const std::vector<std::size_t>& component_points, const HoleOptions& holes,
                 double unit, const OpenLoopLimits& limits);

} // namespace floater
} // namespace pcl
