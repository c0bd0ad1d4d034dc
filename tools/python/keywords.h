// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Keyword arguments of Python, and the options of a run that they are.
#pragma once

#include <pcl/surface/floater/options.h>

#include <pybind11/pybind11.h>

namespace pcl::floater {
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
