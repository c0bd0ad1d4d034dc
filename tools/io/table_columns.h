// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Text with one point in each line: how a line is cut into columns, and what the columns hold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl::floater {
/// The beginning of a line in a message, without what is not printable.
std::string
quoted (std::string_view line);

/// How the columns of a line are separated.
struct ColumnSeparator
{
  char separator = ' ';           ///< ' ' stands for any number of blanks and tabs
  bool has_decimal_comma = false; ///< 1,5 is a number
};

/// The columns of a line, without blanks and quotes around them. An empty last one is left out.
std::vector<std::string_view>
splitColumns (std::string_view line, char separator);

/// Parses a column as a number; an empty one is NaN.
/// \return false if it is neither
bool
parseColumn (std::string_view column, bool has_decimal_comma, double& number);

/// What a column of a table is.
enum class ColumnKind
{
  X,
  Y,
  Z,
  RED,
  GREEN,
  BLUE,
  ALPHA,
  NORMAL_X,
  NORMAL_Y,
  NORMAL_Z,
  INTENSITY,
  OTHER
};

/// A column of a table.
struct Column
{
  ColumnKind kind = ColumnKind::OTHER;
  std::string name;       ///< of an OTHER
  bool is_number = true;  ///< else it is text, and is skipped
  bool are_bytes = true;  ///< all values are whole numbers from 0 to 255
  bool are_shares = true; ///< all values are from 0 to 1
  bool are_words = true;  ///< all values are whole numbers from 0 to 65535
  bool fits_float = true; ///< a 32-bit float tells each value from its neighbours in the text
};

/// Columns that a header names: "x,y,z,red,green,blue", "//X Y Z R G B".
/// \return nothing unless x, y and z are among them
std::optional<std::vector<Column>>
namedColumns (std::string_view line);

/// The line without what makes it a comment: #, //, %; nothing if it is none.
std::optional<std::string_view>
commentText (std::string_view line);

/// Colours, normals and intensity of columns that have no names, by what they hold: three columns
/// of bytes are a colour, three that are unit vectors a normal, one that is left an intensity.
/// \param columns the first three are x, y and z
/// \param is_intensity_first where there is a choice, as in a .pts file
/// \param are_unit (c) tells whether columns c, c + 1 and c + 2 hold unit vectors
template <typename AreUnit>
void
guessColumns (std::vector<Column>& columns, bool is_intensity_first, AreUnit&& are_unit)
{
  const std::size_t count = columns.size (); // 3 k + 1: one of them belongs to no three
  const auto takeThree = [&columns] (std::size_t first, ColumnKind kind) {
    for (std::size_t i = 0; i < 3; ++i)
      columns[first + i].kind = static_cast<ColumnKind> (static_cast<std::size_t> (kind) + i);
  };
  const auto areBytes = [&columns, count] (std::size_t c) {
    return c + 3 <= count && columns[c].are_bytes && columns[c + 1].are_bytes &&
           columns[c + 2].are_bytes;
  };
  bool has_color = false, has_normal = false, has_intensity = count % 3 != 1;
  for (std::size_t c = 3; c < count;) {
    const bool may_be_intensity = !has_intensity;
    if (!has_normal && c + 3 <= count && are_unit (c)) {
      takeThree (c, ColumnKind::NORMAL_X);
      has_normal = true;
      c += 3;
    }
    else if (!has_color && areBytes (c) &&
             !(may_be_intensity && is_intensity_first && areBytes (c + 1))) {
      takeThree (c, ColumnKind::RED);
      has_color = true;
      c += 3;
    }
    else {
      if (may_be_intensity) {
        columns[c].kind = ColumnKind::INTENSITY;
        has_intensity = true;
      }
      ++c;
    }
  }
}

} // namespace pcl::floater
