// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A table of numbers, read from text line by line.
#pragma once

#include "cloud.h"
#include "plural.h"
#include "table_columns.h"
#include "text_scanner.h"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Rows of numbers, and what the columns turned out to hold.
class Table
{
public:
  /// \param most_rows that may be read
  Table (std::vector<Column> columns, const ColumnSeparator& separator, std::size_t most_rows)
      : columns_ (std::move (columns)), separator_ (separator),
        values_ (new double[most_rows * columns_.size ()], std::default_delete<double[]> ()),
        most_rows_ (most_rows)
  {
  }

  std::size_t rows () const { return rows_; }
  std::size_t width () const { return columns_.size (); }

  double value (std::size_t row, std::size_t column) const
  {
    return values_.get ()[row * width () + column];
  }

  /// Reads a line with a point.
  /// \throws ReadError if it has other columns than those before it
  void readRow (const TextScanner& scanner, std::string_view line);

  /// Decides what columns without names are. The warning tells.
  void guess (bool is_intensity_first, std::vector<std::string>& warnings);

  /// Narrows the columns to their types, in place, and makes fields of them.
  std::vector<Field> fields (std::vector<std::string>& warnings);

private:
  /// Reads a column that is a number as nearly all are.
  /// \return its text; empty, and nothing is taken, if it is another
  std::string_view takeNumber (const char*& at, const char* end, double& to) const;

  /// Reads any other column: empty, with a decimal comma, beyond the range of numbers, or a text.
  void takeOdd (const TextScanner& scanner, std::size_t c, const char*& at, const char* end,
                double& to);

  /// Notes what a value tells of its column.
  void keep (std::size_t c, std::string_view word, double value);

  [[noreturn]] void failWidth (const TextScanner& scanner) const
  {
    scanner.fail ("it does not have " + counted (width (), "column") +
                  " like the lines before it; the file may be truncated");
  }

  std::vector<Column> columns_;
  ColumnSeparator separator_;
  std::shared_ptr<double> values_; // rows_ of width () values; later rows of other types
  std::size_t most_rows_;
  std::size_t rows_ = 0;
};

} // namespace pcl::floater
