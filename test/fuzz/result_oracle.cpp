// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "attack.h"

#include "mesh_oracle.h"

#include <Eigen/Geometry>

namespace pcl::floater::fuzz {
namespace {
std::string
named (std::uint32_t point)
{
  return "point " + std::to_string (point);
}

// Largest distance of two points that count as equal: rounding of the positions while they are
// centred and scaled, and of each coordinate to multiples of 2e-16.
double
equalityOf (const std::vector<Eigen::Vector3d>& positions)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : positions)
    if (position.allFinite ())
      box.extend (position);
  return 6.0 * std::numeric_limits<double>::epsilon () *
         (0.5 * box.max () - 0.5 * box.min ()).stableNorm ();
}

// Each selected point has become one of what the report lists, and only one.
std::string
findFaultOfPoints (const Input& input, const Result& result, const std::set<std::uint32_t>& used)
{
  const Report& report = result.report;
  std::map<std::uint32_t, Eigen::Vector3d> position;
  for (std::size_t i = 0; i < input.cloud_index.size (); ++i)
    position[input.cloud_index[i]] = input.positions[i];
  std::map<std::uint32_t, const char*> fate;
  std::string fault;
  const auto give = [&] (std::uint32_t point, const char* its_fate) {
    if (!fault.empty ())
      return;
    const auto [before, is_first] = fate.emplace (point, its_fate);
    if (position.count (point) == 0)
      fault = named (point) + " is " + its_fate + ", but was not selected";
    else if (!is_first)
      fault = named (point) + " is " + its_fate + " and " + before->second;
  };
  const auto giveAll = [&] (const auto& points, const char* their_fate) {
    if (fault.empty () && !std::is_sorted (points.begin (), points.end ()))
      fault = "a list of points is not ascending";
    for (const std::uint32_t point : points)
      give (point, their_fate);
  };
  giveAll (used, "in the mesh");
  giveAll (report.unused, "unused");
  giveAll (report.outliers, "an outlier");
  // Scatter is connected like all else, or left out as a whole.
  if (!report.scatter.empty () && fate.count (report.scatter.front ()) == 0)
    giveAll (report.scatter, "scatter");
  giveAll (report.non_finite, "not finite");
  const double equality = equalityOf (input.positions);
  for (const auto& [point, equal] : report.duplicates) {
    give (point, "a duplicate");
    if (fault.empty () && (position.count (equal) == 0 ||
                           (position[point] - position[equal]).stableNorm () > equality))
      fault = named (point) + " is no duplicate of " + std::to_string (equal);
  }
  for (const auto& [point, unused] : position)
    if (fault.empty () && fate.count (point) == 0)
      fault = "nothing is said of " + named (point);
  for (const std::uint32_t point : used)
    if (fault.empty () && !position[point].allFinite ())
      fault = named (point) + " of the mesh is not finite";
  if (fault.empty () && !std::is_sorted (report.scatter.begin (), report.scatter.end ()))
    fault = "a list of points is not ascending";
  const Statistics& counts = report.statistics;
  if (fault.empty () &&
      (counts.selected_points != input.positions.size () || counts.used_points != used.size () ||
       counts.outlier_points != report.outliers.size () ||
       counts.scatter_points != report.scatter.size () ||
       counts.non_finite_points != report.non_finite.size () ||
       counts.duplicate_points != report.duplicates.size ()))
    fault = "the counts of points are not those of the lists";
  return fault;
}

std::string
findFaultOfFigures (const Input& input, const Result& result, const samples::MeshTopology& topology)
{
  const Report& report = result.report;
  const MeshCheck& check = report.check;
  if (!check.done || check.nonmanifold_edges + check.nonmanifold_vertices > 0)
    return "the check has not passed";
  if (check.components != topology.components || check.euler_characteristic != topology.euler ||
      check.loops.size () != topology.loops.size ())
    return "the check counts " + std::to_string (check.components) + " components, Euler " +
           std::to_string (check.euler_characteristic) + " and " +
           std::to_string (check.loops.size ()) + " loops; it is " +
           std::to_string (topology.components) + ", " + std::to_string (topology.euler) + " and " +
           std::to_string (topology.loops.size ());
  if (report.statistics.triangles != result.triangles.size ())
    return "the number of triangles is wrong";
  for (const LoopSummary& loop : check.loops)
    if (!std::isfinite (loop.length) || !std::isfinite (loop.width_spacings))
      return "the length of a boundary loop is not finite";
  if (!std::isfinite (check.longest_edge))
    return "the longest edge is not finite";
  if (!report.parameters.empty () && report.parameters.size () != input.cloud_size)
    return "there are parameters for " + std::to_string (report.parameters.size ()) + " points";
  if (!report.parameters.empty ())
    for (const auto& triangle : result.triangles)
      for (const std::uint32_t corner : triangle)
        if (!report.parameters[corner].allFinite ())
          return named (corner) + " of the mesh has no parameters";
  return "";
}

} // namespace

std::string
findFault (const Input& input, const Result& result)
{
  const RunStatus status = result.report.status;
  const std::string& message = result.report.message;
  if (status == RunStatus::INTERNAL_ERROR || status == RunStatus::NOT_RUN)
    return std::string (statusName (status)) + ": " + message;
  const bool is_success = status == RunStatus::SUCCESS;
  if (result.triangles.empty () == is_success)
    return "a run that succeeded has no triangles, or one that failed has some";
  if (message.empty () != is_success)
    return "a run that succeeded has a message, or one that failed has none: " + message;
  if (!is_success)
    return "";
  std::set<std::uint32_t> used;
  for (const auto& triangle : result.triangles)
    used.insert (triangle.begin (), triangle.end ());
  if (std::string fault = findFaultOfPoints (input, result, used); !fault.empty ())
    return fault;
  const samples::MeshTopology topology = samples::topologyOf (result.triangles);
  if (!topology.manifold)
    return "the mesh is no oriented manifold";
  return findFaultOfFigures (input, result, topology);
}

} // namespace pcl::floater::fuzz
