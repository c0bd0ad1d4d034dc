// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options of a reconstruction, with their defaults, units and ranges.
//
// Sources:
//   Floater 1997: M. S. Floater, Parametrization and smooth approximation of surface triangulations
//   Floater and Reimers 2001: Meshless parameterization and surface reconstruction
//   Floater 2003: M. S. Floater, Mean value coordinates
//   TW 385: Efficient triangulation of point clouds using Floater parameterization, 2004
#pragma once

#include <pcl_floater/export.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl::floater {
/// The kind of surface. It decides which method makes the mesh.
enum class Topology
{
  AUTO,   ///< DISC if the boundary loop is given, else SURFACE
  DISC,   ///< one component with one boundary loop, laid out in the plane; all holes are closed. If
          ///< the surface is no disc, a run ends with NO_BOUNDARY, NOT_A_DISC or UNREACHABLE
  SURFACE ///< any number of components, boundary loops and handles, by the consensus of the stars
};

/// Which boundary loops of a surface stay open. A disc has one boundary loop and no holes.
enum class HolePolicy
{
  AUTO,         ///< boundaries stay open, gaps in the sampling are filled (both estimated)
  CLOSE_ALL,    ///< none: every component is closed
  KEEP_LARGEST, ///< the largest loop of every component, as its boundary
  KEEP_COUNT,   ///< the HoleOptions::kept_loops most likely boundaries of the whole surface
  BY_SIZE       ///< those wider than HoleOptions::largest_hole
};

/// Unit of a length.
enum class LengthUnit
{
  SPACINGS, ///< local spacings: mean distance of a point to its 6 nearest neighbours
  CLOUD     ///< units of the cloud
};

/// How scatter is treated: regions of a cloud that are no surface at any scale, such as leaves and
/// grass. Scans that are connected as their sensor saw them are not searched for it.
enum class ScatterPolicy
{
  AUTO, ///< what certainly is scatter is left out of a surface; a disc has all points
  KEEP, ///< connected like all other points; the surface there has no meaning
  DROP  ///< left out of the mesh, also what probably is scatter: more leaves, some thin details
};

/// How the boundary loop of a disc is found.
enum class BoundaryMethod
{
  CONSENSUS,   ///< longest boundary loop of the surface on which neighbouring stars agree
  TWO_SEGMENTS ///< TW 385, section 3: largest cluster of boundary points, ordered in two segments
};

/// Neighbours of a point in its convex combination (TW 385, section 2.1 and Figure 1(b)).
enum class Neighborhood
{
  NEAREST_DELAUNAY, ///< the Delaunay star among the k nearest
  NEAREST,          ///< the k nearest
  BALL_DELAUNAY,    ///< the Delaunay star among the points in a ball
  BALL              ///< the points in a ball; its radius follows the local density (section 6)
};

/// Convex curve on which the boundary loop is laid (TW 385, section 2.1).
enum class Domain
{
  CIRCLE, ///< unit circle
  SQUARE, ///< square inscribed in the unit circle
  POLYGON ///< regular polygon with DomainOptions::polygon_sides sides, inscribed in that circle
};

/// Spacing of the points of the loop along the convex curve.
enum class LoopSpacing
{
  CHORD_LENGTH, ///< in proportion to the lengths of the loop's edges
  CENTRIPETAL,  ///< in proportion to the square roots of these lengths
  UNIFORM       ///< evenly
};

/// Weights lambda_ij of a point's neighbours (TW 385, section 4.1).
enum class Weighting
{
  UNIFORM,          ///< 1 / number of neighbours
  INVERSE_DISTANCE, ///< 1 / |p_j - p_i|
  SHAPE_PRESERVING, ///< Floater 1997, section 6
  MEAN_VALUE        ///< Floater 2003; TW 385, equation (2)
};

/// Solver of the linear system (TW 385, section 4.2).
enum class Solver
{
  UMFPACK,      ///< direct; symmetric strategy
  BICGSTAB_ILUT ///< iterative, preconditioned by an incomplete LU factorization
};

/// Order of the unknowns, of rows and columns alike.
enum class Ordering
{
  AUTOMATIC, ///< BICGSTAB_ILUT: NATURAL; UMFPACK: AMD up to 100,000 unknowns, else METIS
  AMD,       ///< approximate minimum degree
  METIS,     ///< nested dissection by METIS
  REVERSE_CUTHILL_MCKEE, ///< small bandwidth
  NATURAL                ///< as the points are stored: along a space-filling curve
};

/// Whether a cloud of one scan is connected as its sensor saw it.
enum class ViewUse
{
  AUTO,  ///< if its rays are evenly spaced from some viewpoint: the origin of the sensor is tried
         ///< first, and by outlines as well; if noise is strong, the viewpoint is searched
  GIVEN, ///< yes, from ViewOptions::viewpoint; every point must be visible from there
  NEVER  ///< no; the mesh does not face the origin of the sensor either
};

