// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of text, as Markdown and as CSV.
#pragma once

#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// Rows of cells, as many in each as there are columns. The first column is a name, the others are
/// numbers.
struct Table
{
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

std::string
toMarkdown (const Table& table);

std::string
toCsv (const Table& table);

/// With `digits` digits after the point.
std::string
fixed (double number, int digits);

/// With two digits: 1.2e-15.
std::string
scientific (double number);

/// The share part / whole in percent, or "-" of nothing.
std::string
percent (std::size_t part, std::size_t whole, int digits);

/// 31476 as 31,476.
std::string
grouped (std::size_t number);

} // namespace floater
} // namespace pcl
