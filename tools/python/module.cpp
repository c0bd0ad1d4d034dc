// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The compiled part of the Python module pcl_floater. The part in Python checks what it is given, and
// makes exceptions and meshes of what this one returns.
#include "input/input.h"
#include "options/check_options.h"
#include "options/option_rows.h"
#include "report_json.h"

#include <pcl/surface/floater/reconstruct.h>
#include <pcl/surface/floater/texture_coordinates.h>
#include <pcl/surface/floater/vertex_normals.h>

#include <nlohmann/json.hpp>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstring>
#include <exception>
#include <memory>

namespace py = pybind11;
using namespace py::literals;

namespace pcl::floater {
namespace {
/// Does the work without the lock of the interpreter (GIL). Tells Python's caller how far it is, and
/// ends it if the callable or a signal raised an exception.
/// \param options Options, or TextureOptions
/// \throws what was raised
template <typename AnyOptions, typename Work>
void
watch (const py::object& progress, AnyOptions& options, const Work& work)
{
  // Signals are handled in the main thread only.
  const auto threading = py::module_::import ("threading");
  const bool handles_signals =
      threading.attr ("current_thread") ().is (threading.attr ("main_thread") ());
  const char* stage_now = "texture";
  std::exception_ptr raised;
  options.cancelled_callback = [&] {
    if (!raised && handles_signals) {
      const py::gil_scoped_acquire lock;
      if (PyErr_CheckSignals () != 0)
        raised = std::make_exception_ptr (py::error_already_set ());
    }
    return raised != nullptr;
  };
  if constexpr (std::is_same_v<AnyOptions, Options>) // which tells the stage before all else
    options.stage_callback = [&] (Stage stage) { stage_now = stageName (stage); };
  if (!progress.is_none ())
    options.progress_callback = [&] (double fraction) {
      if (raised)
        return;
      const py::gil_scoped_acquire lock;
      try {
        progress (stage_now, fraction);
      }
      catch (const py::error_already_set&) {
        raised = std::current_exception ();
      }
    };
  {
    const py::gil_scoped_release release;
    work ();
  }
  if (raised)
    std::rethrow_exception (raised);
}

/// Takes the options that a dict has, each under the name that the tool has for it.
struct OptionsReader
{
  const py::dict& given;

