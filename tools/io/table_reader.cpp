// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "table_head.h"

namespace pcl::floater {
namespace {
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
      static_cast<double> (static_cast<float> (std::min (size, LARGEST_FLOAT))) != size) {
    int digits = 0; // without the zeros before the first other one
    for (const char c : word.substr (0, word.find_first_of ("eE")))
      digits += c >= '0' && c <= '9' && (c != '0' || digits > 0) ? 1 : 0;
    column.fits_float = size <= LARGEST_FLOAT && size >= SMALLEST_FLOAT &&
                        digits <= std::numeric_limits<float>::max_digits10;
  }
}

class Table
{
public:
  /// \param text after the first point; for as many rows as it has lines there is room
  Table (const TableHead& head, std::string_view text, char newline)
      : columns_ (head.columns), separator_ (head.separator), width_ (columns_.size ())
  {
    const auto lines = static_cast<std::size_t> (std::count (text.begin (), text.end (), newline));
    values_.reserve ((std::min (lines, text.size () / width_) + 2) * width_);
  }

  std::size_t rows () const { return values_.size () / width_; }

  /// \throws ReadError if it has other columns than those before it
  void readRow (const TextScanner& scanner, std::string_view line)
  {
    if (splitColumns (line, separator_.separator, words_) && words_.size () + 1 == width_)
      words_.emplace_back ();
    for (std::size_t c = 0; c < std::min (words_.size (), width_); ++c) {
      double& value = values_.emplace_back ();
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
    std::array<bool, OTHER + 1> has{};
    has[INTENSITY] = width_ % 3 != 1; // 3 k + 1: one of them belongs to no three
    std::string taken;
    for (std::size_t c = 3; c < width_;) {
      std::size_t first = OTHER;
      if (!has[NORMAL_X] && areUnitVectors (c))
        first = NORMAL_X;
      else if (!has[RED] && areBytes (c) &&
               (has[INTENSITY] || !is_intensity_first || !areBytes (c + 1)))
        first = RED;
      else if (!has[INTENSITY])
        first = INTENSITY;
      has[first] = true;
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
      warnings.push_back (
          "the columns of the input file have no names: after x, y and z, " + taken +
          " was taken by what they hold; a first line such as x,y,z,red,green,blue names them");
  }

  std::vector<Field> fields (std::vector<std::string>& warnings) const
  {
    const bool are_bytes =
        std::all_of (columns_.begin (), columns_.end (), [] (const Column& column) {
          return !column.isColor () || (column.is_number && column.are_bytes);
        });
    std::vector<Field> fields;
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
      const std::string name = column.kind < OTHER ? std::string (KNOWN[column.kind][0]) : other;
      const ScalarType type = column.isColor () && are_bytes         ? ScalarType::UINT8
                              : column.kind > Z && column.fits_float ? ScalarType::FLOAT32
                                                                     : ScalarType::FLOAT64;
      visitType (type, [&] (auto tag) {
        std::vector<decltype (tag)> narrowed (rows ());
        for (std::size_t row = 0; row < narrowed.size (); ++row)
          narrowed[row] = static_cast<decltype (tag)> (values_[row * width_ + c]);
        addColumns ({name}, type, std::move (narrowed), fields);
      });
    }
    return fields;
  }

  /// Whether the first of four columns or more counts the rows, one by one.
  bool countsRows () const
  {
    constexpr std::size_t FEWEST = 10; // rows
    bool counts = rows () >= FEWEST && width_ > 3;
    for (std::size_t at = width_; at < values_.size () && counts; at += width_)
      counts = values_[at] == values_[at - width_] + 1.0;
    return counts;
  }

  /// Whether three columns hold vectors of length 1, with the rounding of few digits, or 0.
  bool areUnitVectors (std::size_t column, std::size_t first_row = 0) const
  {
    constexpr double ROUNDING = 0.02; // of two decimals each
    bool has_any = false;
    for (std::size_t row = first_row; row < rows () && column + 3 <= width_; ++row) {
      const double* const v = values_.data () + row * width_ + column;
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
  std::vector<double> values_; // rows of width_
  Words words_;                // of a line
};

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
  if (const std::uint64_t count = head.count.value_or (points); count > points)
    throw ReadError ("its first line promises " + std::to_string (count) +
                     " points, but the file has only " + std::to_string (points) +
                     "; it is truncated or that line is wrong");
  else if (count < points)
    warnings.push_back ("the first line of the input file promises " + std::to_string (count) +
                        " points, but there are " + std::to_string (points) + "; all were taken");
  if (!head.has_names && table.countsRows ())
    throw ReadError (
        "its first column counts the points and can hardly be x: name the columns in a first line, "
        "or choose those of x, y and z by number, such as --columns 2,3,4 (or 1,2,3)");
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

} // namespace

Cloud
parseXyz (const FileBytes& file, const ReadOptions& options)
{
  return parseTable (file, false, options.columns);
}

Cloud
parsePts (const FileBytes& file, const ReadOptions& options)
{
  return parseTable (file, true, options.columns);
}

} // namespace pcl::floater
