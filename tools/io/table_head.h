// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Text with one point in each line: what comes before the first point, how a line is cut into
// columns, and what the columns hold.
#pragma once

#include "text_scanner.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl::floater {
using Words = std::vector<std::string_view>;

/// How the columns of a line are separated.
struct ColumnSeparator
{
  char separator = ' ';           ///< ' ' stands for any number of blanks and tabs
  bool has_decimal_comma = false; ///< 1,5 is a number
};

/// What a column is: an index of KNOWN, or OTHER.
enum ColumnKind : std::size_t
{
  X = 0,
  Z = 2,
  RED = 3,
  ALPHA = 6,
  NORMAL_X = 7,
  INTENSITY = 10,
  OTHER = 11
};

/// What columns are called; the first name of each is that of the field, and earlier ones go first.
constexpr std::array<std::array<std::string_view, 10>, OTHER> KNOWN{
    {{"x", "easting", "east", "coord_x", "longitude", "lon", "long", "lng", "points:0", "points_0"},
     {"y", "northing", "north", "coord_y", "latitude", "lat", "points:1", "points_1"},
     {"z", "elevation", "height", "coord_z", "altitude", "alt", "depth", "up", "points:2",
      "points_2"},
     {"red", "r"},
     {"green", "g"},
     {"blue", "b"},
     {"alpha", "a"},
     {"nx", "normal_x", "normalx", "n_x"},
     {"ny", "normal_y", "normaly", "n_y"},
     {"nz", "normal_z", "normalz", "n_z"},
     {"intensity", "i", "reflectance"}}};

struct Column
{
  std::size_t kind = OTHER;
  std::string name;       ///< of an OTHER
  bool is_number = true;  ///< else it is text, and is skipped
  bool are_bytes = true;  ///< all values are whole numbers from 0 to 255
  bool fits_float = true; ///< a 32-bit float tells each value from its neighbours in the text

  bool isColor () const { return kind >= RED && kind <= ALPHA; }
};

/// What comes before the first point.
struct TableHead
{
  std::vector<Column> columns;
  bool has_names = false;
  bool are_names_comment = false;
  ColumnSeparator separator;
  std::optional<std::uint64_t> count; ///< points that the file promises
  std::size_t skipped = 0;            ///< lines that are neither names, a count nor comments
  std::string first_skipped;
  std::string_view last_line; ///< the last of them, which may have been names
};

/// Without blanks and quotes around.
inline std::string_view
trim (std::string_view text)
{
  const auto isOuter = [] (char c) { return TextScanner::isBlank (c) || c == '"'; };
  while (!text.empty () && isOuter (text.front ()))
    text.remove_prefix (1);
  while (!text.empty () && isOuter (text.back ()))
    text.remove_suffix (1);
  return text;
}

/// Cuts a line into columns, without blanks and quotes around them. An empty last one is left out.
/// \return whether it was
inline bool
splitColumns (std::string_view line, char separator, Words& columns)
{
  columns.clear ();
  const bool by_blanks = separator == ' ';
  for (std::size_t first = 0, end = 0; first <= line.size (); first = end + 1) {
    end = first;
    while (end < line.size () &&
           !(by_blanks ? TextScanner::isBlank (line[end]) : line[end] == separator))
      ++end;
    if (!by_blanks || end > first)
      columns.push_back (trim (line.substr (first, end - first)));
  }
  const bool ends_empty = !by_blanks && columns.back ().empty ();
  if (ends_empty)
    columns.pop_back ();
  return ends_empty;
}

/// Parses a column as a number; an empty one is NaN.
/// \return false if it is neither
inline bool
parseColumn (std::string_view column, bool has_decimal_comma, double& number)
{
  number = std::numeric_limits<double>::quiet_NaN ();
  const std::size_t comma = has_decimal_comma ? column.find (',') : std::string_view::npos;
  if (comma == std::string_view::npos)
    return column.empty () || parseNumber (column, number);
  std::string with_point (column);
  with_point[comma] = '.';
  return parseNumber (std::string_view (with_point), number);
}

/// The word without a unit behind an underscore: "z" of "z_m".
inline std::string_view
withoutUnit (std::string_view name)
{
  const std::size_t at = std::min (name.rfind ('_'), name.size ());
  for (const std::string_view unit :
       {"_m", "_mm", "_cm", "_km", "_ft", "_deg", "_meters", "_metres"})
    if (name.substr (at) == unit)
      return name.substr (0, at);
  return name;
}

/// The line without what makes it a comment: #, //, %; nothing if it is none.
inline std::optional<std::string_view>
commentText (std::string_view line)
{
  line = trim (line);
  for (const std::string_view mark : {"#", "//", "%"})
    if (line.substr (0, mark.size ()) == mark) {
      while (!line.empty () &&
             (line.front () == mark.front () || TextScanner::isBlank (line.front ())))
        line.remove_prefix (1);
      return line;
    }
  return std::nullopt;
}

/// Whether the line begins or ends a scan, as in some .pts files.
inline bool
isBlockMark (std::string_view line)
{
  return isWord (trim (line), "begin") || isWord (trim (line), "end");
}

/// The only word of a line, if it is a whole number.
inline std::optional<std::uint64_t>
countOf (std::string_view line)
{
  std::uint64_t count = 0;
  return parseNumber (trim (line), count) ? std::optional (count) : std::nullopt;
}

/// Reads up to the first point, and that line.
/// \return its text
std::string_view
readHead (TextScanner& scanner, const std::array<std::size_t, 3>& chosen, TableHead& head);

} // namespace pcl::floater