  template <typename Value, typename... Range>
  void operator() (const OptionRow& row, Value& value, const Range&...)
  {
    if (given.contains (row.name))
      value = given[row.name].cast<Value> ();
  }
  template <typename Enum, std::size_t N>
  void operator() (const OptionRow& row, Enum& value, Choices<Enum, N>& choices)
  {
    std::string word;
    (*this) (row, word);
    for (const auto& choice : choices)
      if (word == choice.first)
        value = choice.second;
  }
  void operator() (const OptionRow& row, HoleOptions& holes, LengthUnit unit)
  {
    double size = 0.0;
    (*this) (row, size);
    if (size != 0.0) {
      holes.largest_hole = size;
      holes.unit = unit;
    }
  }
  void operator() (const OptionRow& row, ViewOptions& view)
  {
    if (!given.contains (row.name))
      return;
    const py::object place = given[row.name];
    view.use = !py::isinstance<py::str> (place)       ? ViewUse::GIVEN
               : place.cast<std::string> () == "auto" ? ViewUse::AUTO
                                                      : ViewUse::NEVER;
    if (view.use == ViewUse::GIVEN)
      view.viewpoint = place.cast<std::array<double, 3>> ();
  }
};

/// Copies rows of three numbers, of float or double, wherever they are in memory. It is the only copy
/// that is made, and needs no lock.
/// \tparam Vector of Eigen, with three elements
template <typename Vector>
std::vector<Vector>
copyRows (const py::buffer_info& info)
{
  std::vector<Vector> rows (static_cast<std::size_t> (info.shape[0]));
  const auto copy = [&info, &rows] (auto number) {
    const char* row = static_cast<const char*> (info.ptr);
    for (Vector& vector : rows) {
      for (py::ssize_t axis = 0; axis < 3; ++axis) {
        std::memcpy (&number, row + axis * info.strides[1], sizeof (number)); // may be unaligned
        vector[axis] = static_cast<typename Vector::Scalar> (number);
      }
      row += info.strides[0];
    }
  };
  info.itemsize == sizeof (float) ? copy (float{}) : copy (double{});
  return rows;
}

/// An array of a result, for Python without a copy: it keeps the whole result alive. NumPy takes it
/// by the buffer protocol, so that the module depends on no version of NumPy's C interface.
struct ResultArray
{
  std::shared_ptr<const void> owner;
  py::buffer_info view;
};

template <typename T>
ResultArray
arrayOf (const std::shared_ptr<const void>& owner, const std::vector<T>& values)
{
  static double none = 0.0; // an empty array has an address, too
  // The arrays are the user's, who may change them. The report in C++ is not read again.
  void* const first =
      values.empty () ? static_cast<void*> (&none) : const_cast<T*> (values.data ());
  const auto rows = static_cast<py::ssize_t> (values.size ());
  constexpr py::ssize_t ROW = sizeof (T);
  if constexpr (std::is_arithmetic_v<T>)
    return {owner, {first, ROW, "i", 1, {rows}, {ROW}}};
  else {
    using Given = typename T::value_type; // indices are unsigned
    using Number = std::conditional_t<std::is_same_v<Given, std::uint32_t>, std::int32_t, Given>;
    constexpr py::ssize_t ELEMENT = sizeof (Number);
    const std::string format = py::format_descriptor<Number>::format ();
    return {owner, {first, ELEMENT, format, 2, {rows, ROW / ELEMENT}, {ROW, ELEMENT}}};
  }
}

py::object
toPython (const nlohmann::ordered_json& json)
{
  return py::module_::import ("json").attr ("loads") (dump (json));
}

/// \param normals as many as points, or None
/// \param sensor_origin three numbers, or None
/// \param loop a list of indices
/// \return status, message, what strict objects to, warnings, the part of the report that the core
/// knows, and the arrays
py::tuple
run (const py::buffer& points, const py::object& normals, const py::object& sensor_origin,
     bool use_input_normals, std::vector<std::uint32_t> loop, const py::dict& given,
     const py::object& progress)
{
  Options options;
  visitOptions (options, OptionsReader{given});
  options.disc.boundary.loop = std::move (loop);
  if (options.disc.as_published)
    choosePublished (options.disc, given.contains ("boundary"), given.contains ("ordering"));
  const Problem problem = checkOptions (options);
  if (problem.status == RunStatus::INVALID_OPTION)
    throw py::value_error (problem.message);

  Input input;
  if (!sensor_origin.is_none ())
    input.sensor_origin = sensor_origin.cast<std::array<double, 3>> ();
  if (!normals.is_none ()) {
    auto copy = copyRows<Eigen::Vector3f> (normals.cast<py::buffer> ().request ());
    if (use_input_normals)
      input.normals = copy;
    if (options.facing == Facing::AUTO || options.facing == Facing::NORMALS)
      input.facing_normals = std::move (copy);
  }
  const py::buffer_info rows = points.request ();
  {
    const py::gil_scoped_release release;
    input.positions = copyRows<Eigen::Vector3d> (rows);
    input.cloud_size = input.positions.size ();
    input.cloud_index.resize (input.cloud_size);
    std::iota (input.cloud_index.begin (), input.cloud_index.end (), 0U);
  }
  if (const Problem facing = checkFacing (input, options))
    throw py::value_error (facing.message);

  const auto result = std::make_shared<Result> ();
  double seconds = 0.0;
  watch (progress, options, [&] {
    const auto start = std::chrono::steady_clock::now ();
    // The status of a cloud without points comes from the same function as for the class.
    *result = input.positions.empty () ? reconstruct (std::vector<Eigen::Vector3d> (), options)
                                       : reconstruct (std::move (input), options);
    seconds = std::chrono::duration<double> (std::chrono::steady_clock::now () - start).count ();
  });

  const Report& report = result->report;
  nlohmann::ordered_json known;
  known["options"] = optionsJson (effectiveOptions (options), use_input_normals);
  known.update (resultJson (report));
  known["seconds"] = secondsJson (report.statistics);
  known["seconds"]["reconstruction"] = seconds;
  // By the names of the report. The indices of the core are unsigned, and here signed: every cloud
  // index is below 2^31.
  const py::dict arrays (
      "triangles"_a = arrayOf (result, result->triangles), "loop"_a = arrayOf (result, report.loop),
      "unused"_a = arrayOf (result, report.unused),
      "outliers"_a = arrayOf (result, report.outliers),
      "scatter"_a = arrayOf (result, report.scatter),
      "non_finite"_a = arrayOf (result, report.non_finite),
      "duplicates"_a = arrayOf (result, report.duplicates),
      "parameters"_a = report.parameters.empty () ? py::none ()
                                                  : py::cast (arrayOf (result, report.parameters)));
  return py::make_tuple (statusName (report.status), report.message, objectionTo (report),
                         report.warnings, toPython (known), arrays);
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// \param buffer contiguous, of the shape (m, 3) of uint32
Triangles
copyTriangles (const py::buffer& buffer)
{
  const py::buffer_info info = buffer.request ();
  const auto* first = static_cast<const Triangles::value_type*> (info.ptr);
  return {first, first + info.shape[0]};
}

ResultArray
normalsOf (const py::buffer& points, const py::buffer& triangles, int threads)
{
  const py::buffer_info rows = points.request ();
  const Triangles corners = copyTriangles (triangles);
  const auto normals = std::make_shared<std::vector<Eigen::Vector3f>> ();
  {
    const py::gil_scoped_release release;
    *normals = vertexNormals (copyRows<Eigen::Vector3d> (rows), corners, threads);
  }
  return arrayOf (normals, *normals);
}

/// \return status, message, figures, and the arrays
py::tuple
textureOf (const py::buffer& points, const py::buffer& triangles, double largest_stretch,
           bool whole_discs, int threads, const py::object& progress)
{
  const py::buffer_info rows = points.request ();
  const Triangles corners = copyTriangles (triangles);
  TextureOptions options;
  options.largest_stretch = largest_stretch;
  options.whole_discs = whole_discs;
  options.threads = threads;
  const auto texture = std::make_shared<TextureCoordinates> ();
  watch (progress, options, [&] {
    *texture = computeTextureCoordinates (copyRows<Eigen::Vector3d> (rows), corners, options);
  });
  const py::dict figures ("charts"_a = texture->chart_count, "flipped"_a = texture->flipped,
                          "stretch"_a = texture->stretch,
                          "largest_stretch"_a = texture->largest_stretch,
                          "area_used"_a = texture->area_used,
                          "seam_length"_a = texture->seam_length, "gutter"_a = texture->gutter);
  const py::dict arrays ("coordinates"_a = arrayOf (texture, texture->coordinates),
                         "points"_a = arrayOf (texture, texture->points),
                         "corners"_a = arrayOf (texture, texture->corners),
                         "charts"_a = arrayOf (texture, texture->charts),
                         "seams"_a = arrayOf (texture, texture->seams));
  return py::make_tuple (statusName (texture->status), texture->message, figures, arrays);
}

} // namespace
} // namespace pcl::floater

PYBIND11_MODULE (_core, module)
{
  using namespace pcl::floater;
  module.doc () = "The compiled part of pcl_floater.";
  module.attr ("__version__") = PCL_FLOATER_VERSION;
  py::class_<ResultArray> (module, "ResultArray", py::buffer_protocol ())
      .def_buffer ([] (const ResultArray& array) {
        const py::buffer_info& v = array.view;
        return py::buffer_info (v.ptr, v.itemsize, v.format, v.ndim, v.shape, v.strides);
      });
  module.def ("run", &run);
  module.def ("options", [] { return toPython (optionTableJson ()); });
  module.def ("vertex_normals", &normalsOf);
  module.def ("texture_coordinates", &textureOf);
}
