// SPDX-License-Identifier: GPL-3.0-or-later
// Choices of a reconstruction. One line each: default, meaning, unit.
#pragma once

#include <pcl_floater/export.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace pcl
{
namespace floater
{
/// What surface the points are taken for, and so which method makes the mesh.
enum class Topology
{
  AUTO,   ///< as the points tell: one disc by whichever method does it better, else SURFACE
  DISC,   ///< one component with one boundary, closing all holes: the method of TW 385
  SURFACE ///< any number of components, boundary loops and handles: triangles that stars agree on
};

/// Which holes of a surface stay open. A disc has one boundary loop and no holes.
enum class HolePolicy
{
  AUTO,         ///< those where the sampling ends, as far as the points tell
  CLOSE_ALL,    ///< none: every component is closed
  KEEP_LARGEST, ///< the largest loop of every component, as its boundary
  KEEP_COUNT,   ///< the Options::kept_loops largest loops of the whole surface
  BY_SIZE       ///< those wider than Options::largest_hole or largest_hole_length
};

/// How the boundary points become one ordered loop.
enum class BoundaryMethod
{
  SPANNING_TREE, ///< longest path of a spanning tree over points whose star has a gap
  CONSENSUS,     ///< largest rim of the triangles that stars agree on
  TWO_SEGMENTS   ///< TW 385, section 3: largest cluster, two segments, 1D parameterization
};

/// Which points a point is a convex combination of (TW 385, section 2.1 and Figure 1(b)).
enum class Neighborhood
{
  NEAREST_DELAUNAY, ///< Delaunay star among the k nearest
  NEAREST,          ///< the k nearest
  BALL_DELAUNAY,    ///< Delaunay star among the points in a ball
  BALL              ///< the points in a ball whose radius follows the local density (section 6)
};

/// Convex curve on which the boundary loop is laid (TW 385, section 2.1).
enum class Domain
{
  CIRCLE,   ///< unit circle
  SQUARE,   ///< square inscribed in the unit circle
  POLYGON,  ///< regular polygon with Options::polygon_sides sides, inscribed in the unit circle
  OWN_SHAPE ///< convex hull of the loop projected on its least-squares plane
};

/// How the points of the loop share the curve that they are laid on.
enum class LoopSpacing
{
  CHORD_LENGTH, ///< steps as their lengths in space
  CENTRIPETAL,  ///< steps as the square roots of these
  UNIFORM       ///< equal steps
};

/// Weights lambda_ij of a point in its neighbours (TW 385, section 4.1).
enum class Weighting
{
  UNIFORM,          ///< 1 / number of neighbours
  INVERSE_DISTANCE, ///< 1 / |p_j - p_i|
  SHAPE_PRESERVING, ///< Floater 1997
  MEAN_VALUE        ///< Floater 2003, equation (2) of TW 385
};

/// What solves the linear system (TW 385, section 4.2).
enum class Solver
{
  UMFPACK,             ///< direct; symmetric strategy
  UMFPACK_UNSYMMETRIC, ///< direct; unsymmetric strategy
  SUPERLU,             ///< direct; only if built with SuperLU
  EIGEN_SPARSE_LU,     ///< direct
  BICGSTAB_ILUT,       ///< iterative, preconditioned by an incomplete factorization
  GAUSS_SEIDEL         ///< iterative; stalls on all but small clouds
};

/// Order of the unknowns. Every solver takes every symmetric one, which keeps the diagonal where it
/// is. COLAMD orders columns alone: only UMFPACK_UNSYMMETRIC, SUPERLU and EIGEN_SPARSE_LU take it.
enum class Ordering
{
  AUTOMATIC, ///< UMFPACK: AMD up to 100,000 unknowns, above nested dissection by where the points
             ///< are; SUPERLU: minimum degree; UMFPACK_UNSYMMETRIC and EIGEN_SPARSE_LU: COLAMD;
             ///< iterative solvers: NATURAL
  AMD,       ///< approximate minimum degree
  METIS,     ///< nested dissection
  COLAMD,    ///< column approximate minimum degree
  REVERSE_CUTHILL_MCKEE, ///< small bandwidth
  NATURAL                ///< as the points are stored: along a space-filling curve
};

/// The stages of a run, in order; a name for each is given by stageName().
enum class Stage
{
  WORKING_SET,
  NEIGHBORS,
  STARS,
  CONSENSUS,
  BOUNDARY,
  WEIGHTS,
  SOLVE,
  DELAUNAY,
  HOLES,
  FLIPS,
  CHECK,
  COUNT ///< not a stage: how many there are
};

/// Short English name of a stage ("neighbors"), also the key in reports.
PCL_FLOATER_EXPORT const char*
stageName (Stage stage);

/// Neighbours of each point.
struct NeighborOptions
{
  Neighborhood kind = Neighborhood::NEAREST_DELAUNAY;
  int k = 20;                ///< 20: nearest neighbours of each point, 6 to 200; not for balls
  double ball_radius = 2.25; ///< 2.25: of balls, in mean distances to the 6 nearest; 1 to 10
};

/// Holes of a surface. A disc takes the policies AUTO and KEEP_LARGEST only.
struct HoleOptions
{
  HolePolicy policy = HolePolicy::AUTO;
  int kept_loops = 1;        ///< 1: KEEP_COUNT: loops that stay open, 0 or more
  double largest_hole = 0.0; ///< 0: BY_SIZE: widest hole to close, local spacings; 0: any width
  double largest_hole_length = 0.0; ///< 0: BY_SIZE: the same in units of the cloud
};

/// The boundary loop of a disc.
struct BoundaryOptions
{
  BoundaryMethod method = BoundaryMethod::SPANNING_TREE;
  double opening_angle = 160.0; ///< 160: degrees; TWO_SEGMENTS: a boundary point has a wider sector
                                ///< without neighbours; above 0, below 360
  double cluster_tolerance = 0.05; ///< 0.05: TWO_SEGMENTS: growing distance, fraction of the
                                   ///< bounding box diagonal; above 0, at most 1
  int cluster_k = 10; ///< 10: TWO_SEGMENTS: boundary points appended at a time, 1 or more

  /// The loop as cloud indices in order, which makes the surface a disc; empty: find it.
  std::vector<std::uint32_t> loop;
};

/// Where the boundary loop of a disc is laid in the plane.
struct DomainOptions
{
  Domain curve = Domain::CIRCLE;
  int polygon_sides = 6; ///< 6: sides of Domain::POLYGON, 3 or more
  LoopSpacing loop_spacing = LoopSpacing::CHORD_LENGTH;
};

/// How the linear system of a disc is solved.
struct SolverOptions
{
  Solver method = Solver::UMFPACK;
  Ordering ordering = Ordering::AUTOMATIC;
  double tolerance = 1e-15;  ///< 1e-15: iterative solvers stop at |b - A u| / |b|, above 0, below 1
  int max_iterations = 1000; ///< 1000: of an iterative solver for each coordinate, 1 or more
  int ilut_fill = 15;        ///< 15: BICGSTAB_ILUT: entries kept in a row of L and of U, 1 or more
  double ilut_drop = 1e-2;   ///< 1e-2: BICGSTAB_ILUT: entries dropped, share of their row, 0 to 1
};

/// All parameters of a run. The defaults need no tuning; a run never changes them.
struct Options
{
  Topology topology = Topology::AUTO;
  NeighborOptions neighbors;
  HoleOptions holes;
  BoundaryOptions boundary;
  DomainOptions domain;
  Weighting weighting = Weighting::MEAN_VALUE;
  SolverOptions solver;
  bool remove_outliers = true; ///< true: leave out points that lie off any surface
  bool denoise = true; ///< true: where noise is strong, connect points as they lie in local planes
  bool filter_sheets = true; ///< true: drop neighbours that lie on another sheet of the surface
  bool flip_edges = true;    ///< true: Delaunay flips on the surface after lifting
  int blocks = 0;  ///< 0: blocks in which nearest neighbours are searched, 0 to choose; does not
                   ///< change the result
  int threads = 0; ///< 0: number of threads, 0 for all cores; does not change the result

  /// Called when a stage begins, from the thread that runs the reconstruction.
  std::function<void (Stage)> stage_callback;

  /// Called with the fraction of the run that is done, 0 to 1 and never less than before, when a
  /// stage begins and up to 20 times a second within it, and with 1 at the end. It is estimated
  /// from the times of typical runs. The solver of the linear system is one step. Same thread as
  /// stage_callback.
  std::function<void (double)> progress_callback;

  /// Asked as often; true cancels the run: Status::CANCELLED, no mesh, and all memory is freed.
  /// Mostly within a tenth of a second; direct solvers, CGAL's triangulation and a search of the
  /// caller's are not interrupted, but the run ends when they return. Same thread as
  /// stage_callback.
  std::function<bool ()> cancelled_callback;
};

} // namespace floater
} // namespace pcl
