// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "result_arrays.h"

namespace py = pybind11;

namespace pcl::floater {
namespace {
py::buffer_info
bufferOf (const ResultArray& array)
{
  static_assert (sizeof (int) == sizeof (std::uint32_t), "the format of the indices is i");
  static_assert (sizeof (int) == sizeof (float), "the sizes of the formats i and f");
  const auto size =
      static_cast<py::ssize_t> (array.format[0] == 'd' ? sizeof (double) : sizeof (int));
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t> (array.rows)};
  std::vector<py::ssize_t> strides{size};
  if (array.columns > 0) {
    shape.push_back (static_cast<py::ssize_t> (array.columns));
    strides = {size * shape.back (), size};
  }
  static double none = 0.0; // an empty array has an address, too
  // The arrays are the user's, who may change them. The report in C++ is not read again.
  void* first = array.rows > 0 ? const_cast<void*> (array.first) : &none;
  return {first, size, array.format, static_cast<py::ssize_t> (shape.size ()), shape, strides};
}

} // namespace

void
defineResultArray (py::module_& module)
{
  py::class_<ResultArray> (module, "ResultArray", py::buffer_protocol ()).def_buffer (&bufferOf);
}

py::dict
arraysOfResult (const std::shared_ptr<const Result>& result)
{
  const Report& report = result->report;
  const auto indices = [&result] (const void* first, std::size_t rows, std::size_t columns) {
    return ResultArray{result, first, "i", rows, columns};
  };
  const auto list = [&indices] (const std::vector<std::uint32_t>& points) {
    return indices (points.data (), points.size (), 0);
  };
  py::dict arrays;
  arrays["triangles"] = indices (result->triangles.data (), result->triangles.size (), 3);
  arrays["loop"] = list (report.loop);
  arrays["unused"] = list (report.unused);
  arrays["outliers"] = list (report.outliers);
  arrays["scatter"] = list (report.scatter);
  arrays["non_finite"] = list (report.non_finite);
  arrays["duplicates"] = indices (report.duplicates.data (), report.duplicates.size (), 2);
  if (report.parameters.empty ())
    arrays["parameters"] = py::none ();
  else
    arrays["parameters"] =
        ResultArray{result, report.parameters.data (), "d", report.parameters.size (), 2};
  return arrays;
}

} // namespace pcl::floater
