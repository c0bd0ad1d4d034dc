// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl::floater {
namespace {
bool
isBlankOrQuote (char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '"';
}

const char*
skipBlanks (const char* at, const char* end)
{
  while (at < end && isBlankOrQuote (*at))
    ++at;
  return at;
}

/// Digits of a number without the zeros before the first other one.
int
countDigits (std::string_view word)
{
  int digits = 0;
  for (const char c : word) {
    if (c == 'e' || c == 'E')
      break;
    digits += c >= '0' && c <= '9' && (c != '0' || digits > 0) ? 1 : 0;
  }
  return digits;
}

const char*
nameOf (ColumnKind kind)
{
  constexpr std::array<const char*, 11> NAMES{"x",     "y",  "z",  "red", "green",    "blue",
                                              "alpha", "nx", "ny", "nz",  "intensity"};
  return NAMES[static_cast<std::size_t> (kind)];
}

bool
isColor (ColumnKind kind)
{
  return kind >= ColumnKind::RED && kind <= ColumnKind::ALPHA;
}

/// How the values of colours become bytes.
struct ColorScale
{
  bool are_colors = true;
  double factor = 1.0;
};

ColorScale
scaleOfColors (const std::vector<Column>& columns, std::vector<std::string>& warnings)
{
  bool are_bytes = true, are_shares = true, are_words = true, has_any = false;
  for (const Column& column : columns)
    if (isColor (column.kind)) {
      has_any = true;
      are_bytes &= column.is_number && column.are_bytes;
      are_shares &= column.is_number && column.are_shares;
      are_words &= column.is_number && column.are_words;
    }
  constexpr double WHITE = 255.0, WIDE_WHITE = 65535.0;
  if (!has_any || are_bytes)
    return {};
  if (are_shares)
    return {true, WHITE};
  if (are_words) {
    warnings.emplace_back ("the colours of the input file are above 255: they were taken for 16 "
                           "bits, and 8 of them kept");
    return {true, WHITE / WIDE_WHITE};
  }
  warnings.emplace_back ("the colours of the input file are neither from 0 to 255 nor from 0 to 1: "
                         "they were kept as other fields are");
  return {false, 1.0};
}

/// Whether three columns hold vectors of length 1, with the rounding of few digits, or 0.
bool
areUnitVectors (const Table& table, std::size_t column)
{
  constexpr double ROUNDING = 0.02; // of two decimals each
  bool has_any = false;
  for (std::size_t row = 0; row < table.rows (); ++row) {
    double square = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      square += table.value (row, column + i) * table.value (row, column + i);
    if (std::isnan (square) || square == 0.0)
      continue;
    if (std::abs (square - 1.0) > ROUNDING)
      return false;
    has_any = true;
  }
  return has_any;
}

} // namespace

void
Table::readRow (const TextScanner& scanner, std::string_view line)
{
  if (rows_ == most_rows_) // see mostRows
    scanner.fail ("it has more points than lines");
  double* const to = values_.get () + rows_ * width ();
  const bool by_blanks = separator_.separator == ' ';
  const char* at = line.data ();
  const char* const end = at + line.size ();
  std::size_t c = 0;
  bool ends_empty = false; // after a separator
  for (;;) {
    at = skipBlanks (at, end);
    if (at == end)
      break;
    if (c == width ())
      failWidth (scanner);
    const std::string_view word = takeNumber (at, end, to[c]);
    if (!word.empty ())
      keep (c, word, to[c]);
    else
      takeOdd (scanner, c, at, end, to[c]);
    ++c;
    if (by_blanks)
      continue;
    at = skipBlanks (at, end);
    if (at == end)
      break;
    ++at; // the separator
    ends_empty = at == end;
  }
  if (ends_empty && c + 1 == width ()) {
    takeOdd (scanner, c, at, end, to[c]);
    ++c;
  }
  if (c < width ())
    failWidth (scanner);
  ++rows_;
}

std::string_view
Table::takeNumber (const char*& at, const char* end, double& to) const
{
  if (separator_.has_decimal_comma)
    return {};
  const auto [rest, error] = std::from_chars (at, end, to);
  const char* const next = skipBlanks (rest, end);
  const bool ends_here =
      next == end || (separator_.separator == ' ' ? next > rest : *next == separator_.separator);
  if (error != std::errc{} || rest == at || !ends_here)
    return {};
  const std::string_view word (at, static_cast<std::size_t> (rest - at));
  at = rest;
  return word;
}

