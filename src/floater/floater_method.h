// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The method of TW 385: one disc, laid out in the plane.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "floater/boundary/boundary.h"
#include "floater/solvers/solver.h"
#include "local/stars.h"
#include "mesh/finish.h"

#include <pcl/surface/floater/options.h>

#include <array>
#include <cstddef>
#include <vector>

namespace pcl::floater {
/// Thresholds for the mesh of a disc.
struct DiscLimits
{
  /// Smallest share of all points connected with the boundary loop; below, the cloud counts as
  /// several components (UNREACHABLE). Not derived from data, and not certain.
  double least_reached_share = 0.5;

  /// Maximum number of links of a point that is not connected with the loop. With one link a lone
  /// point would coincide with its neighbour, and with two lie on the line between them; three is
  /// the least number that places it freely in the plane.
  std::size_t links_per_point = 3;

  /// Share of all edges: if more are folded after the flips, the surface is no disc. On 24 clouds,
  /// discs had up to 0.01 and closed surfaces that were laid out as discs 0.04 or more.
  double largest_fold_share = 0.03;
};

/// Parameters of the points in the plane.
struct Parameterization
{
  std::vector<Eigen::Vector2d> uv; ///< per point; NaN if it is not connected with the loop; empty
                                   ///< if there is a problem
  std::size_t relinked = 0;    ///< points that had to be linked to points connected with the loop
  std::size_t unreachable = 0; ///< points not connected with the loop
  std::size_t unknowns = 0;    ///< rows of the linear system
  std::size_t nonzeros = 0;    ///< entries of its matrix
  Solution solution;           ///< figures of the solver; the solution itself is in uv
  Problem problem; ///< UNREACHABLE, SINGULAR, NOT_CONVERGED, SOLVER_UNAVAILABLE, OUT_OF_MEMORY or
                   ///< INTERNAL_ERROR
};

// Connection of the points with the boundary loop, which the linear system needs: for unconnected
// unknowns, UMFPACK may return OK and put them all on the origin.

/// Points with a path to the loop along directed neighbours.
struct Reachability
{
  std::vector<std::uint8_t> reachable; ///< per point; 1 for points of the loop
  /// (point, neighbour): links to add so that `reachable` holds; ascending.
  std::vector<std::array<Index, 2>> links;
  std::size_t linked_points = 0; ///< distinct points in links
};

/// A reverse breadth-first search from the loop over `neighbors`. Then, in rounds until nothing
/// changes: every unreached point with reached ones among its nearest neighbours, or that is among
/// theirs, is linked to the nearest of them (DiscLimits::links_per_point), and the search continues
/// from it. All points at the edge of an unconnected set are linked in one round: with a single
/// link, it would shrink to a point. The rest belongs to another component. O(entries).
/// \param nearest nearest neighbours of each point, not filtered
Reachability
reachLoop (const CsrLists& neighbors, const CsrLists& nearest,
           const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
           const RunContext& run, const DiscLimits& limits = {});

/// Makes weights, lays the loop on a convex curve, and assembles and solves the linear system
/// (TW 385, equations (1) to (3)). Runs through the stages WEIGHTS and SOLVE.
/// \param nearest   nearest neighbours, to which points that are not connected with the loop are
///                  linked
/// \param stars     with their offsets; freed as soon as there are weights
/// \throws std::bad_alloc
Parameterization
parameterize (const std::vector<Eigen::Vector3d>& positions, const CsrLists& nearest, Stars stars,
              const std::vector<Index>& loop, const DiscOptions& options, const RunContext& run,
              const DiscLimits& limits = {});

struct DiscSettings
{
  const Options& options; ///< with as_published: nothing beyond TW 385
  StarSettings stars;     ///< for new stars
  DiscLimits limits{};
  FinishLimits finish{};
  FacingHints facing{};
};

/// The mesh of a disc, or why there is none.
struct Disc
{
  Boundary boundary;
  Parameterization parameterization;
  TriangleMesh mesh;
  MeshFinish finish;
  Problem problem;
};

/// Makes the mesh of a disc from its boundary loop (TW 385, sections 2 and 4). Beyond TW 385:
/// edges are flipped in space, and folds are repaired. Stages WEIGHTS, SOLVE, DELAUNAY and FLIPS.
///
/// On a tube of length L and radius R parameters shrink like exp (-L / R). From an L / R of about 35
/// on, points coincide in the plane; from some 50 on, folds are left.
/// \param geometry its stars, which need their offsets, are consumed, except their normals
/// \param boundary checked (see checkBoundary ())
/// \return with the problem of the boundary or of the parameterization, or NOT_A_DISC if too many edges are folded
Disc
makeDisc (const Points& points, LocalGeometry& geometry, Boundary boundary,
          const DiscSettings& settings, const RunContext& run);

} // namespace pcl::floater
