// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The report on a run.
#pragma once

#include <pcl/surface/floater/options.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Outcome of a run. Unless it is SUCCESS, the mesh is empty and a message names the cause.
enum class RunStatus
{
  NOT_RUN,         ///< reconstruct () has not been called
  SUCCESS,         ///< a mesh was made; see Report::warnings
  NO_INPUT,        ///< null or empty input cloud
  INVALID_OPTION,  ///< an option is out of range or without use, or no triangle is visible from the
                   ///< given viewpoint
  INVALID_INDICES, ///< an index is outside the cloud, or the arrays of Input are inconsistent
  TOO_FEW_POINTS,  ///< fewer than 4 distinct finite points
  DEGENERATE,      ///< points on one line or in no triangle, or too far away for double precision;
                   ///< or every triangle was cut off (see TrimmingOptions)
  NO_BOUNDARY,     ///< disc: no boundary loop was found; the surface is closed or not one disc
  INVALID_LOOP,    ///< disc: the given loop is too short, repeats a point or names an unusable one
  UNREACHABLE,     ///< disc: most points are not connected to the boundary loop
  NOT_A_DISC,      ///< disc: the surface has handles or several components, or is closed
  SINGULAR,        ///< disc: the linear system has no unique solution
  NOT_CONVERGED,   ///< disc: an iterative solver did not reach its tolerance
  CANCELLED,       ///< Options::cancelled_callback returned true
  OUT_OF_MEMORY,   ///< an allocation failed, or a table outgrew its 32-bit indices
  INTERNAL_ERROR   ///< the mesh did not pass the final check; please report it
};

/// Short name of a status in upper case ("NO_BOUNDARY").
PCL_FLOATER_EXPORT const char*
statusName (RunStatus status);

/// A boundary loop of the mesh.
struct LoopSummary
{
  std::size_t points = 0;      ///< number of points
  double length = 0.0;         ///< sum of its edge lengths, in units of the cloud; finite
  double width = 0.0;          ///< largest distance between two of its points, same unit
  double width_spacings = 0.0; ///< width in local spacings
  std::uint32_t at = 0;        ///< smallest cloud index of its points
};

/// An uncertain decision: whether a boundary loop of the first mesh is a boundary of the surface and
/// stays open, or a gap in the sampling and is filled. The hole policy may overrule the probability.
struct LoopDecision : LoopSummary
{
  bool stays_open = false;  ///< else it was filled
  double probability = 0.0; ///< that it is a boundary of the surface, 0 to 1
  bool is_too_deep = false; ///< too deep to be filled: the points around it do not determine the
                            ///< surface inside, or triangles across would cross other sheets
};

/// Why a part of the mesh faces as it does.
enum class FacingRule
{
  CLOSED,  ///< it encloses a volume, and faces away from it
  HOLLOW,  ///< it is the wall of a hollow within another part, and faces into it
  SENSOR,  ///< the sensor saw it, and it faces the sensor
  BODY,    ///< one side is more visible from outside, and is the front
  SHEET,   ///< both sides are equally visible: it faces up
  NORMALS, ///< most of the normals of the input point to the front
  UP,      ///< it faces up, as requested
  BULGE, ///< both sides are equally visible; it stands, or OUTWARDS was requested: the front is the
         ///< side to which it bulges
  ROOM,  ///< floor, ceiling and walls with openings: it faces the people in it
  COUNT  ///< the number of rules
};

/// Short name of a rule in lower case ("body").
PCL_FLOATER_EXPORT const char*
facingRuleName (FacingRule rule);

/// A group of components with an uncertain front: one, or several that continue each other.
struct FacingDecision
{
  std::size_t triangles = 0;           ///< number of triangles
  std::uint32_t at = 0;                ///< cloud index of one of its points
  FacingRule rule = FacingRule::SHEET; ///< rule that turned it
  double certainty = 0.0; ///< confidence in the rule: 0.5 (another rule fits as well) to 1. For
                          ///< NORMALS: share of the area whose normals point to the front
};