void
Table::takeOdd (const TextScanner& scanner, std::size_t c, const char*& at, const char* end,
                double& to)
{
  const char* const first = at;
  const bool by_blanks = separator_.separator == ' ';
  while (at < end && (by_blanks ? !isBlankOrQuote (*at) : *at != separator_.separator))
    ++at;
  const char* last = at;
  while (last > first && isBlankOrQuote (last[-1]))
    --last;
  const std::string_view word (first, static_cast<std::size_t> (last - first));
  if (!columns_[c].is_number) {
    to = std::numeric_limits<double>::quiet_NaN ();
    return;
  }
  if (!parseColumn (word, separator_.has_decimal_comma, to))
    scanner.fail (quoted (word) + " is not a number");
  keep (c, word, to);
}

void
Table::keep (std::size_t c, std::string_view word, double value)
{
  constexpr double LARGEST_FLOAT = std::numeric_limits<float>::max ();
  constexpr double SMALLEST_FLOAT = std::numeric_limits<float>::min ();
  Column& column = columns_[c];
  if (column.kind <= ColumnKind::Z)
    return;
  column.are_shares &= value >= 0.0 && value <= 1.0;
  if (column.are_words) {
    column.are_words = value >= 0.0 && value <= 65535.0 &&
                       value == static_cast<double> (static_cast<std::int32_t> (value));
    column.are_bytes &= column.are_words && value <= 255.0;
  }
  // Infinities and a zero are what they are in either type.
  const double size = std::abs (value);
  if (column.fits_float && std::isfinite (value) &&
      static_cast<double> (static_cast<float> (std::min (size, LARGEST_FLOAT))) != size)
    column.fits_float = size <= LARGEST_FLOAT && size >= SMALLEST_FLOAT &&
                        countDigits (word) <= std::numeric_limits<float>::max_digits10;
}

void
Table::guess (bool is_intensity_first, std::vector<std::string>& warnings)
{
  guessColumns (columns_, is_intensity_first,
                [this] (std::size_t column) { return areUnitVectors (*this, column); });
  std::string taken;
  for (std::size_t c = 3; c < width (); ++c) {
    if (!columns_[c].is_number)
      continue;
    const ColumnKind kind = columns_[c].kind;
    const std::string number = std::to_string (c + 1);
    taken += taken.empty () ? "" : ", ";
    if (kind == ColumnKind::RED || kind == ColumnKind::NORMAL_X) {
      taken += number + " to " + std::to_string (c + 3) +
               (kind == ColumnKind::RED ? " for colours" : " for normals");
      c += 2;
    }
    else
      taken +=
          number + (kind == ColumnKind::INTENSITY ? " for the intensity" : " for another field");
  }
  if (!taken.empty ())
    warnings.push_back ("the columns of the input file have no names: after x, y and z, " + taken +
                        " was taken by what they hold; a first line such as x,y,z,red,green,blue "
                        "names them");
}

std::vector<Field>
Table::fields (std::vector<std::string>& warnings)
{
  const ColorScale scale = scaleOfColors (columns_, warnings);
  std::vector<Field> fields;
  std::vector<std::size_t> sources; // columns
  for (std::size_t c = 0; c < width (); ++c) {
    const Column& column = columns_[c];
    const std::string number = std::to_string (c + 1);
    if (!column.is_number) {
      warnings.push_back ("column " + number + " of the input file" +
                          (column.name.empty () ? "" : ", '" + column.name + "',") +
                          " is no number and was left out");
      continue;
    }
    Field field;
    const bool is_other = column.kind == ColumnKind::OTHER;
    field.name = !is_other              ? nameOf (column.kind)
                 : column.name.empty () ? "column_" + number
                                        : column.name;
    field.type = column.kind <= ColumnKind::Z                ? ScalarType::FLOAT64
                 : isColor (column.kind) && scale.are_colors ? ScalarType::UINT8
                 : column.fits_float                         ? ScalarType::FLOAT32
                                                             : ScalarType::FLOAT64;
    fields.push_back (std::move (field));
    sources.push_back (c);
  }
  // No value is written beyond the one that it is made of.
  auto* const bytes = reinterpret_cast<char*> (values_.get ());
  char* to = bytes;
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t f = 0; f < fields.size (); ++f) {
      double number = 0.0;
      std::memcpy (&number, bytes + (row * width () + sources[f]) * sizeof number, sizeof number);
      if (fields[f].type == ScalarType::FLOAT64) {
        std::memmove (to, &number, sizeof number);
        to += sizeof number;
      }
      else if (fields[f].type == ScalarType::FLOAT32) {
        const auto single = static_cast<float> (number);
        std::memcpy (to, &single, sizeof single);
        to += sizeof single;
      }
      else
        *to++ = static_cast<char> (std::lround (scale.factor * number));
    }
  std::vector<Field*> all;
  all.reserve (fields.size ());
  for (Field& field : fields)
    all.push_back (&field);
  viewRows (all, {values_, bytes}, HOST_BYTE_ORDER);
  return fields;
}

} // namespace pcl::floater
