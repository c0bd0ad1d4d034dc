// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepared_input.h"

#include "precision.h"

#include <numeric>

namespace pcl::floater {
int
exitCode (const Report& report, const RunFigures& run)
{
  if (run.is_refused)
    return EXIT_WARNINGS;
  switch (report.status) {
  case RunStatus::SUCCESS:
    return EXIT_OK;
  case RunStatus::INVALID_OPTION:
    return EXIT_USAGE;
  case RunStatus::OUT_OF_MEMORY:
  case RunStatus::INTERNAL_ERROR:
    return EXIT_INTERNAL;
  default:
    return EXIT_RECONSTRUCTION;
  }
}

Input
makeInput (const Cloud& cloud)
{
  Input input;
  input.positions = cloud.positions ();
  input.cloud_size = cloud.size ();
  if (cloud.size () == cloud.rows)
    input.lattice_width = cloud.lattice_width;
  input.sensor_origin = cloud.sensor_origin;
  input.cloud_index.resize (cloud.size ());
  std::iota (input.cloud_index.begin (), input.cloud_index.end (), 0U);
  cloud.file.giveBack ();
  return input;
}

void
takeNormals (const CommandLine& line, const Cloud& cloud, Input& input)
{
  const bool for_facing = line.usesNormalsForFacing ();
  if (!line.use_input_normals && !for_facing)
    return;
  const FieldTriple fields = normalFields (cloud);
  if (!fields[0])
    throw UsageError (
        std::string (line.use_input_normals ? "--use-input-normals on" : "--facing normals") +
        ": the points of " + inputName (line.input) +
        " have no normals (float fields normal_x, normal_y, normal_z, or nx, ny, "
        "nz); leave the option out, or add them");
  std::vector<Eigen::Vector3f> normals (cloud.size ());
  for (std::size_t p = 0; p < normals.size (); ++p)
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      normals[p][axis] =
          static_cast<float> (fields[static_cast<std::size_t> (axis)]->asDouble (cloud.row (p)));
  cloud.file.giveBack ();
  if (line.use_input_normals)
    input.normals = normals;
  if (for_facing)
    input.facing_normals = std::move (normals);
}

void
shiftOrigin (CommandLine& line, Cloud& cloud, Input& input)
{
  if (line.auto_shift)
    cloud.shift = chooseShift (input.positions, line.options.threads);
  else if (line.shift)
    cloud.shift = *line.shift;
  if (cloud.shift.isZero (0.0))
    return;
  for (Eigen::Vector3d& position : input.positions)
    position -= cloud.shift;
  Eigen::Map<Eigen::Vector3d> (line.options.view.viewpoint.data ()) -= cloud.shift;
  Eigen::Map<Eigen::Vector3d> sensor_origin (input.sensor_origin.data ());
  if (!sensor_origin.isZero (0.0)) // else it is one that nobody told
    sensor_origin -= cloud.shift;
}

} // namespace pcl::floater
