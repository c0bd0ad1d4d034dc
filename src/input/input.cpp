// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/input.h"

#include "core/order_statistics.h"
#include "options/check_options.h"
#include "points/outliers.h"
#include "report/findings.h"
#include "report/report_cloud.h"

namespace pcl::floater {
namespace {
// O(n); one bit per point if the indices are not ascending.
Problem
checkInput (const Input& input)
{
  const std::vector<Index>& indices = input.cloud_index;
  const auto refused = [] (const std::string& why) {
    return Problem{RunStatus::INVALID_INDICES, why};
  };
  if (indices.size () != input.positions.size ())
    return refused ("there are " + std::to_string (input.positions.size ()) + " positions but " +
                    std::to_string (indices.size ()) + " cloud indices; give one for each");
  for (const Normals* normals : {&input.normals, &input.facing_normals})
    if (!normals->empty () && normals->size () != input.cloud_size)
      return refused ("there are " + std::to_string (normals->size ()) +
                      " normals, but the whole cloud has " + std::to_string (input.cloud_size) +
                      " points; give one for each, or none");
  if (indices.empty ())
    return {};
  const Index largest = *std::max_element (indices.begin (), indices.end ());
  if (largest >= input.cloud_size)
    return refused ("cloud index " + std::to_string (largest) + " is outside the cloud of size " +
                    std::to_string (input.cloud_size));
  if (std::is_sorted (indices.begin (), indices.end (), std::less_equal<> ()))
    return {}; // each is larger than the one before
  std::vector<bool> is_taken (largest + std::size_t{1}, false);
  for (const Index index : indices) {
    if (is_taken[index])
      return refused ("cloud index " + std::to_string (index) + " is given twice");
    is_taken[index] = true;
  }
  return {};
}

// Makes points that stand for no measurement not finite, and removes gross outliers.
Problem
cleanInput (Input& input, const Options& options, const RunContext& run, Report& report)
{
  std::vector<Index> given = options.disc.boundary.loop;
  std::sort (given.begin (), given.end ());
  const auto mayGo = [&] (Index row) {
    return options.remove_outliers &&
           !std::binary_search (given.begin (), given.end (), input.cloud_index[row]);
  };
  const Vector3d shift (input.shift.data ());
  const InvalidPoints invalid = findInvalidPoints (input.positions, shift);
  const auto leaveOut = [&] (const std::vector<Index>& rows) {
    double count = 0.0;
    for (const Index row : rows)
      if (mayGo (row)) {
        input.positions[row].setConstant (std::numeric_limits<double>::quiet_NaN ());
        ++count;
      }
    return count;
  };
  if (const double count = leaveOut (invalid.pixels); count > 0.0) {
    const Vector3d place = invalid.place + shift;
    addFinding (report, FindingId::INVALID_PIXELS, {}, {}, count,
                100.0 * count / input.positions.size (), place.x (), place.y (), place.z ());
  }
  if (const double count = leaveOut (invalid.cells); count > 0.0)
    addFinding (report, FindingId::INVALID_CELLS, {}, {}, count, invalid.height, invalid.gap);

  constexpr std::size_t LARGEST_SHARE = 4; // a quarter of the points are not outliers
  const GrossOutliers found = findGrossOutliers (input.positions, run);
  if (found.isolated.empty () && found.unbearable.empty ())
    return {};
  const bool are_few = LARGEST_SHARE * found.unbearable.size () <= input.positions.size ();
  for (const Index row : found.unbearable)
    if (!are_few || !mayGo (row))
      return {RunStatus::DEGENERATE,
              placeText (input.cloud_index[row], input.positions[row]) +
                  " is so far away that double precision cannot hold it together with the others: "
                  "take such points out of the cloud, or have outliers left out"};
  std::vector<Index> rows = found.unbearable;
  std::copy_if (found.isolated.begin (), found.isolated.end (), std::back_inserter (rows), mayGo);
  std::sort (rows.begin (), rows.end ());
  const std::vector<Index> outliers = valuesAt (input.cloud_index, rows);
  eraseRows (input.positions, rows);
  eraseRows (input.cloud_index, rows);
  reportOutliers (outliers, FindingId::GROSS_OUTLIERS, report);
  return {};
}

} // namespace

bool
isSensorKnown (const std::array<double, 3>& sensor_origin)
{
  const Eigen::Map<const Vector3d> sensor (sensor_origin.data ());
  return !sensor.isZero (0.0) && sensor.allFinite ();
}

Problem
checkFacing (const Input& input, const Options& options)
{
  const auto refused = [] (const char* why) { return Problem{RunStatus::INVALID_OPTION, why}; };
  if (options.facing == Facing::NORMALS && input.facing_normals.empty ())
    return refused ("the mesh is to face where the normals of the points point to, but the points "
                    "have no normals: take points with normals, or choose another facing");
  if (options.facing == Facing::VIEWPOINT && !mayBeSeen (options) &&
      !isSensorKnown (input.sensor_origin))
    return refused ("the mesh is to face the viewpoint, but the cloud has no origin of its sensor, "
                    "and no viewpoint is looked for: give that origin, or choose another facing");
  return {};
}

Problem
takePoints (Input& input, const Options& options, const RunContext& run, Points& points,
            Report& report)
{
  report.statistics.cloud_points = input.cloud_size;
  report.statistics.selected_points = input.positions.size ();
  if (Problem problem = checkOptions (options))
    return problem;
  if (Problem problem = checkInput (input))
    return problem;
  if (Problem problem = checkFacing (input, options))
    return problem;

  run.beginStage (Stage::WORKING_SET);
  if (Problem problem = cleanInput (input, options, run, report))
    return problem;
  points =
      makePoints (std::exchange (input.positions, {}), std::exchange (input.cloud_index, {}), run);
  points.normals = normalsOfPoints (std::exchange (input.normals, {}), points);
  points.facing_normals = normalsOfPoints (std::exchange (input.facing_normals, {}), points);
  reportPoints (points, report);
  return {};
}

} // namespace pcl::floater
