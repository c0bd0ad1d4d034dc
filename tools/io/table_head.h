// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Text with one point in each line: what comes before the first point, how a line is cut into
// columns, and what the columns hold.
#pragma once

#include "cloud_reader.h"
#include "text_scanner.h"

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
  constexpr const char* OUTER = " \t\r\v\f\"";
  text.remove_prefix (std::min (text.find_first_not_of (OUTER), text.size ()));
  return text.substr (0, text.find_last_not_of (OUTER) + 1); // npos + 1 is 0
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

/// Whether a column is called by a known name: with a unit, and, if it is long, with anything behind.
inline bool
isCalled (std::string_view name, std::string_view known)
{
  constexpr std::size_t LONG = 7; // letters: easting, latitude
  return !known.empty () && (withoutUnit (name) == known || name == known ||
                             (known.size () >= LONG && name.substr (0, known.size ()) == known));
}

/// Columns that a header names: "x,y,z,red,green,blue", "//X Y Z R G B". The names are compared in
/// lower case and without a unit: "X [m]" is "x".
inline std::vector<Column>
columnsOfHeader (std::string_view line, char separator)
{
  constexpr std::string_view SCALAR = "scalar_"; // what CloudCompare puts before its fields
  Words words;
  std::vector<Column> columns;
  splitColumns (line, separator, words);
  for (const std::string_view text : words) {
    if (!text.empty () && text.back () == ':') // "columns: x y z"
      continue;
    std::string& name = columns.emplace_back ().name;
    name = trim (text.substr (0, text.find_first_of ("[(")));
    for (char& c : name)
      c = TextScanner::isBlank (c) ? '_' : lowerCase (c);
    if (name.rfind (SCALAR, 0) == 0)
      name.erase (0, SCALAR.size ());
  }
  // One of each kind, the first of those with the best name; others are fields like any other.
  std::array<bool, OTHER> has{};
  for (std::size_t kind = 0; kind < OTHER; ++kind)
    for (const std::string_view name : KNOWN[kind]) {
      const auto found =
          std::find_if (columns.begin (), columns.end (), [name] (const Column& one) {
            return one.kind == OTHER && isCalled (one.name, name);
          });
      if (found == columns.end () || has[kind])
        continue;
      found->kind = kind;
      has[kind] = true;
    }
  const bool has_color = has[RED] && has[RED + 1] && has[RED + 2];
  const bool has_normal = has[NORMAL_X] && has[NORMAL_X + 1] && has[NORMAL_X + 2];
  for (Column& column : columns)
    if ((column.isColor () && !has_color) ||
        (column.kind > ALPHA && column.kind < INTENSITY && !has_normal))
      column.kind = OTHER;
  return columns;
}

/// The columns by the first separator that makes the line a header with x, y and z; empty if none
/// does.
inline std::vector<Column>
namedColumns (std::string_view line)
{
  for (const char separator : {';', ',', ' '}) {
    std::vector<Column> columns = columnsOfHeader (line, separator);
    if (std::count_if (columns.begin (), columns.end (),
                       [] (const Column& column) { return column.kind <= Z; }) == 3)
      return columns;
  }
  return {};
}

/// Whether words are a point with these columns. Marks the columns that are no numbers.
inline bool
isPoint (const Words& words, const ColumnSeparator& separator, std::vector<Column>& columns)
{
  const bool may_lack_last = separator.separator != ' '; // which is empty then
  if (words.size () > columns.size () || words.size () + (may_lack_last ? 1 : 0) < columns.size ())
    return false;
  bool is_point = true;
  for (std::size_t c = 0; c < columns.size (); ++c) {
    const std::string_view word = c < words.size () ? words[c] : std::string_view ();
    double number = 0.0;
    columns[c].is_number = parseColumn (word, separator.has_decimal_comma, number);
    if (columns[c].kind <= Z)
      is_point &= columns[c].is_number && !word.empty ();
  }
  return is_point;
}

/// The columns of x, y and z are those that the user has chosen.
inline void
chooseColumns (const std::array<std::size_t, 3>& chosen, std::vector<Column>& columns)
{
  for (Column& column : columns)
    if (column.kind <= Z) {
      column.kind = OTHER;
      column.name.clear (); // which is taken
    }
  for (std::size_t axis = 0; axis < 3; ++axis)
    columns[chosen[axis] - 1].kind = axis;
}