/// What a run has found out about a cloud or its mesh and a user should know. The sentence of each is in
/// Report::warnings, and in doc/troubleshooting.md.
enum class FindingId
{
  COINCIDENT_POINTS,    ///< many points coincide
  INVALID_PIXELS,       ///< points left out: many at one place, such as (0, 0, 0), as no return
  INVALID_CELLS,        ///< points left out: heights that stand for no data, such as -9999
  GROSS_OUTLIERS,       ///< points left out: over a thousand times as far away as all others
  OUTLIERS,             ///< points left out: off any surface
  STACKED_POINTS,       ///< points lie on one another, and came into the mesh after the others
  SCATTER,              ///< points left out: on no surface at any scale, such as leaves
  NOISE,                ///< points are noisy, and were connected by their places on local planes
  COORDINATES_IN_FLOAT, ///< coordinates are coarse: stored in 32 bits far from the origin
  COORDINATES_ROUNDED,  ///< coordinates are coarse: rounded when they were stored
  DOUBTFUL_VIEWPOINT,   ///< many points are in no triangle of the view
  OTHER_VIEWPOINT,      ///< the points are spaced as seen from another place than the given one
  OTHER_DIRECTION,      ///< the same, from far away
  STEP_IN_LOOP,         ///< disc: a long edge in the boundary loop
  ONE_SIDED,            ///< the surface was cut open because it seems one-sided
  DEEP_HOLES,           ///< holes stay open because a filling would be a lid, or cross other sheets
  UNUSED_POINTS,        ///< points are in no triangle
  FOLDS,                ///< edges are folded by more than 120 degrees
  CROSSING_TRIANGLES,   ///< pairs of triangles cross each other
  SPARSE_SHAPE,         ///< so many edges are sharp that the points are too few for the shape
  LONG_EDGES,           ///< edges inside the surface are much longer than the local spacing
  NO_AREA,              ///< triangles have no area
  SMALL_COMPONENT,      ///< a component has few points
  HOLES_LEFT_OPEN,      ///< holes stay open though all were to be closed
  SMALL_HOLES,          ///< small holes stay open
  NO_VIEWPOINT,         ///< the mesh was to face the viewpoint, but none is known
  NORMALS_CONTRADICT,   ///< normals do not decide the front: they contradict each other
  NORMALS_MISSING,      ///< normals do not decide the front: there are none
  CLOSED_HAS_NO_UP,     ///< a closed part was to face up
  VIEWPOINT_OUTSIDE,    ///< a closed part was to face the viewpoint
  GUESSED_OUTSIDE,      ///< the front is a guess: no side is outside
  GUESSED_UP,           ///< the front is a guess: as much faces down as up
  GUESSED_TOWARDS_VIEW, ///< the front is a guess: as much looks away from the viewpoint as towards it
  GUESSED_FRONT,        ///< the front is a guess: a body or a sheet
  COUNT                 ///< the number of findings
};

/// What a finding means for the mesh.
enum class Severity
{
  NOTE,  ///< nothing is wrong with the mesh
  DOUBT, ///< a decision of the run may be wrong
  FLAW   ///< the mesh is wrong there
};

/// Name of a finding in lower case ("crossing_triangles").
PCL_FLOATER_EXPORT const char*
findingName (FindingId id);

/// Short name of a severity in lower case ("flaw").
PCL_FLOATER_EXPORT const char*
severityName (Severity severity);

/// A finding, with the figures of its sentence.
struct Finding
{
  FindingId id = FindingId::COUNT;    ///< what was found
  Severity severity = Severity::NOTE; ///< what it means for the mesh
  std::vector<double> numbers;        ///< in the order of the sentence, how many there are first
  /// Places, each by a point: its cloud index and position.
  std::vector<std::pair<std::uint32_t, std::array<double, 3>>> places;
};

/// How good a mesh is, by its own flaws.
enum class Quality
{
  NO_MESH, ///< there is no mesh
  GOOD,    ///< hardly a flaw
  USABLE,  ///< flaws in places
  POOR     ///< flaws all over: not for use as it is
};

/// Short name in lower case ("usable").
PCL_FLOATER_EXPORT const char*
qualityName (Quality quality);

/// What a run makes of its mesh, in one word, with what explains most of it.
struct Verdict
{
  Quality value = Quality::NO_MESH; ///< the word
  std::string cause;                ///< why it is no better, with the figure; empty if it is good
  std::string remedy;               ///< what to do about it; empty if it is good
};