/// Which side of a component is the front. Where a rule does not decide, AUTO does, with a warning.
enum class Facing
{
  AUTO,      ///< the first rule that decides: input normals, if used; outwards, if closed; towards
             ///< the sensor of a single scan; into a room; the side more visible from outside; up
  OUTWARDS,  ///< away from the inside; open sheets: the side to which they bulge
  UP,        ///< towards +z; upright ones towards +y, or +x. Closed components face outwards
  VIEWPOINT, ///< towards the position of the sensor, which must be known. Closed components face
             ///< outwards unless the sensor was inside
  NORMALS,   ///< where the normals of the input point to; they must be oriented. Without normals, a
             ///< run ends with RunStatus::INVALID_OPTION
  INWARDS    ///< opposite to OUTWARDS, also if closed: what was seen from within
};

/// The stages of a run, in order. Each method uses some of them.
enum class Stage
{
  WORKING_SET, ///< finite, distinct points in the order of a space-filling curve
  NEIGHBORS,   ///< neighbours of each point; outliers and noise
  STARS,       ///< tangent planes and Delaunay stars
  CONSENSUS,   ///< surface: triangles on which neighbouring stars agree
  BOUNDARY,    ///< disc: boundary loop
  WEIGHTS,     ///< disc: weights of the neighbours
  SOLVE,       ///< disc: linear system
  DELAUNAY,    ///< disc: triangulation of the parameters; scan: of the view
  HOLES,       ///< surface: boundary loops that are filled; scan: gaps and depth steps
  FLIPS,       ///< missing points, edge flips, repair of folds, orientation
  CHECK,       ///< examination of the mesh
  COUNT        ///< the number of stages
};

/// Short English name of a stage ("neighbors"), also its key in JSON reports.
PCL_FLOATER_EXPORT const char*
stageName (Stage stage);

/// Neighbours of each point.
struct NeighborOptions
{
  /// Disc: neighbours in the convex combination of a point. A surface always uses Delaunay stars;
  /// only k nearest or ball matters there.
  Neighborhood kind = Neighborhood::NEAREST_DELAUNAY;
  int k = 20;                ///< k nearest neighbours, 6 to 200; not used for balls
  double ball_radius = 2.25; ///< radius in mean distances of the centre to its 6 nearest points, 1
                             ///< to 10. The default gives about 20 neighbours
};

/// Holes of a surface. A disc takes the policies AUTO and KEEP_LARGEST only.
struct HoleOptions
{
  HolePolicy policy = HolePolicy::AUTO;   ///< which boundary loops stay open
  int kept_loops = 1;                     ///< KEEP_COUNT: loops that stay open, 0 or more
  double largest_hole = 0.0;              ///< BY_SIZE: width of the widest hole to fill, above 0;
                                          ///< no default would do: without it, a run ends with
                                          ///< RunStatus::INVALID_OPTION. Ignored by other policies
  LengthUnit unit = LengthUnit::SPACINGS; ///< BY_SIZE: of largest_hole
};

/// What is cut off the finished mesh; by default, nothing. Cuts leave boundaries, also in a disc.
/// The mesh stays a manifold: at a point with several fans of triangles, only the largest fan is
/// kept. Statistics counts what is cut off, Report::unused has points that lose all their triangles. If
/// nothing is left, the run ends with RunStatus::DEGENERATE.
struct TrimmingOptions
{
  double maximum_edge_length = 0.0; ///< longest edge, in units of the cloud, 0 or more; 0: no limit
  double maximum_edge_ratio = 0.0;  ///< longest edge, in mean local spacings of its two ends, 0 or
                                    ///< more; 0: no limit. Edges of a good mesh are up to about 3
                                    ///< long, and up to 6 where the sampling is uneven
  /// Remove triangles until no two cross each other: the last resort after remove_self_intersections,
  /// for those who simulate, print or trace rays. It leaves holes, mostly of a few triangles.
  bool open_self_intersections = false;
  int minimum_component_size = 0; ///< remove components of fewer points, 0 or more; at the end
};

/// Scans: every point is visible from one viewpoint.
struct ViewOptions
{
  ViewUse use = ViewUse::AUTO;       ///< whether the cloud is connected as its sensor saw it
  std::array<double, 3> viewpoint{}; ///< ViewUse::GIVEN: x, y, z in the frame of the cloud
};

/// The boundary loop of a disc.
struct BoundaryOptions
{
  BoundaryMethod method = BoundaryMethod::CONSENSUS; ///< how the loop is found
  double opening_angle = 160.0; ///< TWO_SEGMENTS: degrees, above 0 and below 360; a boundary point
                                ///< has a wider sector without neighbours
  double cluster_tolerance = 0.05; ///< TWO_SEGMENTS: distance over which clusters grow, as a
                                   ///< fraction of the bounding box diagonal, above 0, at most 1
  int cluster_k = 10;              ///< TWO_SEGMENTS: boundary points that a cluster takes in at a
                                   ///< time, 1 or more

