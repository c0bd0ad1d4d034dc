// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Assembles an examination from its pieces.
#pragma once

#include "core/disjoint_sets.h"
#include "mesh/check.h"
#include "mesh/vertex_stars.h"

#include <unordered_map>
#include <utility>
#include <vector>

namespace pcl::floater {
/// (from, to), with the surface on the left.
using BoundaryEdge = std::pair<Index, Index>;

/// Results for a range of points. Positions are the smallest points, NONE if there is none.
struct Surroundings
{
  std::size_t edges = 0; ///< whose smaller end is in the range, as below
  std::size_t nonmanifold_vertices = 0, nonmanifold_edges = 0, orientation_conflicts = 0;
  std::size_t degenerate_triangles = 0, folds = 0, long_edges = 0;
  Index broken_at = NONE, degenerate_at = NONE, fold_at = NONE;
  double sqr_longest = 0.0, sqr_longest_inside = 0.0; ///< in local spacings
  std::pair<Index, Index> longest_at{}, longest_inside_at{};
  std::vector<Index> unused;          ///< points without triangles, ascending
  std::vector<BoundaryEdge> boundary; ///< sorted by the points from which they lead
  std::vector<BoundaryEdge> leaving;  ///< edges to points of other ranges, in any direction

  /// Appends the results of the following range, except `leaving`.
  void append (Surroundings&& next);
};

/// Input of the examination.
struct ExaminedMesh
{
  const std::vector<Triangle>& triangles;
  const std::vector<Eigen::Vector3d>& positions;
  const std::vector<float>& spacing; ///< local spacing of each point
  double diagonal = 1.0;             ///< of the bounding box of the whole cloud
};

/// Examines the triangles and edges around the points of a range, one by one.
class SurroundingsCheck
{
public:
  /// \param sets of the points; joined along edges within the range
  SurroundingsCheck (const ExaminedMesh& mesh, const CheckLimits& limits, DisjointSets& sets)
      : mesh_ (mesh), limits_ (limits), sets_ (sets)
  {
  }

  Surroundings lookAround (const TriangleRanges& ranges, std::size_t r, const RunContext& run);

private:
  // An edge from the current point, and the triangles at it.
  struct Spoke
  {
    Index to;
    Index out = 0, in = 0;           // triangles that run along it from the point, and to the point
    Index left = NONE, right = NONE; // third corners of an outgoing and of an incoming triangle
    Index fan;                       // disjoint sets: another spoke of the same fan, or itself
  };

  Index spokeTo (Index q);
  Index fanOf (Index spoke);
  void lookAt (Index p, const VertexStar& star);
  void lookAtTriangle (Index a, Index b, Index c);
  void lookAtEdge (Index p, const Spoke& spoke);

  const ExaminedMesh& mesh_;
  const CheckLimits& limits_;
  DisjointSets& sets_;
  std::size_t last_ = 0; // end of the range
  Surroundings found_;
  std::vector<Spoke> spokes_;
  std::unordered_map<Index, Index>
      place_; // if there are many spokes: index of each by its other point
};

/// Examines all points, on all threads; the result does not depend on their number.
/// \param ranges of the triangles
/// \param sets see SurroundingsCheck
Surroundings
lookAround (const ExaminedMesh& mesh, const TriangleRanges& ranges, const CheckLimits& limits,
            DisjointSets& sets, const RunContext& run);

/// Results of an examination, point by point.
struct ExaminedParts
{
  Surroundings around;                       ///< of all points
  std::size_t triangles = 0;                 ///< proper ones
  std::size_t components = 0;                ///< connected by edges
  std::vector<std::size_t> component_points; ///< vertices of each component, connected by vertices
  std::vector<Index> component_first;        ///< smallest vertex of each component
};

/// The examination without crossing pairs: adds boundary loops and genus. O(boundary log boundary)
/// \param component of each point
MeshExamination
makeExamination (ExaminedParts parts, const ExaminedMesh& mesh, const std::vector<Index>& component,
                 const Points& points);

} // namespace pcl::floater