/// Result of the final check. It uses only triangles and positions.
struct MeshCheck
{
  bool done = false;                     ///< false if there was no mesh to check
  std::size_t nonmanifold_edges = 0;     ///< of over two triangles, or two facing opposite ways
  std::size_t nonmanifold_vertices = 0;  ///< points with more than one fan of triangles; always 0
  std::size_t components = 0;            ///< sets of triangles that are connected by edges
  std::int64_t euler_characteristic = 0; ///< vertices - edges + triangles
  std::int64_t genus = 0;                ///< handles, summed over the components
  std::size_t folds = 0;                 ///< edges whose triangles are folded by over 120 degrees
  std::size_t degenerate_triangles = 0;  ///< without area in the precision of the coordinates
  std::size_t self_intersections = 0;    ///< pairs of triangles that cross, touch or overlap beyond
                                         ///< common corners. 0 without a search if Report::is_view
  bool has_more_self_intersections = false; ///< the search ended at its limit: there may be more
  /// The first ten of them, each by a point of either triangle.
  std::vector<std::array<std::uint32_t, 2>> self_intersections_at;
  double largest_area_share = 0.0; ///< share of the area in the largest 1 % of the triangles; 0 of
                                   ///< fewer than 100, or if the mesh was made in parts
  double longest_edge = 0.0;       ///< in local spacings
  std::array<std::uint32_t, 2> longest_edge_at{}; ///< end points of that edge, as cloud indices
  std::vector<LoopSummary> loops;                 ///< longest first
};

/// Figures of the linear system of a disc and of its solution.
struct SystemStatistics
{
  std::size_t unknowns = 0;            ///< interior points m, rows of the system
  std::size_t nnz_matrix = 0;          ///< nnz (A)
  std::size_t nnz_factors = 0;         ///< nnz (L + U), without the unit diagonal of L
  double fill_in = 0.0;                ///< gamma = nnz (L + U) / nnz (A); TW 385, section 4.3
  double residual = 0.0;               ///< max |b - A u| over all rows and both coordinates
  double relative_residual = 0.0;      ///< measured |b - A u| / |b|, the larger of both coordinates
  std::size_t iterations_u = 0;        ///< iterations for the first coordinate
  std::size_t iterations_v = 0;        ///< iterations for the second coordinate
  double reciprocal_condition = 0.0;   ///< min |U_kk| / max |U_kk| of a direct solver
  std::size_t factorization_bytes = 0; ///< peak memory of the factorization; 0 if unknown
};

/// Counts, times and figures of a run; 0 for stages that were not reached.
struct Statistics : SystemStatistics
{
  std::array<double, static_cast<std::size_t> (Stage::COUNT)> seconds{}; ///< wall time by stage
  double total_seconds = 0.0; ///< wall time of all stages

  std::size_t cloud_points = 0;      ///< points of the input cloud
  std::size_t selected_points = 0;   ///< points that the indices select; by default, all
  std::size_t non_finite_points = 0; ///< selected, but as Report::non_finite
  std::size_t duplicate_points = 0;  ///< selected, but equal to an earlier point
  std::size_t working_points = 0;    ///< distinct finite points without outliers
  std::size_t outlier_points = 0;    ///< points left out because they lie off any surface
  std::size_t scatter_points = 0; ///< points of regions that are no surface at any scale, such as
                                  ///< leaves. Not searched in a view, in fewer than 320 points,
                                  ///< and without denoising if scatter is kept
  std::size_t stacked_points = 0; ///< points nearer to others than three tenths of the local
                                  ///< spacing, which came into the mesh after these
  double stack_height = 0.0;      ///< median of their distances, in local spacings
  double largest_stack_height = 0.0; ///< maximum of these
  double noise = 0.0; ///< median over points of the standard deviation of the noise across the
                      ///< surface, in local spacings; below 0.15 it counts as 0. Not for views
  double noise_quantile_90 = 0.0;   ///< noise that 90 % of the points do not exceed
  double largest_noise = 0.0;       ///< maximum over all points
  std::size_t projected_points = 0; ///< noisy points, connected by their places on local planes
  double coordinate_step = 0.0; ///< step to which coordinates seem to be rounded, on the axis where
                                ///< it is widest, in local spacings; 0: none found
  std::size_t trimmed_triangles = 0;  ///< triangles cut off by TrimmingOptions
  std::size_t opened_triangles = 0;   ///< trimmed triangles that crossed others
  std::size_t trimmed_components = 0; ///< trimmed components that were too small
  std::size_t trimmed_points = 0;     ///< points that lost all their triangles by trimming
  std::size_t view_steps = 0;   ///< scan: triangles left out at depth steps, to a surface behind
  std::size_t view_gaps = 0;    ///< scan: triangles left out where rays are missing
  std::size_t holes_filled = 0; ///< boundary loops of a surface that were filled
  std::size_t used_points = 0;  ///< points that are vertices of the mesh
  std::size_t boundary_candidates = 0; ///< boundary points, before the loop is found
  std::size_t loop_points = 0;         ///< points of the boundary loop
  std::size_t triangles = 0;           ///< triangles of the mesh