/// \throws ReadError if the line before the first point has names for all columns, which are not
/// those of coordinates. Blanks separate words of a sentence as well.
inline void
refuseHeader (std::string_view line, const ColumnSeparator& separator)
{
  constexpr std::size_t LONGEST = 300; // characters of it in the message
  Words words;
  splitColumns (line, separator.separator, words);
  double number = 0.0;
  for (const std::string_view word : words)
    if (word.empty () || parseColumn (word, separator.has_decimal_comma, number))
      return;
  if (separator.separator != ' ' || words.size () > 3)
    throw ReadError ("its header " + quoted (line, LONGEST) +
                     " names no x, y and z: name them there, or choose their columns by number, "
                     "such as --columns 2,3,4");
}

/// Takes the line for that of the first point: finds how its columns are separated, and which of
/// them are numbers.
/// \param chosen columns of x, y and z, from 1; zeros: what the header says, or the first three
/// \return false if it is none
inline bool
isFirstPoint (std::string_view line, const std::array<std::size_t, 3>& chosen, TableHead& head)
{
  constexpr std::size_t MOST_COLUMNS = 256;
  const bool is_chosen = chosen[0] > 0;
  const std::size_t fewest = std::max ({std::size_t{3}, chosen[0], chosen[1], chosen[2]});
  Words words;
  for (const ColumnSeparator separator :
       {ColumnSeparator{';', false}, ColumnSeparator{';', true}, ColumnSeparator{',', false},
        ColumnSeparator{' ', false}, ColumnSeparator{' ', true}}) {
    splitColumns (line, separator.separator, words);
    if (words.size () < fewest || words.size () > MOST_COLUMNS)
      continue;
    const std::vector<Column> header = columnsOfHeader (head.last_line, separator.separator);
    const bool is_header = header.size () == words.size ();
    if (is_chosen && !head.has_names)
      head.columns = is_header ? header : std::vector<Column> (words.size ());
    if (is_chosen && words.size () <= head.columns.size ()) // else it is no point
      chooseColumns (chosen, head.columns);
    std::vector<Column> plain (words.size ());
    chooseColumns ({1, 2, 3}, plain);
    const bool is_named = (head.has_names || is_chosen) && isPoint (words, separator, head.columns);
    // A comment may have been one about x, y and z only.
    const bool may_be_plain = !is_chosen && (!head.has_names || head.are_names_comment);
    if (!is_named && !(may_be_plain && isPoint (words, separator, plain)))
      continue;
    if (is_chosen && !head.has_names && is_header)
      --head.skipped; // they are names
    if (!is_named && !head.has_names && is_header)
      refuseHeader (head.last_line, separator);
    if (!is_named)
      head.columns = std::move (plain);
    head.has_names = is_named;
    head.separator = separator;
    return true;
  }
  return false;
}

/// Reads up to the first point, and that line.
/// \return its text
inline std::string_view
readHead (TextScanner& scanner, const std::array<std::size_t, 3>& chosen, TableHead& head)
{
  constexpr std::size_t LONGEST = 1U << 16U; // characters; a line that is longer is no text
  constexpr std::size_t MOST_SKIPPED = 1000; // lines; a file with more before its points has none
  const auto withoutPoints = [&head, is_chosen = chosen[0] > 0] (const std::string& where) {
    return ReadError ("it has no points: no line" + where + " has three numbers, x, y and z" +
                      (is_chosen        ? ", in the columns of --columns"
                       : head.has_names ? ", in the columns that its header names"
                                        : "") +
                      (head.skipped > 0 ? "; it begins with " + head.first_skipped : "") +
                      (is_chosen ? "" : "; --columns chooses other columns than the first three"));
  };
  while (scanner.nextFilledLine ()) {
    const std::string_view line = scanner.restOfLine ();
    const std::optional<std::string_view> comment = commentText (line);
    const bool is_text = line.size () <= LONGEST;
    std::vector<Column> named;
    if (is_text)
      named = namedColumns (comment.value_or (line));
    if (!named.empty ()) {
      head.columns = std::move (named);
      head.has_names = true;
      head.are_names_comment = comment.has_value ();
    }
    else if (comment || isBlockMark (line))
      continue;
    else if (const auto count = countOf (line); count && !head.count)
      head.count = count;
    else if (line.substr (0, 5) == "ncols" || line.substr (0, 5) == "NCOLS")
      throw ReadError ("it is a grid of heights (ESRI ASCII), not a list of points; convert it: "
                       "gdal_translate -of XYZ a.asc a.xyz");
    else if (is_text && isFirstPoint (line, chosen, head))
      return line;
    else {
      head.last_line = line.substr (0, LONGEST);
      if (head.skipped++ == 0)
        head.first_skipped = quoted (line);
    }
    if (head.skipped > MOST_SKIPPED)
      throw withoutPoints (" of the first " + std::to_string (MOST_SKIPPED));
  }
  throw withoutPoints ("");
}

} // namespace pcl::floater
