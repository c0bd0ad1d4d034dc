// SPDX-License-Identifier: GPL-3.0-or-later
// Which boundary loops are borders and holes of the surface, and which are mere defects.
#pragma once

#include "core/csr_lists.h"
#include "mesh/boundary_loops.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// What the points of a loop see beyond it.
struct LoopEvidence
{
  double open_share = 0.0; ///< of its points: those with no neighbour on their sheet in a sector of
                           ///< BoundaryLimits::empty_sector degrees or more
  double empty_share =
      0.0; ///< of its points: those with no neighbour on any sheet in such a sector
};

/// When the automatic policy takes a loop for the end of the surface. The angle and the two widths
/// are geometry; the shares and lengths were chosen on the 43 clouds of the first benchmark, and
/// are the least certain numbers of this program: `test/benchmark/limits` tells what hangs on them.
struct BoundaryLimits
{
  double empty_sector = 130.0; ///< degrees: 180 less the bend of a hole that is 6 spacings wide
  double sheet_sine = 0.75;    ///< between a neighbour and a tangent plane; beyond: another sheet
  double sheet_cosine = 0.3;   ///< between normals; below: another sheet (both as for the stars)
  double open = 0.8;           ///< share of points with an empty sector at a true boundary ...
  double wide = 6.0; ///< ... that is as many of its own steps wide: a regular polygon of 19 sides
  double all_open = 0.97; ///< the same share where the loop is small ...
  double small = 4.0;     ///< ... a regular polygon of 13 sides
  double half_open = 0.5; ///< the same share where the loop is long: ragged and noisy borders ...
  double long_border =
      2.0; ///< ... of more points than this times the root of those of its component
  double whole_border =
      1.0; ///< the same; a loop that long is no hole but the border of its component
};

/// Looks at the neighbours of each loop's points. O(points of the loops).
std::vector<LoopEvidence>
findEvidence (const std::vector<BoundaryLoop>& loops, const std::vector<Eigen::Vector3d>& positions,
              const CsrLists& neighbors, const std::vector<Eigen::Vector3f>& normals,
              const BoundaryLimits& limits, const RunContext& run);

/// Decides which loops are kept open. The automatic policy keeps a loop open where four in five
/// points see an empty sector and which is at least 6 of its own steps wide, or long for the size
/// of its component; one of 4 steps where all points do; and a very long one where half of them do.
/// A gap in the sampling is narrower, and where the consensus has a defect there are points on the
/// other side. The policies that count or keep the largest go by the length of the loop along which
/// points see an empty sector.
/// \param evidence         of each loop
/// \param component_points vertices of each component
/// \param unit             length of one unit of the cloud in the unit of the positions
void
chooseOpenLoops (std::vector<BoundaryLoop>& loops, const std::vector<LoopEvidence>& evidence,
                 const std::vector<std::size_t>& component_points, const HoleOptions& holes,
                 double unit, const BoundaryLimits& limits);

} // namespace floater
} // namespace pcl