  std::size_t flips = 0;         ///< edges flipped in space
  std::size_t folds = 0;         ///< see MeshCheck::folds
  std::size_t necks_cut = 0;     ///< surface: necks between sheets that only come close
  std::size_t remade_points = 0; ///< surface: points between near sheets, connected anew in space
  std::size_t self_intersections_found = 0;   ///< before any were removed
  std::size_t self_intersection_flips = 0;    ///< edges flipped to remove them, or folds
  std::size_t self_intersection_moves = 0;    ///< points moved to other triangles
  std::size_t self_intersection_rebuilds = 0; ///< patches of points removed and reinserted
};

/// Everything about a run except the mesh. All indices are cloud indices.
struct Report
{
  RunStatus status = RunStatus::NOT_RUN; ///< outcome
  std::string message;           ///< one sentence: the cause and what to do; empty after SUCCESS
  Verdict verdict;               ///< how good the mesh is, why, and what helps
  std::vector<Finding> findings; ///< flaws, then doubts, then notes; those that concern most first
  std::vector<std::string> warnings;  ///< a sentence for each finding and option without effect
  Topology topology = Topology::AUTO; ///< the method that made the mesh: DISC or SURFACE
  std::string topology_reason;        ///< reason for this method, in a few words
  MeshCheck check;                    ///< final check of the mesh
  /// Surfaces except views: uncertain decisions on boundary loops, least certain first.
  std::vector<LoopDecision> loop_decisions;
  /// Parts of the mesh whose confidence in the front is below 0.9, least certain first.
  std::vector<FacingDecision> facing_decisions;
  double facing_certainty = 1.0; ///< smallest FacingDecision::certainty in the mesh
  /// Number of parts by the rule that turned them; indexed by FacingRule.
  std::array<std::size_t, static_cast<std::size_t> (FacingRule::COUNT)> facing_parts{};
  bool denoised = false;             ///< points were connected by their projections on local planes
  bool is_view = false;              ///< the points are one scan, connected as its sensor saw them
  bool is_far_view = false;          ///< the sensor is so far away that its rays are parallel
  std::array<double, 3> viewpoint{}; ///< of the sensor; for a far view, direction of its rays
  std::vector<std::uint32_t> loop;   ///< longest boundary loop, in order, each point once
  /// Disc: position of each cloud point in the plane, NaN where unused; triangles are
  /// anti-clockwise. Otherwise empty.
  std::vector<Eigen::Vector2d> parameters;
  std::vector<std::uint32_t> unused;     ///< finite points in no triangle, except duplicates and
                                         ///< outliers; includes points cut off; ascending
  std::vector<std::uint32_t> scatter;    ///< points on no surface (see Statistics::scatter_points);
                                         ///< left out unless it is to be kept; ascending
  std::vector<std::uint32_t> outliers;   ///< outliers, left out of the mesh; ascending
  std::vector<std::uint32_t> non_finite; ///< points with a NaN or infinite coordinate, and those
                                         ///< that stand for no measurement; ascending
  std::vector<std::array<std::uint32_t, 2>> duplicates; ///< (point, the equal point in the mesh),
                                                        ///< ascending
  Statistics statistics;                                ///< counts, times and figures
};

} // namespace pcl::floater
