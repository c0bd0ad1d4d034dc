// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The compiled part of the Python module pcl_floater. The part in Python checks what arrays it
// gets, and makes exceptions and meshes of what this one returns.
#include "input/input.h"
#include "keywords.h"
#include "options/check_options.h"
#include "report_json.h"
#include "result_arrays.h"
#include "watch.h"

#include <nlohmann/json.hpp>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <cmath>
#include <numeric>

namespace py = pybind11;

namespace pcl::floater {
namespace {
py::object
toPython (const nlohmann::ordered_json& json)
{
  const std::string text = json.dump (-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return py::module_::import ("json").attr ("loads") (text);
}

/// \throws pybind11::value_error
Input
makeInput (const PointRows& rows, const py::object& normals, const py::object& sensor_origin,
           const GivenOptions& asked)
{
  Input input;
  if (!sensor_origin.is_none ()) {
    input.sensor_origin = readPlace ("sensor_origin", sensor_origin);
    for (const double coordinate : input.sensor_origin)
      if (!std::isfinite (coordinate))
        throw py::value_error ("sensor_origin must have finite coordinates");
  }
  const Facing facing = asked.options.facing;
  const bool for_facing = facing == Facing::AUTO || facing == Facing::NORMALS;
  if (normals.is_none ()) {
    if (asked.use_input_normals)
      throw py::value_error ("use_input_normals=True needs normals");
  }
  else {
    if (!for_facing && !asked.use_input_normals)
      throw py::value_error ("normals are given, but facing does not ask for them: leave them out, "
                             "or set facing='normals' or use_input_normals=True");
    const PointRows given (normals.cast<py::buffer> ());
    if (given.size () != rows.size ())
      throw py::value_error ("there are " + std::to_string (given.size ()) + " normals of " +
                             std::to_string (rows.size ()) + " points; give one for each point");
    auto copy = given.copy<Eigen::Vector3f> ();
    if (asked.use_input_normals)
      input.normals = copy;
    if (for_facing)
      input.facing_normals = std::move (copy);
  }
  input.cloud_size = rows.size ();
  {
    const py::gil_scoped_release release;
    input.positions = rows.copy<Eigen::Vector3d> ();
    input.cloud_index.resize (rows.size ());
    std::iota (input.cloud_index.begin (), input.cloud_index.end (), 0U);
  }
  return input;
}

/// \param lattice_width of an organized cloud: points of a row; else 0
/// \return status, message, what strict objects to, warnings, the part of the report that the core knows, and the arrays
py::tuple
run (const py::buffer& points, std::size_t lattice_width, const py::object& normals,
     const py::object& sensor_origin, const py::dict& keywords, const py::object& progress)
{
  GivenOptions asked = readKeywords (keywords);
  Options& options = asked.options;
  const Problem problem = checkOptions (options);
  if (problem.status == RunStatus::INVALID_OPTION)
    throw py::value_error (problem.message);
  const PointRows rows (points);
  Input input = makeInput (rows, normals, sensor_origin, asked);
  input.lattice_width = lattice_width;
  if (const Problem facing = checkFacing (input, options))
    throw py::value_error (facing.message);

  Watch watch (progress);
  watch.attachTo (options);
  const auto result = std::make_shared<Result> ();
  double seconds = 0.0;
  {
    const py::gil_scoped_release release;
    const auto start = std::chrono::steady_clock::now ();
    // The status of a cloud without points comes from the same function as for the class.
    *result = rows.size () == 0 ? reconstruct (std::vector<Eigen::Vector3d> (), options)
                                : reconstruct (std::move (input), options);
    seconds = std::chrono::duration<double> (std::chrono::steady_clock::now () - start).count ();
  }
  watch.rethrow ();

  const Report& report = result->report;
  nlohmann::ordered_json known;
  known["options"] = optionsJson (effectiveOptions (options), asked.use_input_normals);
  known.update (resultJson (report));
  known["seconds"] = secondsJson (report.statistics);
  known["seconds"]["reconstruction"] = seconds;
  return py::make_tuple (statusName (report.status), report.message, objectionTo (report),
                         report.warnings, toPython (known), arraysOfResult (result));
}

} // namespace
} // namespace pcl::floater

PYBIND11_MODULE (_core, module)
{
  module.doc () = "The compiled part of pcl_floater.";
  module.attr ("__version__") = PCL_FLOATER_VERSION;
  pcl::floater::defineResultArray (module);
  module.def ("run", &pcl::floater::run);
  module.def ("options", [] { return pcl::floater::toPython (pcl::floater::optionTableJson ()); });
  pcl::floater::defineMeshFunctions (module);
}
