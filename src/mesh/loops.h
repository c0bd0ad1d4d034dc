// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary loops: how they are found, measured, and widened, and which stay open.
#pragma once

#include "core/csr_lists.h"
#include "local/star_reach.h"
#include "mesh/triangle_mesh.h"

#include <pcl/surface/floater/options.h>

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

/// Sets length, width and spacing from the points. The width of a loop of up to 256 points is
/// exact. For a longer one, at most 256 points at equal steps along the loop are used: the width is
/// too small by at most two of these steps. O(points).
/// \param spacing local spacing of each point of the mesh
void
measureLoop (BoundaryLoop& loop, const Positions& positions, const std::vector<float>& spacing);

/// All boundary loops of a mesh, measured, in the order of boundaryLoops (). O(n).
std::vector<BoundaryLoop>
findBoundaryLoops (const TriangleMesh& mesh, const MeshComponents& components,
                   const Positions& positions, const std::vector<float>& spacing,
                   const RunContext& run);

/// Thresholds for points with a large empty sector.
struct EmptySectorLimits
{
  double angle = 130.0; ///< degrees; a larger sector without neighbours counts as empty. Theory:
                        ///< 180 minus the bend of a hole that is 6 spacings wide
};

/// Features that separate boundaries of the surface from gaps in the sampling. All but `edge`
/// are dimensionless.
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
  double edge = 0.0;         ///< geometric mean of these edges, in the unit of the positions
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

/// Thresholds and coefficients that separate boundaries from gaps.
///
/// The coefficients belong to a logistic regression: the sum of evidence times coefficient is the
/// logarithm of the odds that the loop is a boundary. They were fitted to loops of generated
/// surfaces: windows of 4 to 40 spacings, borders, and gaps, on ten shapes in thirteen samplings,
/// and on random bodies in four. A gap that stays open counts as four windows that are filled.
struct OpenLoopLimits
{
  EmptySectorLimits sectors;
  double constant = -12.6;
  double points = 2.19;      ///< of the logarithm of the number of points
  double compactness = 12.9; ///< for this and the others see LoopEvidence
  double irregularity = -5.35;
  double growth = -2.06;
  double turning = 1.54;
  double open_points = 0.599; ///< of the root of the number of points times the 4th power of
                              ///< open_share: long loops with hardly a point beyond
  double deepest_gap = 2.46;  ///< of LoopEvidence::depth times open_share, since a loop with points
                              ///< beyond it is not empty. Deeper gaps stay open by the automatic
                              ///< policy. Measured: fewer than 1 in 200 generated gaps from 4
                              ///< spacings on are deeper
  double alike = 0.2;    ///< difference of the logarithms of the widths of loops that are judged
                         ///< together. Of 140 generated plates with windows, 137, 138 and 139
                         ///< are right with 0.1, 0.2 and 0.3, 134 if each is judged by itself
  double certain = 3.0;  ///< absolute log odds from which on loops are certain: 20 to 1
  double doubtful = 0.9; ///< probability; less certain decisions are listed in the report;
                         ///< about one in ten of those is wrong. Chosen by hand
};

/// Whether a decision is reported: it is less certain than OpenLoopLimits::doubtful, or the loop
/// stays open only because it is too deep.
bool
isDoubtful (const LoopJudgement& judgement, const OpenLoopLimits& limits);

/// Judges all measured loops that have points. Uses the mesh three rings into the surface, and the
/// neighbours of the points of each loop. O(n + k log k) for a point of k neighbours, with n for the
/// points of all rings, and O(m^3) for a loop of m points, up to 64.
/// \param mesh      with its loops open
/// \param neighbors of each point of the mesh
/// \param normals   of each point of the mesh, unit length, any sign
/// \return evidence of each loop, in the order of the loops
std::vector<LoopEvidence>
judgeLoops (const TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
            const CsrLists& neighbors, const Normals& normals, const OpenLoopLimits& limits,
            const RunContext& run);

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
judgeTogether (const std::vector<BoundaryLoop*>& loops, const OpenLoopLimits& limits);

/// Decides by the judgements which loops are kept open: sets BoundaryLoop::keep_open.
///
/// The automatic policy keeps likely boundaries, and loops that are too deep to be filled. A
/// requested number of loops is taken from the most likely boundaries on; the largest loop of each
/// component is the longest of its likely boundaries. If likely boundaries run out, both use the
/// length of the loop with no point beyond. O(m log m) for m loops.
/// \param components number of components of the mesh
/// \param unit       length of one unit of the cloud in the unit of the positions
void
chooseOpenLoops (std::vector<BoundaryLoop>& loops, std::size_t components, const HoleOptions& holes,
                 double unit);

/// Which triangles are too large for the sampling around them. No point lies in the circumcircle of
/// a triangle, and the largest such circle depends on how even the sampling is: for Poisson disks
/// its radius is at most the mean edge, among random points about twice that.
///
/// Measured on 300 generated surfaces (see OpenLoopLimits): of windows 4 to 8 spacings wide 76 %
/// stay open instead of 70 %, of narrower ones 39 % instead of 13 %, and no more of 2050 gaps of the
/// sampling than before.
struct HoleWideningLimits
{
  /// A circumradius may reach the mean edge two rings into the surface; or, where the sampling is
  /// uneven, this times that edge, plus `spread` times LoopEvidence::irregularity times it.
  double evenness = 0.4;
  double spread = 4.0;
  std::size_t rings = 3;  ///< of triangles that are removed at most, from the loop on
  double log_odds = 1.39; ///< of a widened loop that stays open, at least; 4 to 1: it is chosen
                          ///< among many for looking open, and a gap that is opened counts as
                          ///< four windows that are filled
};

/// Judges loops, and removes triangles over a hole where a loop that looks like a gap becomes a
/// likely boundary without them; doubtful loops of one width together (see judgeTogether). O(n) plus
/// twice judgeLoops ().
/// \param loops   of the mesh, ascending by their smallest points before
/// \param spacing local spacing of each point
void
widenHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
            const std::vector<float>& spacing, const CsrLists& neighbors, const Normals& normals,
            const OpenLoopLimits& open_loops, const HoleWideningLimits& limits,
            const RunContext& run);

} // namespace pcl::floater
