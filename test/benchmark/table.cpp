// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "table.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace pcl
{
namespace floater
{
namespace
{
std::string
print (const char* format, int digits, double number)
{
  std::array<char, 64> text{};
  std::snprintf (text.data (), text.size (), format, digits, number);
  return text.data ();
}

std::string
markdownRow (const std::vector<std::string>& cells)
{
  std::string line = "|";
  for (const std::string& cell : cells)
    line += " " + cell + " |";
  return line + "\n";
}

std::string
csvRow (const std::vector<std::string>& cells)
{
  std::string line;
  for (std::size_t i = 0; i < cells.size (); ++i) {
    // Commas that group digits are for people.
    std::string cell = cells[i];
    if (i > 0)
      cell.erase (std::remove (cell.begin (), cell.end (), ','), cell.end ());
    line += (i > 0 ? ",\"" : "\"") + cell + "\"";
  }
  return line + "\n";
}

} // namespace

std::string
toMarkdown (const Table& table)
{
  std::string text = markdownRow (table.columns) + "|---|";
  for (std::size_t i = 1; i < table.columns.size (); ++i)
    text += "---:|";
  text += "\n";
  for (const auto& row : table.rows)
    text += markdownRow (row);
  return text;
}

std::string
toCsv (const Table& table)
{
  std::string text = csvRow (table.columns);
  for (const auto& row : table.rows)
    text += csvRow (row);
  return text;
}

std::string
fixed (double number, int digits)
{
  return print ("%.*f", digits, number);
}

std::string
scientific (double number)
{
  return print ("%.*e", 1, number);
}

std::string
percent (std::size_t part, std::size_t whole, int digits)
{
  if (whole == 0)
    return "-";
  return fixed (100.0 * static_cast<double> (part) / static_cast<double> (whole), digits);
}

std::string
grouped (std::size_t number)
{
  constexpr std::size_t GROUP = 3;
  std::string digits = std::to_string (number);
  for (std::size_t at = digits.size (); at > GROUP;) {
    at -= GROUP;
    digits.insert (at, ",");
  }
  return digits;
}

} // namespace floater
} // namespace pcl
