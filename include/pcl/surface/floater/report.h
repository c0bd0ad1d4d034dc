// SPDX-License-Identifier: GPL-3.0-or-later
// What a run tells about itself.
#pragma once

#include <pcl/surface/floater/options.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// Outcome of a run. Everything but OK comes with an empty mesh and a message that names the cause.
enum class Status
{
  NOT_RUN,         ///< reconstruct () has not been called
  OK,              ///< a mesh was made; see Report::warnings for what is odd about it
  NO_INPUT,        ///< null or empty input cloud
  INVALID_OPTION,  ///< an option is out of its range
  INVALID_INDICES, ///< an index is outside the cloud
  TOO_FEW_POINTS,  ///< fewer than 4 distinct finite points
  DEGENERATE,      ///< all points on one line
  NO_BOUNDARY,     ///< no boundary loop found: closed, or not one disc
  INVALID_LOOP,    ///< the user's loop is too short, repeats a point or names an unusable one
  UNREACHABLE,     ///< most of the points do not connect to the boundary: several components
  NOT_A_DISC, ///< the surface cannot be laid out as one disc: closed, with handles, several parts
  SINGULAR,   ///< the linear system has no unique solution
  NOT_CONVERGED,      ///< an iterative solver did not reach its tolerance
  SOLVER_UNAVAILABLE, ///< this build is without the library of the solver
  CANCELLED,          ///< stopped by Options::cancelled
  OUT_OF_MEMORY,      ///< an allocation failed
  INTERNAL_ERROR      ///< the result did not pass its own check; please report it
};

/// Short name of a status in upper case ("NO_BOUNDARY").
PCL_FLOATER_EXPORT const char*
statusName (Status status);

/// A boundary loop of the mesh.
struct LoopSummary
{
  std::size_t points = 0;      ///< points of the loop, each once
  double length = 0.0;         ///< sum of its edges, in units of the cloud
  double width = 0.0;          ///< largest distance between two of its points, same unit
  double width_spacings = 0.0; ///< the same in local spacings
  std::uint32_t at = 0;        ///< its smallest point, as cloud index
};

/// What the last stage finds on the mesh itself, whatever method made it.
struct MeshCheck
{
  bool done = false;                     ///< false if there was no mesh to check
  std::size_t nonmanifold_edges = 0;     ///< edges of three or more triangles; always 0
  std::size_t nonmanifold_vertices = 0;  ///< points with more than one fan of triangles; always 0
  std::size_t orientation_conflicts = 0; ///< edges that both triangles run along alike; always 0
  std::size_t components = 0;            ///< components that hang together by edges
  std::int64_t euler_characteristic = 0; ///< vertices - edges + triangles
  std::int64_t genus = 0;                ///< handles of all components together
  std::size_t folds = 0;                 ///< neighbouring triangles more than 120 degrees apart
  std::size_t degenerate_triangles = 0;  ///< no area in the precision of the coordinates
  double longest_edge = 0.0;             ///< in local spacings
  std::array<std::uint32_t, 2> longest_edge_at{}; ///< its ends, as cloud indices
  std::vector<LoopSummary> loops;                 ///< longest first
};

/// Figures of a run. Zero where a stage was not reached.
struct Statistics
{
  std::array<double, static_cast<std::size_t> (Stage::COUNT)> seconds{}; ///< wall time by stage
  double total_seconds = 0.0;

  std::size_t cloud_points = 0;      ///< points of the input cloud
  std::size_t selected_points = 0;   ///< points chosen by the indices (all without)
  std::size_t non_finite_points = 0; ///< selected, but with a NaN or infinite coordinate
  std::size_t duplicate_points = 0;  ///< selected, but equal to an earlier point
  std::size_t working_points = 0;    ///< points that the stages worked on
  std::size_t outlier_points = 0;    ///< points left out since they lie off any surface
  double noise = 0.0; ///< median over points of the rms distance of their neighbours to the plane
                      ///< or quadric through them, in local spacings
  std::size_t holes_filled = 0;        ///< holes closed by the surface method
  std::size_t used_points = 0;         ///< points that are a vertex of the mesh
  std::size_t relinked_points = 0;     ///< points that had to be linked back to the loop
  std::size_t boundary_candidates = 0; ///< points that look like boundary
  std::size_t loop_points = 0;         ///< points of the boundary loop
  std::size_t triangles = 0;
  std::size_t levels = 0; ///< of regions laid out again where the plane was too small for them
  std::size_t flips = 0;  ///< edges flipped after lifting
  std::size_t folds = 0;  ///< neighbouring triangles left more than 120 degrees apart

  std::size_t unknowns = 0;       ///< interior points m, rows of the system
  std::size_t nnz_matrix = 0;     ///< nnz (A)
  std::size_t nnz_factors = 0;    ///< nnz (L + U); incomplete factors count too
  double fill_in = 0.0;           ///< gamma = nnz (L + U) / nnz (A), TW 385 section 4.3
  double residual = 0.0;          ///< max |b - A u| over rows and both right-hand sides
  double relative_residual = 0.0; ///< measured |b - A u| / |b|, the larger of both coordinates
  std::size_t iterations_u = 0;   ///< of an iterative solver
  std::size_t iterations_v = 0;
  double reciprocal_condition = 0.0;   ///< of direct solvers: min |U_kk| / max |U_kk|
  std::size_t factorization_bytes = 0; ///< peak memory of the factorization; 0 if not known
};

/// Result of a run beside the mesh itself. All indices are cloud indices.
struct Report
{
  Status status = Status::NOT_RUN;
  std::string message;                ///< one sentence: the cause and what to do; empty if OK
  std::vector<std::string> warnings;  ///< one sentence each
  Topology topology = Topology::AUTO; ///< method that made the mesh: DISC or SURFACE
  std::string topology_reason;        ///< why that one, in a few words
  MeshCheck check;
  bool denoised = false;                   ///< connected as the points lie in their local planes
  std::vector<std::uint32_t> loop;         ///< longest boundary loop, in order, each point once
  std::vector<Eigen::Vector2d> parameters; ///< of a disc: per cloud point; NaN where it was not
                                           ///< used; triangles run anti-clockwise; else empty
  std::vector<std::uint32_t> unused;       ///< finite, not duplicate, but in no triangle; ascending
  std::vector<std::uint32_t> outliers;     ///< left out of the mesh as outliers; ascending
  std::vector<std::uint32_t> non_finite;   ///< ascending
  std::vector<std::array<std::uint32_t, 2>> duplicates; ///< (point, the point that stands for it)
  Statistics statistics;
};

} // namespace floater
} // namespace pcl
