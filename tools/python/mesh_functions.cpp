// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_functions.h"

#include "point_rows.h"
#include "result_arrays.h"
#include "watch.h"

#include <pcl/surface/floater/texture_coordinates.h>
#include <pcl/surface/floater/vertex_normals.h>

#include <algorithm>
#include <array>
#include <memory>

namespace py = pybind11;

namespace pcl::floater {
namespace {
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// \throws pybind11::value_error
Triangles
copyTriangles (const py::buffer& buffer)
{
  const py::buffer_info info = buffer.request ();
  const py::ssize_t size = sizeof (std::uint32_t);
  const bool is_right = info.format == py::format_descriptor<std::uint32_t>::format () &&
                        info.ndim == 2 && info.shape[1] == 3 && info.strides[1] == size &&
                        info.strides[0] == 3 * size;
  if (!is_right)
    throw py::value_error ("a contiguous array of the shape (m, 3) of uint32 is expected");
  Triangles triangles (static_cast<std::size_t> (info.shape[0]));
  const auto* first = static_cast<const std::uint32_t*> (info.ptr);
  for (std::size_t t = 0; t < triangles.size (); ++t)
    std::copy (first + 3 * t, first + 3 * (t + 1), triangles[t].begin ());
  return triangles;
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
  return {normals, normals->data (), "f", normals->size (), 3};
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
  arrays["coordinates"] =
      ResultArray{texture, texture->coordinates.data (), "f", texture->coordinates.size (), 2};
  arrays["points"] = ResultArray{texture, texture->points.data (), "i", texture->points.size (), 0};
  arrays["corners"] =
      ResultArray{texture, texture->corners.data (), "i", texture->corners.size (), 3};
  arrays["charts"] = ResultArray{texture, texture->charts.data (), "i", texture->charts.size (), 0};
  arrays["seams"] = ResultArray{texture, texture->seams.data (), "i", texture->seams.size (), 2};
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
