// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Evidence for a boundary loop, from the mesh and the points around.
#pragma once

#include "core/csr_lists.h"
#include "local/sheet.h"
#include "mesh/boundary_loops.h"

#include <vector>

namespace pcl::floater {
/// Thresholds for points with a large empty sector.
struct EmptySectorLimits
{
  double angle = 130.0; ///< degrees; a larger sector without neighbours counts as empty. Theory:
                        ///< 180 minus the bend of a hole that is 6 spacings wide
  SheetLimits sheet;    ///< which neighbours lie on another sheet, as for the stars
};

/// Features that separate boundaries of the surface from gaps in the sampling. All are
/// dimensionless.
struct LoopEvidence
{
  double open_share = 0.0;   ///< share of its points with a sector of EmptySectorLimits::angle or
                             ///< more without neighbours on their own sheet
  double empty_share = 0.0;  ///< share of its points with such a sector without neighbours on any
                             ///< sheet
  double compactness = 0.0;  ///< 4 pi area / length^2: 1 for a circle, near 0 for a slit and for a
                             ///< ragged loop; area in the direction of the area vector
  double irregularity = 0.0; ///< of the sampling around: standard deviation of the logarithms of
                             ///< the edges that begin two rings into the surface
  double growth = 0.0;       ///< of the spacing towards the loop: logarithm of the mean edge at the
                             ///< loop over the mean edge that begins three rings into the surface;
                             ///< 0 if there are none
  double turning = 0.0;      ///< total geodesic curvature in turns, seen from the surface: -1 for a
                             ///< hole in a plane, 0 for the end of a tube, 1 for the border of a
                             ///< disc; limited to -3/2 to 3/2
  double depth = 0.0; ///< largest height of a triangle in a filling of least area, over the root
                      ///< mean square of the loop's edges: the largest width of the loop, however
                      ///< long and bent it is; where different spacings meet, relative to the
                      ///< coarse one
};

/// Uses the mesh three rings into the surface, and the neighbours of the points of each loop. O(n +
/// k log k) for a point of k neighbours, with n for the points of all rings, and O(m^3) for a loop
/// of m points, up to 64.
/// \param mesh      with its loops open
/// \param loops     of the mesh
/// \param neighbors of each point of the mesh
/// \param normals   of each point of the mesh, unit length, any sign
/// \return evidence of each loop, in the order of the loops
std::vector<LoopEvidence>
findEvidence (const TriangleMesh& mesh, const std::vector<BoundaryLoop>& loops,
              const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const std::vector<Eigen::Vector3f>& normals, const EmptySectorLimits& limits,
              const RunContext& run);

} // namespace pcl::floater
