// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "result_oracle.h"

#include "mesh_oracle.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace pcl::floater::fuzz {
namespace {
std::string
findFaultOfFailure (const Result& result)
{
  if (result.report.status == RunStatus::INTERNAL_ERROR ||
      result.report.status == RunStatus::NOT_RUN)
    return std::string (statusName (result.report.status)) + ": " + result.report.message;
  if (!result.triangles.empty ())
    return "a run that failed has triangles";
  if (result.report.message.empty ())
    return "a run that failed has no message";
  return "";
}

// What has become of each selected point, by its cloud index.
class Fates
{
public:
  explicit Fates (const Input& input)
  {
    for (std::size_t i = 0; i < input.cloud_index.size (); ++i)
      position_[input.cloud_index[i]] = input.positions[i];
  }

  bool isSelected (std::uint32_t index) const { return position_.count (index) != 0; }

  const Eigen::Vector3d& position (std::uint32_t index) const { return position_.at (index); }

  /// Largest distance of two points that count as equal: rounding of the positions while they are
  /// centred and scaled.
  double equality () const
  {
    Eigen::AlignedBox3d box;
    for (const auto& [index, position] : position_)
      if (position.allFinite ())
        box.extend (position);
    return 2.0 * std::numeric_limits<double>::epsilon () *
           (0.5 * box.max () - 0.5 * box.min ()).stableNorm ();
  }

  /// \return a fault, or nothing
  std::string give (std::uint32_t index, const char* fate)
  {
    if (!isSelected (index))
      return "point " + std::to_string (index) + " is " + fate + ", but was not selected";
    const auto [before, is_first] = fate_.emplace (index, fate);
    return is_first ? ""
                    : "point " + std::to_string (index) + " is " + fate + " and " + before->second;
  }

  bool isGiven (std::uint32_t index) const { return fate_.count (index) != 0; }

  std::string findForgotten () const
  {
    for (const auto& [index, unused] : position_)
      if (fate_.count (index) == 0)
        return "nothing is said of point " + std::to_string (index);
    return "";
  }

private:
  std::map<std::uint32_t, Eigen::Vector3d> position_;
  std::map<std::uint32_t, const char*> fate_;
};

std::string
findFaultOfPoints (const Input& input, const Result& result, const std::set<std::uint32_t>& used)
{
  const Report& report = result.report;
  Fates fates (input);
  std::string fault;
  const auto giveAll = [&] (const auto& indices, const char* fate) {
    for (const std::uint32_t index : indices)
      if (fault.empty ())
        fault = fates.give (index, fate);
  };
  giveAll (used, "in the mesh");
  giveAll (report.unused, "unused");
  giveAll (report.outliers, "an outlier");
  // Scatter is connected like all else, or left out as a whole.
  if (!report.scatter.empty () && !fates.isGiven (report.scatter.front ()))
    giveAll (report.scatter, "scatter");
  giveAll (report.non_finite, "not finite");
  const double equality = fates.equality ();
  for (const auto& [point, equal] : report.duplicates) {
    if (fault.empty ())
      fault = fates.give (point, "a duplicate");
    if (fault.empty () &&
        !(fates.isSelected (equal) &&
          (fates.position (point) - fates.position (equal)).stableNorm () <= equality))
      fault = "point " + std::to_string (point) + " is no duplicate of " + std::to_string (equal);
  }
  if (fault.empty ())
    fault = fates.findForgotten ();
  for (const std::uint32_t index : used)
    if (fault.empty () && !fates.position (index).allFinite ())
      fault = "point " + std::to_string (index) + " of the mesh is not finite";
  for (const auto* list : {&report.unused, &report.outliers, &report.scatter, &report.non_finite})
    if (fault.empty () && !std::is_sorted (list->begin (), list->end ()))
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
findFaultOfFigures (const Input& input, const Result& result, const samples::Topology& topology)
{
  const Report& report = result.report;
  const MeshCheck& check = report.check;
  if (!check.done || check.nonmanifold_edges + check.nonmanifold_vertices > 0 ||
      check.orientation_conflicts > 0)
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
          return "point " + std::to_string (corner) + " of the mesh has no parameters";
  return "";
}

} // namespace

std::string
findFault (const Input& input, const Result& result)
{
  if (result.report.status != RunStatus::SUCCESS)
    return findFaultOfFailure (result);
  if (result.triangles.empty ())
    return "a run that succeeded has no triangles";
  if (!result.report.message.empty ())
    return "a run that succeeded has a message: " + result.report.message;
  std::set<std::uint32_t> used;
  for (const auto& triangle : result.triangles)
    used.insert (triangle.begin (), triangle.end ());
  if (std::string fault = findFaultOfPoints (input, result, used); !fault.empty ())
    return fault;
  const samples::Topology topology = samples::topologyOf (result.triangles);
  if (!topology.manifold)
    return "the mesh is no oriented manifold";
  return findFaultOfFigures (input, result, topology);
}

} // namespace pcl::floater::fuzz
