// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "table_columns.h"

#include "text_scanner.h"

#include <algorithm>
#include <limits>

namespace pcl::floater {
namespace {
bool
isBlank (char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

std::string_view
trim (std::string_view text)
{
  while (!text.empty () && (isBlank (text.front ()) || text.front () == '"'))
    text.remove_prefix (1);
  while (!text.empty () && (isBlank (text.back ()) || text.back () == '"'))
    text.remove_suffix (1);
  return text;
}

/// The name of a column, in lower case and without a unit: "X [m]" is "x".
std::string
plainName (std::string_view text)
{
  text = trim (text.substr (0, text.find_first_of ("[(")));
  std::string name (text);
  for (char& c : name)
    c = isBlank (c) ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c;
  constexpr std::string_view SCALAR = "scalar_"; // what CloudCompare puts before its fields
  return name.rfind (SCALAR, 0) == 0 ? name.substr (SCALAR.size ()) : name;
}

ColumnKind
kindOf (const std::string& name)
{
  struct Known
  {
    ColumnKind kind;
    std::array<std::string_view, 5> names; // those after the last are empty
  };
  static constexpr std::array<Known, 11> KNOWN{
      {{ColumnKind::X, {"x", "easting", "coord_x"}},
       {ColumnKind::Y, {"y", "northing", "coord_y"}},
       {ColumnKind::Z, {"z", "elevation", "height", "coord_z"}},
       {ColumnKind::RED, {"r", "red"}},
       {ColumnKind::GREEN, {"g", "green"}},
       {ColumnKind::BLUE, {"b", "blue"}},
       {ColumnKind::ALPHA, {"a", "alpha"}},
       {ColumnKind::NORMAL_X, {"nx", "normal_x", "normalx", "n_x"}},
       {ColumnKind::NORMAL_Y, {"ny", "normal_y", "normaly", "n_y"}},
       {ColumnKind::NORMAL_Z, {"nz", "normal_z", "normalz", "n_z"}},
       {ColumnKind::INTENSITY, {"intensity", "i", "reflectance"}}}};
  for (const Known& known : KNOWN)
    if (!name.empty () &&
        std::find (known.names.begin (), known.names.end (), name) != known.names.end ())
      return known.kind;
  return ColumnKind::OTHER;
}

} // namespace

std::string
quoted (std::string_view line)
{
  constexpr std::size_t QUOTED = 40; // characters
  std::string text;
  for (const char c : line.substr (0, QUOTED))
    text += c >= ' ' && c <= '~' ? c : '?';
  return "'" + text + (line.size () > QUOTED ? "..." : "") + "'";
}

std::vector<std::string_view>
splitColumns (std::string_view line, char separator)
{
  std::vector<std::string_view> columns;
  if (separator == ' ') {
    for (std::size_t at = 0; at < line.size ();) {
      while (at < line.size () && isBlank (line[at]))
        ++at;
      const std::size_t first = at;
      while (at < line.size () && !isBlank (line[at]))
        ++at;
      if (at > first)
        columns.push_back (trim (line.substr (first, at - first)));
    }
    return columns;
  }
  for (std::size_t first = 0; first <= line.size ();) {
    const std::size_t end = std::min (line.find (separator, first), line.size ());
    columns.push_back (trim (line.substr (first, end - first)));
    first = end + 1;
  }
  if (columns.back ().empty ())
    columns.pop_back ();
  return columns;
}

bool
parseColumn (std::string_view column, bool has_decimal_comma, double& number)
{
  if (column.empty ()) {
    number = std::numeric_limits<double>::quiet_NaN ();
    return true;
  }
  const std::size_t comma = has_decimal_comma ? column.find (',') : std::string_view::npos;
  if (comma == std::string_view::npos)
    return parseNumber (column, number);
  std::string with_point (column);
  with_point[comma] = '.';
  return parseNumber (std::string_view (with_point), number);
}

std::optional<std::vector<Column>>
namedColumns (std::string_view line)
{
  for (const char separator : {';', ',', ' '}) {
    std::vector<Column> columns;
    std::array<int, static_cast<std::size_t> (ColumnKind::OTHER)> counts{};
    for (const std::string_view text : splitColumns (line, separator)) {
      if (!text.empty () && text.back () == ':') // "columns: x y z"
        continue;
      Column column;
      column.name = plainName (text);
      column.kind = kindOf (column.name);
      // A second one of a kind is a field like any other.
      if (column.kind != ColumnKind::OTHER && counts[static_cast<std::size_t> (column.kind)]++ > 0)
        column.kind = ColumnKind::OTHER;
      columns.push_back (std::move (column));
    }
    const auto has = [&counts] (ColumnKind first) { // all three
      const auto at = static_cast<std::size_t> (first);
      return counts[at] > 0 && counts[at + 1] > 0 && counts[at + 2] > 0;
    };
    if (!has (ColumnKind::X))
      continue;
    for (Column& column : columns)
      if ((column.kind >= ColumnKind::RED && column.kind <= ColumnKind::ALPHA &&
           !has (ColumnKind::RED)) ||
          (column.kind >= ColumnKind::NORMAL_X && column.kind <= ColumnKind::NORMAL_Z &&
           !has (ColumnKind::NORMAL_X)))
        column.kind = ColumnKind::OTHER;
    return columns;
  }
  return std::nullopt;
}

std::optional<std::string_view>
commentText (std::string_view line)
{
  line = trim (line);
  for (const std::string_view mark : {"#", "//", "%"})
    if (line.substr (0, mark.size ()) == mark) {
      while (!line.empty () && (line.front () == mark.front () || isBlank (line.front ())))
        line.remove_prefix (1);
      return line;
    }
  return std::nullopt;
}

} // namespace pcl::floater
