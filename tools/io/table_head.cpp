// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "table_head.h"

#include "cloud_reader.h"

#include <limits>

namespace pcl::floater {
namespace {
/// Whether a column is called by a known name: with a unit, and, if it is long, with anything behind.
bool
isCalled (std::string_view name, std::string_view known)
{
  constexpr std::size_t LONG = 7; // letters: easting, latitude
  return !known.empty () && (withoutUnit (name) == known || name == known ||
                             (known.size () >= LONG && name.substr (0, known.size ()) == known));
}

/// A column of this name, which is compared in lower case and without a unit: "X [m]" is "x".
Column
columnOf (std::string_view text)
{
  Column column;
  column.name = trim (text.substr (0, text.find_first_of ("[(")));
  for (char& c : column.name)
    c = TextScanner::isBlank (c) ? '_' : lowerCase (c);
  constexpr std::string_view SCALAR = "scalar_"; // what CloudCompare puts before its fields
  if (column.name.rfind (SCALAR, 0) == 0)
    column.name.erase (0, SCALAR.size ());
  return column;
}

/// Columns that a header names: "x,y,z,red,green,blue", "//X Y Z R G B".
std::vector<Column>
columnsOfHeader (std::string_view line, char separator)
{
  Words words;
  std::vector<Column> columns;
  splitColumns (line, separator, words);
  for (const std::string_view text : words)
    if (text.empty () || text.back () != ':') // "columns: x y z"
      columns.push_back (columnOf (text));
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
std::vector<Column>
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
bool
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
void
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
void
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
bool
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
    if (is_chosen)
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

[[noreturn]] void
failWithoutPoints (const TableHead& head, const std::string& where, bool is_chosen)
{
  throw ReadError ("it has no points: no line" + where + " has three numbers, x, y and z" +
                   (is_chosen        ? ", in the columns of --columns"
                    : head.has_names ? ", in the columns that its header names"
                                     : "") +
                   (head.skipped > 0 ? "; it begins with " + head.first_skipped : "") +
                   (is_chosen ? "" : "; --columns chooses other columns than the first three"));
}

} // namespace

std::string_view
readHead (TextScanner& scanner, const std::array<std::size_t, 3>& chosen, TableHead& head)
{
  constexpr std::size_t LONGEST = 1U << 16U; // characters; a line that is longer is no text
  constexpr std::size_t MOST_SKIPPED = 1000; // lines; a file with more before its points has none
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
      failWithoutPoints (head, " of the first " + std::to_string (MOST_SKIPPED), chosen[0] > 0);
  }
  failWithoutPoints (head, "", chosen[0] > 0);
}

} // namespace pcl::floater
