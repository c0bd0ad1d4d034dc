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
  std::size_t rank = 0;   ///< of its name among those of its kind
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

/// The beginning of a line in a message, without what is not printable.
std::string
quoted (std::string_view line, std::size_t characters = 40)
{
  std::string text;
  for (const char c : line.substr (0, characters))
    text += c >= ' ' && c <= '~' ? c : '?';
  return "'" + text + (line.size () > characters ? "..." : "") + "'";
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

/// The word without a unit behind an underscore: "z" of "z_m".
std::string_view
withoutUnit (std::string_view name)
{
  const std::size_t at = std::min (name.rfind ('_'), name.size ());
  for (const std::string_view unit :
       {"_m", "_mm", "_cm", "_km", "_ft", "_deg", "_meters", "_metres"})
    if (name.substr (at) == unit)
      return name.substr (0, at);
  return name;
}

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
    c = TextScanner::isBlank (c) ? '_'
        : c >= 'A' && c <= 'Z'   ? static_cast<char> (c - 'A' + 'a')
                                 : c;
  constexpr std::string_view SCALAR = "scalar_"; // what CloudCompare puts before its fields
  if (column.name.rfind (SCALAR, 0) == 0)
    column.name.erase (0, SCALAR.size ());
  for (std::size_t kind = 0; kind < OTHER; ++kind)
    for (std::size_t rank = 0; rank < KNOWN[kind].size (); ++rank)
      if (column.kind == OTHER && isCalled (column.name, KNOWN[kind][rank])) {
        column.kind = kind;
        column.rank = rank;
      }
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
  std::array<Column*, OTHER> best{};
  for (Column& column : columns)
    if (column.kind != OTHER && (!best[column.kind] || column.rank < best[column.kind]->rank))
      best[column.kind] = &column;
  const auto has = [&best] (std::size_t first) { // all three
    return best[first] && best[first + 1] && best[first + 2];
  };
  for (Column& column : columns)
    if (column.kind != OTHER &&
        (&column != best[column.kind] || (column.isColor () && !has (RED)) ||
         (column.kind > ALPHA && column.kind < INTENSITY && !has (NORMAL_X))))
      column.kind = OTHER;
  return columns;
}

bool
haveCoordinates (const std::vector<Column>& columns)
{
  return std::count_if (columns.begin (), columns.end (),
                        [] (const Column& column) { return column.kind <= Z; }) == 3;
}

