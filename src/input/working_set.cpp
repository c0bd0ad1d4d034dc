// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/working_set.h"

#include "input/check_input.h"
#include "input/input_cleaning.h"
#include "options/check_options.h"
#include "report/report_cloud.h"

#include <vector>

namespace pcl::floater {
Problem
takePoints (Input& input, const Request& request, Points& points, Report& report)
{
  const Options& options = request.options;
  const RunContext& run = request.run;
  report.statistics.cloud_points = input.cloud_size;
  report.statistics.selected_points = input.positions.size ();
  if (Problem problem = checkOptions (options))
    return problem;
  if (Problem problem = checkInput (input))
    return problem;
  if (Problem problem = checkFacing (input, options))
    return problem;
  if (asksForDisc (options))
    run.setMethod (Topology::DISC);

  run.beginStage (Stage::WORKING_SET);
  if (Problem problem = cleanInput (input, options, request.limits.gross_outliers, run, report))
    return problem;
  points = makePoints (input.positions, input.cloud_index, run);
  points.lattice_width = input.lattice_width;
  points.normals = normalsOfPoints (input.normals, points);
  std::vector<Eigen::Vector3f> ().swap (input.normals);
  points.facing_normals = normalsOfPoints (input.facing_normals, points);
  std::vector<Eigen::Vector3f> ().swap (input.facing_normals);
  std::vector<Eigen::Vector3d> ().swap (input.positions);
  std::vector<Index> ().swap (input.cloud_index);
  reportPoints (points, report);
  return {};
}

} // namespace pcl::floater
