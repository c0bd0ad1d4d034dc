// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/check_input.h"

#include "core/types.h"
#include "options/request.h"

#include <algorithm>
#include <functional>

namespace pcl::floater {
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
  for (const std::vector<Eigen::Vector3f>* normals : {&input.normals, &input.facing_normals})
    if (!normals->empty () && normals->size () != input.cloud_size)
      return refused ("there are " + std::to_string (normals->size ()) +
                      " normals, but the whole cloud has " + std::to_string (input.cloud_size) +
                      " points; give one for each, or none");
  if (input.lattice_width != 0 && input.cloud_size % input.lattice_width != 0)
    return refused ("the rows of the organized cloud have " + std::to_string (input.lattice_width) +
                    " points, but the whole cloud has " + std::to_string (input.cloud_size) +
                    "; give a divisor of that, or 0");
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

bool
isSensorKnown (const std::array<double, 3>& sensor_origin)
{
  const Eigen::Map<const Eigen::Vector3d> sensor (sensor_origin.data ());
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

} // namespace pcl::floater
