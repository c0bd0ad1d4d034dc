// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Text with one point in each line: how a line is cut into columns, and what the columns hold.
#include "cloud_reader.h"
#include "format.h"
#include "text_scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pcl::floater {
namespace {
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

/// What columns are called; the first name of each is that of the field.
constexpr std::array<std::array<std::string_view, 4>, OTHER> KNOWN{
    {{"x", "easting", "coord_x"},
     {"y", "northing", "coord_y"},
     {"z", "elevation", "height", "coord_z"},
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
  bool are_shares = true; ///< all values are from 0 to 1
  bool are_words = true;  ///< all values are whole numbers from 0 to 65535
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
};

/// The beginning of a line in a message, without what is not printable.
std::string
quoted (std::string_view line)
{
  constexpr std::size_t QUOTED = 40; // characters
  std::string text;
  for (const char c : line.substr (0, QUOTED))
    text += c >= ' ' && c <= '~' ? c : '?';
  return "'" + text + (line.size () > QUOTED ? "..." : "") + "'";
}

std::string_view
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
bool
splitColumns (std::string_view line, char separator, Words& columns)
{
  columns.clear ();
  if (separator == ' ') {
    for (std::size_t at = 0; at < line.size ();) {
      const std::size_t first = at;
      while (at < line.size () && !TextScanner::isBlank (line[at]))
        ++at;
      if (at > first)
        columns.push_back (trim (line.substr (first, at - first)));
      ++at; // a blank
    }
    return false;
  }
  for (std::size_t first = 0; first <= line.size ();) {
    const std::size_t end = std::min (line.find (separator, first), line.size ());
    columns.push_back (trim (line.substr (first, end - first)));
    first = end + 1;
  }
  const bool ends_empty = columns.back ().empty ();
  if (ends_empty)
    columns.pop_back ();
  return ends_empty;
}

/// Parses a column as a number; an empty one is NaN.
/// \return false if it is neither
bool
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

/// A column of this name, which is compared in lower case and without a unit: "X [m]" is "x".
Column
columnOf (std::string_view text)
{
  Column column;
  column.name = trim (text.substr (0, text.find_first_of ("[(")));
  for (char& c : column.name)
    c = TextScanner::isBlank (c) ? '_'
        : c >= 'A' && c <= 'Z'   ? static_cast<char> (c - 'A' + 'a')
                                 : c;
  constexpr std::string_view SCALAR = "scalar_"; // what CloudCompare puts before its fields
  if (column.name.rfind (SCALAR, 0) == 0)
    column.name.erase (0, SCALAR.size ());
  const auto known = std::find_if (KNOWN.begin (), KNOWN.end (), [&column] (const auto& names) {
    return !column.name.empty () &&
           std::find (names.begin (), names.end (), column.name) != names.end ();
  });
  column.kind = static_cast<std::size_t> (known - KNOWN.begin ());
  return column;
}

/// Columns that a header names: "x,y,z,red,green,blue", "//X Y Z R G B".
/// \return nothing unless x, y and z are among them
std::vector<Column>
namedColumns (std::string_view line)
{
  Words words;
  for (const char separator : {';', ',', ' '}) {
    std::vector<Column> columns;
    std::array<int, OTHER + 1> counts{};
    splitColumns (line, separator, words);
    for (const std::string_view text : words) {
      if (!text.empty () && text.back () == ':') // "columns: x y z"
        continue;
      Column column = columnOf (text);
      if (counts[column.kind]++ > 0) // a second one of a kind is a field like any other
        column.kind = OTHER;
      columns.push_back (std::move (column));
    }
    const auto has = [&counts] (std::size_t first) { // all three
      return counts[first] > 0 && counts[first + 1] > 0 && counts[first + 2] > 0;
    };
    if (!has (X))
      continue;
    for (Column& column : columns)
      if ((column.isColor () && !has (RED)) ||
          (column.kind > ALPHA && column.kind < INTENSITY && !has (NORMAL_X)))
        column.kind = OTHER;
    return columns;
  }
  return {};
}

/// The line without what makes it a comment: #, //, %; nothing if it is none.
std::optional<std::string_view>
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

/// The only word of a line, if it is a whole number.
std::optional<std::uint64_t>
countOf (std::string_view line)
{
  std::uint64_t count = 0;
  return parseNumber (trim (line), count) ? std::optional (count) : std::nullopt;
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

/// Takes the line for that of the first point: finds how its columns are separated, and which of
/// them are numbers.
/// \return false if it is none
bool
isFirstPoint (std::string_view line, TableHead& head)
{
  constexpr std::size_t MOST_COLUMNS = 256;
  Words words;
  for (const ColumnSeparator separator :
       {ColumnSeparator{';', false}, ColumnSeparator{';', true}, ColumnSeparator{',', false},
        ColumnSeparator{' ', false}, ColumnSeparator{' ', true}}) {
    splitColumns (line, separator.separator, words);
    if (words.size () < 3 || words.size () > MOST_COLUMNS)
      continue;
    std::vector<Column> plain (words.size ());
    for (std::size_t axis = 0; axis < 3; ++axis)
      plain[axis].kind = axis;
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
  throw ReadError ("it has no points: no line" + where + " has three numbers, x, y and z" +
                   (head.has_names ? ", in the columns that its header names" : "") +
                   (head.skipped > 0 ? "; it begins with " + head.first_skipped : ""));
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
    if (std::vector<Column> named;
        is_text && !(named = namedColumns (comment.value_or (line))).empty ()) {
      head.columns = std::move (named);
      head.has_names = true;
      head.are_names_comment = comment.has_value ();
    }
    else if (comment)
      continue;
    else if (const auto count = countOf (line); count && !head.count)
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

/// Digits of a number without the zeros before the first other one.
int
countDigits (std::string_view word)
{
  int digits = 0;
  for (const char c : word.substr (0, word.find_first_of ("eE")))
    digits += c >= '0' && c <= '9' && (c != '0' || digits > 0) ? 1 : 0;
  return digits;
}

/// Notes what a value tells of its column.
void
note (Column& column, std::string_view word, double value)
{
  constexpr double LARGEST_FLOAT = std::numeric_limits<float>::max ();
  constexpr double SMALLEST_FLOAT = std::numeric_limits<float>::min ();
  if (column.kind <= Z)
    return;
  column.are_shares &= value >= 0.0 && value <= 1.0;
  column.are_words = column.are_words && value >= 0.0 && value <= 65535.0 &&
                     value == static_cast<double> (static_cast<std::int32_t> (value));
  column.are_bytes &= column.are_words && value <= 255.0;
  // Infinities and a zero are what they are in either type.
  const double size = std::abs (value);
  if (column.fits_float && std::isfinite (value) &&
      static_cast<double> (static_cast<float> (std::min (size, LARGEST_FLOAT))) != size)
    column.fits_float = size <= LARGEST_FLOAT && size >= SMALLEST_FLOAT &&
                        countDigits (word) <= std::numeric_limits<float>::max_digits10;
}

/// Rows of numbers, and what the columns turned out to hold.
class Table
{
public:
  /// \param text after the first point. There are not more rows than its lines: each ends with a
  /// newline, and a value takes a character
  Table (const TableHead& head, std::string_view text)
      : columns_ (head.columns), separator_ (head.separator), width_ (columns_.size ())
  {
    const auto lines = static_cast<std::size_t> (std::count (text.begin (), text.end (), '\n')) + 1;
    most_rows_ = std::min (lines, text.size () / width_ + 1) + 1;
    values_.reset (new double[most_rows_ * width_], std::default_delete<double[]> ());
  }

  std::size_t rows () const { return rows_; }

  /// Reads a line with a point.
  /// \throws ReadError if it has other columns than those before it
  void readRow (const TextScanner& scanner, std::string_view line)
  {
    if (rows_ == most_rows_)
      scanner.fail ("it has more points than lines");
    if (splitColumns (line, separator_.separator, words_) && words_.size () + 1 == width_)
      words_.emplace_back ();
    double* const to = values_.get () + rows_ * width_;
    for (std::size_t c = 0; c < std::min (words_.size (), width_); ++c) {
      if (parseColumn (words_[c], separator_.has_decimal_comma, to[c]))
        note (columns_[c], words_[c], to[c]);
      else if (columns_[c].is_number)
        scanner.fail (quoted (words_[c]) + " is not a number");
      else
        to[c] = std::numeric_limits<double>::quiet_NaN ();
    }
    if (words_.size () != width_)
      scanner.fail ("it does not have " + counted (width_, "column") +
                    " like the lines before it; the file may be truncated");
    ++rows_;
  }

  /// Decides what columns without names are, by what they hold: three columns of bytes are a
  /// colour, three that are unit vectors a normal, one that is left an intensity. The warning
  /// tells.
  void guess (bool is_intensity_first, std::vector<std::string>& warnings)
  {
    const auto areBytes = [this] (std::size_t c) {
      return c + 3 <= width_ && columns_[c].are_bytes && columns_[c + 1].are_bytes &&
             columns_[c + 2].are_bytes;
    };
    bool has_color = false, has_normal = false;
    bool has_intensity = width_ % 3 != 1; // 3 k + 1: one of them belongs to no three
    std::string taken;
    for (std::size_t c = 3; c < width_;) {
      std::size_t first = OTHER;
      if (!has_normal && areUnitVectors (c))
        first = NORMAL_X;
      else if (!has_color && areBytes (c) &&
               (has_intensity || !is_intensity_first || !areBytes (c + 1)))
        first = RED;
      else if (!has_intensity)
        first = INTENSITY;
      has_normal |= first == NORMAL_X;
      has_color |= first == RED;
      has_intensity |= first == INTENSITY;
      const std::size_t last = c + (first == NORMAL_X || first == RED ? 3 : 1);
      if (columns_[c].is_number)
        taken += (taken.empty () ? "" : ", ") + std::to_string (c + 1) +
                 (last > c + 1 ? " to " + std::to_string (last) : "") +
                 (first == RED         ? " for colours"
                  : first == NORMAL_X  ? " for normals"
                  : first == INTENSITY ? " for the intensity"
                                       : " for another field");
      for (; c < last; ++c)
        columns_[c].kind = std::min<std::size_t> (first++, OTHER);
    }
    if (!taken.empty ())
      warnings.push_back ("the columns of the input file have no names: after x, y and z, " +
                          taken +
                          " was taken by what they hold; a first line such as x,y,z,red,green,blue "
                          "names them");
  }

  /// Narrows the columns to their types, in place, and makes fields of them.
  std::vector<Field> fields (std::vector<std::string>& warnings)
  {
    const double white = whiteOfColors (warnings);
    std::vector<Field> fields;
    std::vector<std::size_t> sources; // columns
    for (std::size_t c = 0; c < width_; ++c) {
      const Column& column = columns_[c];
      const std::string number = std::to_string (c + 1);
      if (!column.is_number) {
        warnings.push_back ("column " + number + " of the input file" +
                            (column.name.empty () ? "" : ", '" + column.name + "',") +
                            " is no number and was left out");
        continue;
      }
      const std::string other = column.name.empty () ? "column_" + number : column.name;
      fields.push_back ({column.kind < OTHER ? std::string (KNOWN[column.kind][0]) : other,
                         column.isColor () && white > 0.0       ? ScalarType::UINT8
                         : column.kind > Z && column.fits_float ? ScalarType::FLOAT32
                                                                : ScalarType::FLOAT64});
      sources.push_back (c);
    }
    // No value is written beyond the one that it is made of.
    auto* const bytes = reinterpret_cast<char*> (values_.get ());
    char* to = bytes;
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t f = 0; f < fields.size (); ++f)
        visitType (fields[f].type, [&] (auto narrow) {
          using T = decltype (narrow);
          const auto number = readNumber<double> (
              bytes + (row * width_ + sources[f]) * sizeof (double), HOST_BYTE_ORDER);
          if constexpr (std::is_floating_point_v<T>)
            narrow = static_cast<T> (number);
          else
            narrow = static_cast<T> (std::lround (255.0 / white * number));
          std::memcpy (to, &narrow, sizeof narrow);
          to += sizeof narrow;
        });
    viewRows (pointersTo (fields), {values_, bytes}, HOST_BYTE_ORDER);
    return fields;
  }

private:
  /// Whether three columns hold vectors of length 1, with the rounding of few digits, or 0.
  bool areUnitVectors (std::size_t column) const
  {
    constexpr double ROUNDING = 0.02; // of two decimals each
    bool has_any = false;
    for (std::size_t row = 0; row < rows_ && column + 3 <= width_; ++row) {
      const double* const v = values_.get () + row * width_ + column;
      const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
      if (std::isnan (square) || square == 0.0)
        continue;
      if (std::abs (square - 1.0) > ROUNDING)
        return false;
      has_any = true;
    }
    return has_any;
  }

  /// The value of the colours that becomes 255; 0 if they become other fields.
  double whiteOfColors (std::vector<std::string>& warnings) const
  {
    const auto areAll = [this] (bool Column::*are) {
      return std::all_of (columns_.begin (), columns_.end (), [are] (const Column& column) {
        return !column.isColor () || (column.is_number && column.*are);
      });
    };
    if (areAll (&Column::are_bytes))
      return 255.0;
    if (areAll (&Column::are_shares))
      return 1.0;
    if (areAll (&Column::are_words)) {
      warnings.emplace_back ("the colours of the input file are above 255: they were taken for 16 "
                             "bits, and 8 of them kept");
      return 65535.0;
    }
    warnings.emplace_back ("the colours of the input file are neither from 0 to 255 nor from 0 to "
                           "1: they were kept as other fields are");
    return 0.0;
  }

  std::vector<Column> columns_;
  ColumnSeparator separator_;
  std::size_t width_;
  std::shared_ptr<double> values_; // rows_ of width_ values; later rows of other types
  std::size_t most_rows_ = 0;
  std::size_t rows_ = 0;
  Words words_; // of a line
};

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
  Table table (head, scanner.rest ());
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
  if (!head.has_names)
    table.guess (is_intensity_first, warnings);
  std::vector<Field> fields = table.fields (warnings);
  Cloud cloud = makeCloud (std::move (fields), table.rows (), std::move (warnings));
  cloud.are_decimals = true;
  return cloud;
}

} // namespace pcl::floater
