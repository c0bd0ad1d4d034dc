// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "result_arrays.h"

#include "keywords.h"
#include "watch.h"

#include <pcl/surface/floater/texture_coordinates.h>
#include <pcl/surface/floater/vertex_normals.h>

#include <array>
#include <memory>

namespace py = pybind11;

namespace pcl::floater {
namespace {
struct ResultArray
{
  std::shared_ptr<const void> owner;
  const void* first = nullptr;
  const char* format = "i"; ///< of the elements: "i", "f" or "d"
  std::size_t rows = 0;
  std::size_t columns = 0; ///< 0: an array of one dimension
};

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

/// \param owner of the values, which are numbers or arrays of numbers
template <typename T>
ResultArray
arrayOf (const std::shared_ptr<const void>& owner, const std::vector<T>& values)
{
  if constexpr (std::is_arithmetic_v<T>)
    return {owner, values.data (), "i", values.size (), 0};
  else {
    using Number = typename T::value_type;
    const char* const format = std::is_same_v<Number, float>    ? "f"
                               : std::is_same_v<Number, double> ? "d"
                                                                : "i";
    return {owner, values.data (), format, values.size (), sizeof (T) / sizeof (Number)};
  }
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
  py::dict arrays;
  arrays["triangles"] = arrayOf (result, result->triangles);
  arrays["loop"] = arrayOf (result, report.loop);
  arrays["unused"] = arrayOf (result, report.unused);
  arrays["outliers"] = arrayOf (result, report.outliers);
  arrays["scatter"] = arrayOf (result, report.scatter);
  arrays["non_finite"] = arrayOf (result, report.non_finite);
  arrays["duplicates"] = arrayOf (result, report.duplicates);
  arrays["parameters"] =
      report.parameters.empty () ? py::none () : py::cast (arrayOf (result, report.parameters));
  return arrays;
}

namespace {
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// \param buffer as _arrays.py makes it
Triangles
copyTriangles (const py::buffer& buffer)
{
  const py::buffer_info info = buffer.request ();
  const auto* first = static_cast<const Triangles::value_type*> (info.ptr);
  return {first, first + info.shape[0]};
}

/// \return an array of the shape (n, 3) of float
ResultArray
normalsOf (const py::buffer& points, const py::buffer& triangles, int threads)
{
  const PointRows rows (points);
  const Triangles corners = copyTriangles (triangles);
  const auto normals = std::make_shared<std::vector<Eigen::Vector3f>> ();
  {
    const py::gil_scoped_release release;
    *normals = vertexNormals (rows.copy<Eigen::Vector3d> (), corners, threads);
  }
  return arrayOf (normals, *normals);
}

/// \return status, message, figures, and the arrays
py::tuple
textureOf (const py::buffer& points, const py::buffer& triangles, double largest_stretch,
           bool whole_discs, int threads, const py::object& progress)
{
  const PointRows rows (points);
  const Triangles corners = copyTriangles (triangles);
  TextureOptions options;
  options.largest_stretch = largest_stretch;
  options.whole_discs = whole_discs;
  options.threads = threads;
  Watch watch (progress);
  watch.attachTo (options);
  const auto texture = std::make_shared<TextureCoordinates> ();
  {
    const py::gil_scoped_release release;
    *texture = computeTextureCoordinates (rows.copy<Eigen::Vector3d> (), corners, options);
  }
  watch.rethrow ();
  py::dict figures;
  figures["charts"] = texture->chart_count;
  figures["flipped"] = texture->flipped;
  figures["stretch"] = texture->stretch;
  figures["largest_stretch"] = texture->largest_stretch;
  figures["area_used"] = texture->area_used;
  figures["seam_length"] = texture->seam_length;
  figures["gutter"] = texture->gutter;
  py::dict arrays;
  arrays["coordinates"] = arrayOf (texture, texture->coordinates);
  arrays["points"] = arrayOf (texture, texture->points);
  arrays["corners"] = arrayOf (texture, texture->corners);
  arrays["charts"] = arrayOf (texture, texture->charts);
  arrays["seams"] = arrayOf (texture, texture->seams);
  return py::make_tuple (statusName (texture->status), texture->message, figures, arrays);
}

} // namespace

void
defineMeshFunctions (py::module_& module)
{
  module.def ("vertex_normals", &normalsOf);
  module.def ("texture_coordinates", &textureOf);
}

} // namespace pcl::floater