/// The first separator that makes it a header with x, y and z; else any.
std::vector<Column>
namedColumns (std::string_view line)
{
  std::vector<Column> columns;
  for (const char separator : {';', ',', ' '})
    if (haveCoordinates (columns = columnsOfHeader (line, separator)))
      break;
  return columns;
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

/// Whether the line begins or ends a scan, as in some .pts files.
bool
isBlockMark (std::string_view line)
{
  return isWord (trim (line), "begin") || isWord (trim (line), "end");
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
                     " names no x, y and z: name them there, or "
                     "choose their columns by number, such as --columns 2,3,4");
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

/// Reads up to the first point, and that line.
/// \return its text
std::string_view
readHead (TextScanner& scanner, const std::array<std::size_t, 3>& chosen, TableHead& head)
{
  constexpr std::size_t LONGEST = 1U << 16U; // characters; a line that is longer is no text
  constexpr std::size_t MOST_SKIPPED = 1000; // lines; a file with more before its points has none
  while (scanner.nextFilledLine ()) {
    const std::string_view line = scanner.restOfLine ();
    const std::optional<std::string_view> comment = commentText (line);
    const bool is_text = line.size () <= LONGEST;
    if (std::vector<Column> named;
        is_text && haveCoordinates (named = namedColumns (comment.value_or (line)))) {
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
  column.are_bytes = column.are_bytes && value >= 0.0 && value <= 255.0 &&
                     value == static_cast<double> (static_cast<std::uint8_t> (value));
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
  /// \param text after the first point; for as many rows as it has lines there is room
  Table (const TableHead& head, std::string_view text, char newline)
      : columns_ (head.columns), separator_ (head.separator), width_ (columns_.size ())
  {
    const auto lines = static_cast<std::size_t> (std::count (text.begin (), text.end (), newline));
    values_->reserve ((std::min (lines, text.size () / width_) + 2) * width_);
  }

  std::size_t rows () const { return values_->size () / width_; }

  /// Reads a line with a point.
  /// \throws ReadError if it has other columns than those before it
  void readRow (const TextScanner& scanner, std::string_view line)
  {
    if (splitColumns (line, separator_.separator, words_) && words_.size () + 1 == width_)
      words_.emplace_back ();
    for (std::size_t c = 0; c < std::min (words_.size (), width_); ++c) {
      double& value = values_->emplace_back ();
      if (parseColumn (words_[c], separator_.has_decimal_comma, value))
        note (columns_[c], words_[c], value);
      else if (columns_[c].is_number)
        scanner.fail (quoted (words_[c]) + " is not a number");
      else
        value = std::numeric_limits<double>::quiet_NaN ();
    }
    if (words_.size () != width_)
      scanner.fail ("it does not have " + counted (width_, "column") +
                    " like the lines before it; the file may be truncated");
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
    const bool are_bytes =
        std::all_of (columns_.begin (), columns_.end (), [] (const Column& column) {
          return !column.isColor () || (column.is_number && column.are_bytes);
        });
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
                         column.isColor () && are_bytes         ? ScalarType::UINT8
                         : column.kind > Z && column.fits_float ? ScalarType::FLOAT32
                                                                : ScalarType::FLOAT64});
      sources.push_back (c);
    }
    // No value is written beyond the one that it is made of.
    auto* const bytes = reinterpret_cast<char*> (values_->data ());
    char* to = bytes;
    for (std::size_t row = 0; row < rows (); ++row)
      for (std::size_t f = 0; f < fields.size (); ++f)
        visitType (fields[f].type, [&] (auto narrow) {
          using T = decltype (narrow);
          const auto number = readNumber<double> (
              bytes + (row * width_ + sources[f]) * sizeof (double), HOST_BYTE_ORDER);
          narrow = static_cast<T> (number);
          std::memcpy (to, &narrow, sizeof narrow);
          to += sizeof narrow;
        });
    viewRows (pointersTo (fields), {values_, bytes}, HOST_BYTE_ORDER);
    return fields;
  }

  /// Whether the first of four columns or more counts the rows, one by one.
  bool countsRows () const
  {
    constexpr std::size_t FEWEST = 10; // rows
    bool counts = rows () >= FEWEST && width_ > 3;
    for (std::size_t at = width_; at < values_->size () && counts; at += width_)
      counts = (*values_)[at] == (*values_)[at - width_] + 1.0;
    return counts;
  }

  /// Whether three columns hold vectors of length 1, with the rounding of few digits, or 0.
  bool areUnitVectors (std::size_t column, std::size_t first_row = 0) const
  {
    constexpr double ROUNDING = 0.02; // of two decimals each
    bool has_any = false;
    for (std::size_t row = first_row; row < rows () && column + 3 <= width_; ++row) {
      const double* const v = values_->data () + row * width_ + column;
      const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
      if (std::isnan (square) || square == 0.0)
        continue;
      if (std::abs (square - 1.0) > ROUNDING)
        return false;
      has_any = true;
    }
    return has_any;
  }

private:
  std::vector<Column> columns_;
  ColumnSeparator separator_;
  std::size_t width_;
  std::shared_ptr<std::vector<double>> values_ = // rows of width_; later rows of other types
      std::make_shared<std::vector<double>> ();
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
parseTable (const FileBytes& file, bool is_intensity_first,
            const std::array<std::size_t, 3>& columns)
{
  const std::string_view text = file.view ();
  for (const std::string_view mark : {"\xff\xfe", "\xfe\xff"})
    if (text.substr (0, 2) == mark)
      throw ReadError ("it is text in UTF-16; save it as UTF-8");
  TextScanner scanner (text);
  TableHead head;
  std::string_view line = readHead (scanner, columns, head);
  Table table (head, scanner.rest (), scanner.newline ());
  table.readRow (scanner, line);
  while (scanner.nextFilledLine ()) {
    line = scanner.restOfLine ();
    const char first = line.front ();
    if ((first == '#' || first == '/' || first == '%') && commentText (line))
      continue;
    if ((first == 'E' || first == 'B' || first == 'e' || first == 'b') && isBlockMark (line))
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
  // As .pwn files have it: all points, then all normals.
  const bool are_normals_behind = head.count && table.rows () == 2 * *head.count &&
                                  head.columns.size () == 3 &&
                                  table.areUnitVectors (0, table.rows () / 2);
  const std::size_t points = table.rows () / (are_normals_behind ? 2 : 1);
  checkCount (head, points, warnings);
  if (!head.has_names && table.countsRows ())
    throw ReadError (
        "its first column counts the points and can hardly be x: name the columns in a "
        "first line, or choose those of x, y and z by number, such as --columns "
        "2,3,4 (or 1,2,3)");
  if (!head.has_names)
    table.guess (is_intensity_first, warnings);
  std::vector<Field> fields = table.fields (warnings);
  for (std::size_t axis = 0; axis < 3 && are_normals_behind; ++axis) {
    fields.push_back (fields[axis]);
    fields.back ().name = KNOWN[NORMAL_X + axis][0];
    const char* const first = fields[axis].first.get () + points * fields[axis].stride;
    fields.back ().first = {fields[axis].first, first};
  }
  const bool may_be_degrees =
      std::any_of (head.columns.begin (), head.columns.end (), [] (const Column& column) {
        return column.kind == X && column.name.rfind ("lon", 0) == 0 &&
               (withoutUnit (column.name) == column.name || column.name.back () == 'g');
      });
  Cloud cloud = makeCloud (std::move (fields), points, std::move (warnings));
  cloud.may_be_degrees = may_be_degrees;
  return cloud;
}

} // namespace pcl::floater
