// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/boundary.h"

#include "core/geometry.h"
#include "core/parallel.h"
#include "local/planar_star.h"

#include <algorithm>
#include <unordered_map>

namespace pcl::floater {
Boundary
givenLoop (const Points& points, const std::vector<Index>& loop)
{
  Boundary boundary;
  const auto invalid = [&] (const std::string& why) {
    boundary.problem = {RunStatus::INVALID_LOOP, "the given boundary loop " + why};
    boundary.loop.clear ();
    return boundary;
  };
  std::unordered_map<Index, Index> point_of; // by cloud index
  for (Index p = 0; p < points.cloud_index.size (); ++p)
    point_of.emplace (points.cloud_index[p], p);
  for (const auto& [duplicate, kept] : points.duplicates)
    if (const auto at = point_of.find (kept); at != point_of.end ())
      point_of.emplace (duplicate, at->second);
  std::vector<std::uint8_t> seen (points.positions.size (), 0);
  for (const Index cloud_index : loop) {
    const auto at = point_of.find (cloud_index);
    const Index p = at != point_of.end () ? at->second : NONE;
    if (p == NONE)
      return invalid ("names point " + std::to_string (cloud_index) +
                      ", which is not in the cloud, not selected, or not finite");
    if (seen[p] != 0)
      return invalid ("passes twice through point " + std::to_string (cloud_index));
    seen[p] = 1;
    boundary.loop.push_back (p);
  }
  if (boundary.loop.size () < 3)
    return invalid ("has fewer than 3 points");
  boundary.candidates = boundary.loop.size ();
  return boundary;
}

namespace {
// Points whose widest sector without a neighbour exceeds the opening angle, ascending. Neighbours
// are projected on the tangent plane of the point. O(n k log k).
// \param opening_angle in radians
std::vector<Index>
openingAnglePoints (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                    const std::vector<Eigen::Vector3f>& normals, double opening_angle,
                    const RunContext& run)
{
  std::vector<std::uint8_t> wide (positions.size (), 0);
  parallelPoints<PlanarStar, std::vector<PlanarNeighbor>> (
      run, positions.size (), [&] (Index p, auto& star, auto& planar) {
        const TangentFrame frame (normals[p].cast<double> ());
        planar.clear ();
        for (const Index q : neighbors.row (p)) {
          const Eigen::Vector2d projected = frame.project (positions[q] - positions[p]);
          if (projected != Eigen::Vector2d::Zero ())
            planar.push_back ({projected, q});
        }
        star.make (planar);
        wide[p] = star.openingAngle () > opening_angle ? 1 : 0;
      });
  std::vector<Index> points;
  for (std::size_t p = 0; p < wide.size (); ++p)
    if (wide[p] != 0)
      points.push_back (static_cast<Index> (p));
  return points;
}

} // namespace

Boundary
publishedLoop (const Points& points, const LocalGeometry& geometry, const BoundaryOptions& options,
               const RunContext& run, LoopLimits limits)
{
  limits.largest_k = std::max (limits.largest_k, static_cast<Index> (options.cluster_k));
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  Boundary boundary;
  const std::vector<Index> candidates = openingAnglePoints (
      positions, geometry.neighbors, geometry.stars.normals, options.opening_angle * DEGREE, run);
  boundary.candidates = candidates.size ();
  const std::vector<std::vector<Index>> clusters = clusterBoundaryPoints (
      positions, candidates, options.cluster_tolerance * points.diagonal, options.cluster_k, run);
  if (!clusters.empty ())
    boundary.loop = twoSegmentLoop (positions, clusters.front (), run, limits);
  return boundary;
}

void
checkBoundary (const Points& points, const std::vector<float>& spacing, bool is_given,
               Boundary& boundary, const LoopLimits& limits)
{
  if (boundary.problem)
    return;
  const bool is_mere_gap = !is_given && boundary.loop.size () < limits.shortest_loop &&
                           points.size () > limits.few_points;
  if (boundary.loop.size () < 3 || is_mere_gap) {
    boundary.loop.clear ();
    boundary.problem = {
        RunStatus::NO_BOUNDARY,
        "no boundary loop was found among " + std::to_string (boundary.candidates) +
            (boundary.candidates == 1 ? " boundary point" : " boundary points") +
            ": the surface seems to be closed, or it is not one disc; cut it open, or give the "
            "loop"};
  }
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  for (std::size_t i = 0; i < boundary.loop.size (); ++i) {
    const Index p = boundary.loop[i];
    const Index q = boundary.loop[(i + 1) % boundary.loop.size ()];
    const double step = (positions[p] - positions[q]).norm () / (0.5 * (spacing[p] + spacing[q]));
    if (step > boundary.largest_step) {
      boundary.largest_step = step;
      boundary.longest_from = p;
    }
  }
}

} // namespace pcl::floater
