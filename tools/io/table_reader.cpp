// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"
#include "plural.h"
#include "table.h"
#include "text_scanner.h"

#include <algorithm>
#include <optional>

namespace pcl::floater {
namespace {
constexpr std::size_t MOST_COLUMNS = 256;

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
};

/// The only word of a line, if it is a whole number.
std::optional<std::uint64_t>
countOf (std::string_view line)
{
  const std::vector<std::string_view> words = splitColumns (line, ' ');
  std::uint64_t count = 0;
  return words.size () == 1 && parseNumber (words[0], count) ? std::optional (count) : std::nullopt;
}

/// Whether words are a point with these columns. Marks the columns that are no numbers.
bool
isPoint (const std::vector<std::string_view>& words, const ColumnSeparator& separator,
         std::vector<Column>& columns)
{
  const bool may_lack_last = separator.separator != ' '; // which is empty then
  if (words.size () > columns.size () || words.size () + (may_lack_last ? 1 : 0) < columns.size ())
    return false;
  bool is_point = true;
  for (std::size_t c = 0; c < columns.size (); ++c) {
    const std::string_view word = c < words.size () ? words[c] : std::string_view ();
    double number = 0.0;
    columns[c].is_number = parseColumn (word, separator.has_decimal_comma, number);
    if (columns[c].kind <= ColumnKind::Z)
      is_point &= columns[c].is_number && !word.empty ();
  }
  return is_point;
}

/// Takes the line for that of the first point: finds how its columns are separated, and which of
/// them are numbers.
/// \return false if it is none
bool
isFirstPoint (std::string_view line, TableHead& head)
{
  for (const ColumnSeparator separator :
       {ColumnSeparator{';', false}, ColumnSeparator{';', true}, ColumnSeparator{',', false},
        ColumnSeparator{' ', false}, ColumnSeparator{' ', true}}) {
    const std::vector<std::string_view> words = splitColumns (line, separator.separator);
    if (words.size () < 3 || words.size () > MOST_COLUMNS)
      continue;
    std::vector<Column> plain (words.size ());
    for (std::size_t axis = 0; axis < 3; ++axis)
      plain[axis].kind = static_cast<ColumnKind> (axis);
    const bool is_named = head.has_names && isPoint (words, separator, head.columns);
    // A comment may have been one about x, y and z only.
    const bool may_be_plain = !head.has_names || head.are_names_comment;
    if (!is_named && !(may_be_plain && isPoint (words, separator, plain)))
      continue;
    if (!is_named)
      head.columns = std::move (plain);
    head.has_names = is_named;
    head.separator = separator;
    return true;
  }
  return false;
}

[[noreturn]] void
failWithoutPoints (const TableHead& head, const std::string& where)
{
  std::string cause = "it has no points: no line" + where + " has three numbers, x, y and z";
  if (head.has_names)
    cause += ", in the columns that its header names";
  if (head.skipped > 0)
    cause += "; it begins with " + head.first_skipped;
  throw ReadError (cause);
}

/// Reads up to the first point, and that line.
/// \return its text
std::string_view
readHead (TextScanner& scanner, TableHead& head)
{
  constexpr std::size_t LONGEST = 1U << 16U; // characters; a line that is longer is no text
  constexpr std::size_t MOST_SKIPPED = 1000; // lines; a file with more before its points has none
  while (scanner.nextFilledLine ()) {
    const std::string_view line = scanner.restOfLine ();
    const std::optional<std::string_view> comment = commentText (line);
    const bool is_text = line.size () <= LONGEST;
    if (std::optional<std::vector<Column>> named;
        is_text && (named = namedColumns (comment.value_or (line)))) {
      head.columns = std::move (*named);
      head.has_names = true;
      head.are_names_comment = comment.has_value ();
    }
    else if (comment)
      continue;
    else if (const auto count = is_text ? countOf (line) : std::nullopt; count && !head.count)
      head.count = count;
    else if (line.substr (0, 5) == "ncols" || line.substr (0, 5) == "NCOLS")
      throw ReadError ("it is a grid of heights (ESRI ASCII), not a list of points; convert it: "
                       "gdal_translate -of XYZ a.asc a.xyz");
    else if (is_text && isFirstPoint (line, head))
      return line;
    else if (head.skipped++ == 0)
      head.first_skipped = quoted (line);
    if (head.skipped > MOST_SKIPPED)
      failWithoutPoints (head, " of the first " + std::to_string (MOST_SKIPPED));
  }
  failWithoutPoints (head, "");
}

/// More lines than that there are not: each ends with a newline, and a value takes a character.
std::size_t
mostRows (std::string_view text, std::size_t columns)
{
  const auto lines = static_cast<std::size_t> (std::count (text.begin (), text.end (), '\n')) + 1;
  return std::min (lines, text.size () / columns + 1) + 1;
}

void
checkCount (const TableHead& head, std::size_t rows, std::vector<std::string>& warnings)
{
  if (!head.count || *head.count == rows)
    return;
  if (*head.count > rows)
    throw ReadError ("its first line promises " + std::to_string (*head.count) +
                     " points, but the file has only " + std::to_string (rows) +
                     "; it is truncated or that line is wrong");
  warnings.push_back ("the first line of the input file promises " + std::to_string (*head.count) +
                      " points, but there are " + std::to_string (rows) + "; all were taken");
}

} // namespace

Cloud
parseTable (const FileBytes& file, bool is_intensity_first)
{
  const std::string_view text = file.view ();
  for (const std::string_view mark : {"\xff\xfe", "\xfe\xff"})
    if (text.substr (0, 2) == mark)
      throw ReadError ("it is text in UTF-16; save it as UTF-8");
  TextScanner scanner (text);
  TableHead head;
  std::string_view line = readHead (scanner, head);
  const bool has_names = head.has_names;
  Table table (head.columns, head.separator, mostRows (scanner.rest (), head.columns.size ()));
  table.readRow (scanner, line);
  while (scanner.nextFilledLine ()) {
    line = scanner.restOfLine ();
    const char first = line.front ();
    if ((first == '#' || first == '/' || first == '%') && commentText (line))
      continue;
    // Scans one after the other, each with its count.
    if (head.count && line.size () <= 20)
      if (const std::optional<std::uint64_t> more = countOf (line)) {
        *head.count += *more;
        continue;
      }
    table.readRow (scanner, line);
  }
  std::vector<std::string> warnings;
  if (head.skipped > 0)
    warnings.push_back (counted (head.skipped, "line") + " at the beginning of the input file " +
                        (head.skipped == 1 ? "is no point and was" : "are no points and were") +
                        " left out: " + head.first_skipped);
  if (head.separator.has_decimal_comma)
    warnings.emplace_back ("commas in the numbers of the input file were read as decimal points");
  checkCount (head, table.rows (), warnings);
  if (!has_names)
    table.guess (is_intensity_first, warnings);
  std::vector<Field> fields = table.fields (warnings);
  Cloud cloud = makeCloud (std::move (fields), table.rows ());
  cloud.are_decimals = true;
  cloud.warnings.insert (cloud.warnings.begin (), warnings.begin (), warnings.end ());
  return cloud;
}

} // namespace pcl::floater
