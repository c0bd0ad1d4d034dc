// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Text with one point in each line: what comes before the first point, how a line is cut into
// columns, and what the columns hold.
#pragma once

#include "text_scanner.h"

#include <array>
#include <cstdint>
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

/// Cuts a line into columns, without blanks and quotes around them. An empty last one is left out.
/// \return whether it was
bool
splitColumns (std::string_view line, char separator, Words& columns);

/// Parses a column as a number; an empty one is NaN.
/// \return false if it is neither
bool
parseColumn (std::string_view column, bool has_decimal_comma, double& number);

/// The word without a unit behind an underscore: "z" of "z_m".
std::string_view
withoutUnit (std::string_view name);

/// The line without what makes it a comment: #, //, %; nothing if it is none.
std::optional<std::string_view>
commentText (std::string_view line);

/// Whether the line begins or ends a scan, as in some .pts files.
bool
isBlockMark (std::string_view line);

/// The only word of a line, if it is a whole number.
std::optional<std::uint64_t>
countOf (std::string_view line);

/// Reads up to the first point, and that line.
/// \return its text
std::string_view
readHead (TextScanner& scanner, const std::array<std::size_t, 3>& chosen, TableHead& head);

} // namespace pcl::floater
