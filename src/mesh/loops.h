// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary loops: how they are found, measured, and widened, and which stay open.
#pragma once

#include "local/local_geometry.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Judgement of a boundary loop.
struct LoopJudgement
{
  double log_odds = 0.0; ///< logarithm of the odds that it is a boundary of the surface; above 0 it
                         ///< is more likely a boundary than a gap
  double empty_length = 0.0; ///< length of the loop whose points have no neighbour at all beyond
                             ///< it, in the unit of the positions
  bool is_too_deep = false; ///< the sampling supports no triangles across it, or all fillings cross
                            ///< other sheets

  double probability () const { return 1.0 / (1.0 + std::exp (-log_odds)); }
  bool staysOpen () const { return log_odds > 0.0 || is_too_deep; }
};

/// A closed walk along boundary edges.
struct BoundaryLoop
{
  std::vector<Index> points; ///< in order, the surface on the left, from the smallest point on
  Index component = 0;       ///< of the mesh (see findComponents)
  double length = 0.0;       ///< sum of its edges, in the unit of the positions
  double width = 0.0;        ///< largest distance between two of its points, same unit
  double spacing = 0.0;      ///< mean local spacing of its points, same unit
  LoopJudgement judgement;   ///< see judgeLoops
  bool keep_open = false;    ///< it is a boundary of the surface
};

/// The measured loop of these points. For the width of a loop of more than 256 points, at most 256 at
/// equal steps along it are used: it is too small by at most two of these steps. O(points).
/// \param spacing local spacing of each point of the mesh
BoundaryLoop
measureLoop (std::vector<Index> points, const Positions& positions,
             const std::vector<float>& spacing);

/// All boundary loops of a mesh, measured, in the order of boundaryLoops (). O(n).
std::vector<BoundaryLoop>
findBoundaryLoops (const TriangleMesh& mesh, const MeshComponents& components,
                   const Positions& positions, const std::vector<float>& spacing,
                   const RunContext& run);

/// Features that separate boundaries of the surface from gaps in the sampling. All but `edge`
/// are dimensionless.
struct LoopEvidence
{
  double open_share = 0.0;   ///< share of its points with a sector of 130 degrees or more without
                             ///< neighbours on their own sheet
  double empty_share = 0.0;  ///< share of its points with such a sector without neighbours on any
                             ///< sheet
  double compactness = 0.0;  ///< 4 pi area / length^2: 1 for a circle, near 0 for a slit and for a
                             ///< ragged loop; area in the direction of the area vector
  double irregularity = 0.0; ///< of the sampling around: standard deviation of the logarithms of
                             ///< the edges that begin two rings into the surface
  double edge = 0.0;         ///< geometric mean of these edges, in the unit of the positions
  double growth = 0.0;       ///< of the spacing towards the loop: logarithm of the mean edge at the
                             ///< loop over the mean edge that begins three rings into the surface;
                             ///< 0 if there are none
  double turning = 0.0;      ///< total geodesic curvature in turns, seen from the surface: -1 for a
                             ///< hole in a plane, 0 for the end of a tube, 1 for the border of a
                             ///< disc; limited to -3/2 to 3/2
  /// Where points lie in lines: the distance to the next line over that of points in the loop; less if the
  /// loop interrupts many lines; at least 1.
  double line_distance = 1.0;
  /// The points lie in parallel planes, and the surface seems to end before it meets the next one, as the
  /// top of a sliced body.
  bool is_last_line = false;
  double depth = 0.0; ///< largest height of a triangle in a filling of least area, over the root
                      ///< mean square of the loop's edges, and over line_distance: the largest
                      ///< width of the loop, however long and bent it is; where different spacings
                      ///< meet, relative to the coarse one
};

/// Whether a decision is reported: it is less than 90 % certain (about one in ten of those is wrong),
/// or the loop stays open only because it is too deep.
bool
isDoubtful (const LoopJudgement& judgement);

/// Judges all measured loops that have points. Uses the mesh three rings into the surface, and the
/// neighbours of the points of each loop. O(n + k log k) for a point of k neighbours, with n for the
/// points of all rings, and O(m^3) for a loop of m points, up to 64.
/// \param mesh     with its loops open
/// \param geometry neighbours and normals of each point of the mesh; these have any sign
/// \return evidence of each loop, in the order of the loops
std::vector<LoopEvidence>
judgeLoops (const TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
            const LocalGeometry& geometry, const RunContext& run);

/// Changes the judgements of loops that are not certain by those of the loops of about the same width:
/// a surface has several windows of one size, or many gaps of one sampling. The width is not measured
/// in local spacings, which differ around equal windows by how the points lie at them: of 50 plates
/// with windows and densities of 1 to 30, 50 are right instead of 48. A loop that is certainly a gap
/// by itself follows windows that are certain together: most of its width may be covered by triangles
/// of points across. Of 100 generated grids of profiles, 93 are decided alike, 90 without. The log odds
/// are added and divided by the root of their number, which lies between the mean of equal evidence
/// and the sum of independent one. O(m log m) for m loops.
/// \param loops measured and judged; those without points are left out
void
judgeTogether (const std::vector<BoundaryLoop*>& loops);

/// Decides by the judgements which loops are kept open (see HolePolicy): sets BoundaryLoop::keep_open.
/// Automatically, loops that are too deep to be filled are as well. The largest loop of each component
/// is the longest of its likely boundaries; if these run out, the length of the loop with no point
/// beyond counts, as for a requested number of loops. O(m log m) for m loops.
/// \param unit length of one unit of the cloud in the unit of the positions
void
chooseOpenLoops (std::vector<BoundaryLoop>& loops, const HoleOptions& holes, double unit);

/// Judges loops, and removes triangles over a hole where a loop that looks like a gap becomes a
/// likely boundary without them; doubtful loops of one width together (see judgeTogether). O(n) plus
/// twice judgeLoops ().
/// \param loops    of the mesh, ascending by their smallest points before
/// \param geometry neighbours, normals and spacing of each point of the mesh
void
widenHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
            const LocalGeometry& geometry, const RunContext& run);

} // namespace pcl::floater
