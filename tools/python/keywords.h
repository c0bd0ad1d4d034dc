// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Keyword arguments of Python, and the options of a run that they are.
#pragma once

#include <Eigen/Core>
#include <pcl/surface/floater/options.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace pcl::floater {
/// Rows of three numbers in an array of NumPy, wherever they are in memory: of float or double, as
/// _arrays.py makes sure.
class PointRows
{
public:
  /// \throws pybind11::value_error
  explicit PointRows (const pybind11::buffer& buffer) : info_ (buffer.request ())
  {
    if (info_.shape[0] > std::numeric_limits<std::int32_t>::max ())
      throw pybind11::value_error ("more than 2147483647 points; reconstruct parts of the cloud");
  }

  std::size_t size () const { return static_cast<std::size_t> (info_.shape[0]); }

  /// The only copy of the points that is made. \tparam Vector of Eigen, with three elements
  template <typename Vector>
  std::vector<Vector> copy () const
  {
    return info_.itemsize == 4 ? copyOf<Vector, float> () : copyOf<Vector, double> ();
  }

private:
  template <typename Vector, typename Number>
  std::vector<Vector> copyOf () const
  {
    using To = typename Vector::Scalar;
    std::vector<Vector> rows (size ());
    const char* row = static_cast<const char*> (info_.ptr);
    for (Vector& vector : rows) {
      for (pybind11::ssize_t axis = 0; axis < 3; ++axis) {
        Number number; // the memory need not be aligned
        std::memcpy (&number, row + axis * info_.strides[1], sizeof (number));
        vector[axis] = static_cast<To> (number);
      }
      row += info_.strides[0];
    }
    return rows;
  }

  pybind11::buffer_info info_;
};

/// What the keyword arguments say.
struct GivenOptions
{
  Options options;                ///< as given: what TW 385 sets otherwise is not set yet
  bool use_input_normals = false; ///< for tangent planes
};

/// Reads the options from a dict of keyword arguments. Those that it does not have keep their
/// defaults.
/// \throws pybind11::type_error, pybind11::value_error with the name of the argument: it is
/// unknown, of a wrong type, no word of those that are possible, or too large for its type. Ranges
/// are checked by checkOptions ()
GivenOptions
readKeywords (const pybind11::dict& keywords);

/// Reads three numbers.
/// \param name of the argument, for messages
/// \throws pybind11::type_error, pybind11::value_error
std::array<double, 3>
readPlace (const char* name, const pybind11::handle& value);

} // namespace pcl::floater
