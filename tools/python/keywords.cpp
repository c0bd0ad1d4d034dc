// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "keywords.h"

#include "options/check_options.h"
#include "options/option_rows.h"

#include <pybind11/stl.h>

#include <string>
#include <type_traits>

namespace py = pybind11;

namespace pcl::floater {
namespace {
std::string
shown (const py::handle& value)
{
  return std::string (py::repr (value));
}

py::type_error
wrongType (const std::string& name, const char* wanted, const py::handle& value)
{
  return py::type_error (name + " must be " + wanted + ", not " + shown (value));
}

/// numpy.bool_ is a type of its own, whose name is bool from NumPy 2 on.
bool
isBool (const py::handle& value)
{
  const std::string type = py::str (py::type::of (value).attr ("__name__"));
  return type == "bool" || type == "bool_";
}

/// Takes keyword arguments one by one, each under the name that the tool has for it.
class Keywords
{
public:
  explicit Keywords (const py::dict& given) : left_ (given.attr ("copy") ()) {}

  template <typename Number>
  void take (const char* name, Number& value)
  {
    constexpr bool IS_BOOL = std::is_same_v<Number, bool>, IS_WHOLE = std::is_same_v<Number, int>;
    const py::object given = take (name);
    if (!given)
      return;
    const bool fits = isBool (given) == IS_BOOL && (!IS_WHOLE || PyIndex_Check (given.ptr ()) != 0);
    try {
      if (fits) {
        value = given.cast<Number> ();
        return;
      }
    }
    catch (const py::cast_error&) {
      if (IS_WHOLE)
        throw py::value_error (std::string (name) + " must be a number of 32 bits, not " +
                               shown (given));
    }
    throw wrongType (name,
                     IS_BOOL    ? "True or False"
                     : IS_WHOLE ? "a whole number"
                                : "a number",
                     given);
  }

  /// One of several words.
  template <typename Enum, std::size_t N>
  void take (const char* name, Enum& value, const Choices<Enum, N>& choices)
  {
    const py::object given = take (name);
    if (!given)
      return;
    std::string words;
    for (const auto& choice : choices)
      words += (words.empty () ? "'" : ", '") + std::string (choice.first) + "'";
    if (!py::isinstance<py::str> (given))
      throw wrongType (name, ("one of " + words).c_str (), given);
    const auto word = given.cast<std::string> ();
    for (const auto& choice : choices)
      if (word == choice.first) {
        value = choice.second;
        return;
      }
    throw py::value_error (std::string (name) + " must be one of " + words + ", not " +
                           shown (given));
  }

  /// \return null if it is not given
  py::object take (const char* name)
  {
    return left_.contains (name) ? py::object (left_.attr ("pop") (name)) : py::object ();
  }

  /// \throws pybind11::type_error if something was not taken
  void finish () const
  {
    for (const auto& item : left_)
      throw py::type_error ("reconstruct() has no argument " + shown (item.first));
  }

private:
  py::dict left_;
};

// Takes the options of the table.
struct TableKeywords
{
  Keywords& keywords;

  template <typename Number>
  void operator() (const OptionRow& row, Number& value, const NumberRange&)
  {
    keywords.take (row.name, value);
  }
  void operator() (const OptionRow& row, bool& value) { keywords.take (row.name, value); }
  template <typename Enum, std::size_t N>
  void operator() (const OptionRow& row, Enum& value, const Choices<Enum, N>& choices)
  {
    keywords.take (row.name, value, choices);
  }
  void operator() (const OptionRow& row, HoleOptions& holes, LengthUnit unit)
  {
    double size = 0.0;
    keywords.take (row.name, size);
    if (size == 0.0)
      return;
    if (holes.largest_hole != 0.0)
      throw py::value_error (
          "largest_hole and largest_hole_length are one size in two units; give one of them");
    holes.largest_hole = size;
    holes.unit = unit;
  }
  void operator() (const OptionRow& row, ViewOptions& view)
  {
    const py::object given = keywords.take (row.name);
    if (!given)
      return;
    if (given.is_none ())
      throw py::type_error (
          "viewpoint must be 'auto', 'none' or three numbers; 'none' says that the cloud is no "
          "single scan");
    if (!py::isinstance<py::str> (given)) {
      view.use = ViewUse::GIVEN;
      view.viewpoint = readPlace (row.name, given);
      return;
    }
    const auto word = given.cast<std::string> ();
    if (word != "auto" && word != "none")
      throw py::value_error ("viewpoint must be 'auto', 'none' or three numbers, not " +
                             shown (given));
    view.use = word == "auto" ? ViewUse::AUTO : ViewUse::NEVER;
  }
};

} // namespace

std::array<double, 3>
readPlace (const char* name, const py::handle& value)
{
  const bool is_list = PySequence_Check (value.ptr ()) != 0 && !py::isinstance<py::str> (value);
  if (is_list && py::len (value) != 3)
    throw py::value_error (std::string (name) + " must be three numbers, not " + shown (value));
  try {
    if (is_list)
      return value.cast<std::array<double, 3>> ();
  }
  catch (const py::cast_error&) { // is told below
  }
  throw wrongType (name, "three numbers", value);
}

GivenOptions
readKeywords (const py::dict& keywords)
{
  GivenOptions asked;
  DiscOptions& disc = asked.options.disc;
  Keywords taken (keywords);
  visitOptions (asked.options, TableKeywords{taken});
  taken.take ("use_input_normals", asked.use_input_normals);
  if (const py::object loop = taken.take ("loop"))
    for (const py::handle& index : loop)
      disc.boundary.loop.push_back (index.cast<std::uint32_t> ());
  if (disc.as_published)
    choosePublished (disc, keywords.contains ("boundary"), keywords.contains ("ordering"));
  taken.finish ();
  return asked;
}

} // namespace pcl::floater