  /// Empty: the loop is found. Otherwise cloud indices in order along the loop, 3 or more, each
  /// once; the surface is then made as a disc.
  std::vector<std::uint32_t> loop;
};

/// Where the boundary loop of a disc is laid in the plane.
struct DomainOptions
{
  Domain curve = Domain::CIRCLE;                        ///< convex curve that the loop is laid on
  int polygon_sides = 6;                                ///< sides of Domain::POLYGON, 3 or more
  LoopSpacing loop_spacing = LoopSpacing::CHORD_LENGTH; ///< spacing of the points along the curve
};

/// How the linear system of a disc is solved.
struct SolverOptions
{
  Solver method = Solver::UMFPACK;         ///< direct or iterative
  Ordering ordering = Ordering::AUTOMATIC; ///< of the unknowns
  double tolerance = 1e-15;  ///< BICGSTAB_ILUT: |b - A u| / |b| at which it stops, above 0, below 1
  int max_iterations = 1000; ///< BICGSTAB_ILUT: at most so many for each coordinate, 1 or more
  int ilut_fill = 15;        ///< BICGSTAB_ILUT: entries kept in a row of L and of U, 1 to 10,000
  double ilut_drop = 1e-2;   ///< BICGSTAB_ILUT: entries below this fraction of their row are
                             ///< dropped, 0 to 1
};

/// Options of discs only: the boundary loop, and the parameterization in the plane.
struct DiscOptions
{
  BoundaryOptions boundary;                    ///< the boundary loop, given or how it is found
  DomainOptions domain;                        ///< where the loop is laid
  Weighting weighting = Weighting::MEAN_VALUE; ///< of the neighbours of a point
  SolverOptions solver;                        ///< of the linear system

  /// Exactly the method of TW 385. The surface is made as a disc, also for Topology::AUTO. All
  /// extensions are off, whatever their options are: outliers, noise, the filter of sheets, edge
  /// flips, the repair of folds and crossings, and the insertion of points without a triangle. Not
  /// with Topology::SURFACE.
  bool as_published = false;

  /// The options of TW 385: boundary points by an opening angle of 160 degrees (section 3.1), their
  /// largest cluster (3.2), ordered in two segments (3.3), laid on a circle (2.1); mean value
  /// weights in Delaunay neighbourhoods (4.1, equation (2)), UMFPACK with the ordering AMD (4.2);
  /// and as_published. Its 20 nearest neighbours (section 5) are the default of NeighborOptions.
  PCL_FLOATER_EXPORT static DiscOptions tw385 ();
};

/// All options of a run. The defaults need no tuning, and a run never changes them.
struct Options
{
  Topology topology = Topology::AUTO; ///< kind of surface
  NeighborOptions neighbors;          ///< neighbours of each point
  HoleOptions holes;                  ///< which boundary loops stay open
  TrimmingOptions trimming;           ///< what is cut off the finished mesh
  ViewOptions view;                   ///< not for discs
  Facing facing = Facing::AUTO;       ///< which side of the mesh is its front
  DiscOptions disc;                   ///< options of the disc method; ignored by other methods
  bool remove_outliers = true;        ///< leave out points that lie off any surface
  ScatterPolicy scatter = ScatterPolicy::AUTO; ///< points on no surface, such as leaves
  bool denoise = true;       ///< where noise is strong, connect the points by their projections on
                             ///< local planes; the vertices are not moved
  bool filter_sheets = true; ///< drop neighbours that lie on another sheet of the surface
  bool flip_edges = true;    ///< flip edges in space towards Delaunay, and repair folds
  bool remove_self_intersections = true; ///< change the mesh where its triangles cross each other;
                                         ///< needs flip_edges. Not for scans that are connected as
                                         ///< their sensor saw them, nor where points were projected
  int threads = 0; ///< 0 or more; 0: one for each core. Does not change the result

  /// Called when a stage begins, by the thread that called reconstruct (). An exception from it, or
  /// from the others, ends the run with RunStatus::INTERNAL_ERROR.
  std::function<void (Stage)> stage_callback;

  /// Called with the fraction of the run that is done, from 0 to 1 and never decreasing: when a
  /// stage begins, up to 20 times a second within it, and with 1 at the end; more seldom if it and
  /// cancelled_callback are slow, so that they take about a tenth of the run. The fraction is
  /// estimated from the times of typical runs; it does not move while a linear system is solved.
  /// Called by the same thread as stage_callback.
  std::function<void (double)> progress_callback;

  /// Polled as often as progress_callback, by the same thread. If it returns true, the run ends
  /// with RunStatus::CANCELLED and without a mesh, mostly within a tenth of a second. Direct
  /// solvers, CGAL's triangulation and the caller's search are not interrupted; the run ends when
  /// they return. It may read an atomic variable that another thread sets.
  std::function<bool ()> cancelled_callback;
};

} // namespace pcl::floater
