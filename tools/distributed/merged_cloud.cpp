// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "merged_cloud.h"

#include "cloud_reader.h"
#include "prepared_input.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

namespace pcl::floater {
namespace {
bool
areAlike (const Field& a, const Field& b)
{
  return a.type == b.type && a.count == b.count;
}

// A field of the merged cloud, and that of each file.
struct Column
{
  Field merged;
  std::vector<const Field*> parts;
  bool are_scaled = false; // numbers as they are meant, not as they are in the files
};

Column
coordinateColumn (const std::vector<Cloud>& clouds, std::size_t axis)
{
  constexpr std::array<const char*, 3> NAMES{"x", "y", "z"};
  Column column;
  const Field& first = clouds.front ().coordinates[axis];
  bool are_plain = first.scale == 1.0 && first.offset == 0.0;
  for (const Cloud& cloud : clouds) {
    const Field& field = cloud.coordinates[axis];
    are_plain = are_plain && areAlike (field, first) && field.scale == 1.0 && field.offset == 0.0;
    column.parts.push_back (&field);
  }
  column.merged.name = NAMES[axis];
  column.merged.type = are_plain ? first.type : ScalarType::FLOAT64;
  column.are_scaled = !are_plain;
  return column;
}

// Nothing if it is not in all files.
std::optional<Column>
fieldColumn (const std::vector<Cloud>& clouds, const Field& first)
{
  Column column;
  for (const Cloud& cloud : clouds) {
    const Field* field = cloud.find (first.name);
    if (field == nullptr || !areAlike (*field, first))
      return {};
    column.parts.push_back (field);
  }
  column.merged.name = first.name;
  column.merged.type = first.type;
  column.merged.count = first.count;
  return column;
}

void
copyColumn (const Column& column, const std::vector<Cloud>& clouds, char* to)
{
  for (std::size_t c = 0; c < clouds.size (); ++c) {
    const Field& from = *column.parts[c];
    for (std::size_t row = 0; row < clouds[c].rows; ++row, to += column.merged.stride) {
      if (column.are_scaled) {
        const double number = from.scaled (row);
        std::memcpy (to, &number, sizeof (number));
        continue;
      }
      visitType (from.type, [&] (auto tag) {
        for (std::size_t i = 0; i < from.count; ++i) {
          const auto number = from.value<decltype (tag)> (row, i);
          std::memcpy (to + i * sizeof (number), &number, sizeof (number));
        }
      });
    }
  }
}

} // namespace

Cloud
readClouds (const std::vector<std::filesystem::path>& files, bool all_digits,
            std::vector<std::size_t>* firsts)
{
  if (firsts != nullptr)
    firsts->assign (1, 0);
  const auto read = [&] (const std::filesystem::path& file) {
    return readNamed (file, [&] { return readCloud (file, all_digits); });
  };
  if (files.size () == 1) {
    Cloud cloud = read (files.front ());
    if (firsts != nullptr)
      firsts->push_back (cloud.rows);
    return cloud;
  }
  std::vector<Cloud> clouds;
  Cloud merged;
  merged.are_decimals = true;
  for (const std::filesystem::path& file : files) {
    const Cloud& cloud = clouds.emplace_back (read (file));
    for (const std::string& warning : cloud.warnings)
      merged.warnings.push_back ("'" + file.string () + "': " + warning);
    merged.single_precision = merged.single_precision && cloud.single_precision;
    merged.are_decimals = merged.are_decimals && cloud.are_decimals;
    merged.rows += cloud.rows;
    if (firsts != nullptr)
      firsts->push_back (merged.rows);
  }
  if (merged.rows > static_cast<std::size_t> (std::numeric_limits<std::int32_t>::max ()))
    throw ReadError ("the files have more points together than a mesh file can number "
                     "(2147483647); reconstruct fewer of them at a time");
  std::vector<Column> columns;
  for (std::size_t axis = 0; axis < 3; ++axis)
    columns.push_back (coordinateColumn (clouds, axis));
  for (const Field& field : clouds.front ().fields)
    if (std::optional<Column> column = fieldColumn (clouds, field))
      columns.push_back (std::move (*column));
    else
      merged.warnings.push_back ("the field '" + field.name +
                                 "' was left out: not all files have it with the same type");
  std::vector<Field*> fields;
  fields.reserve (columns.size ());
  for (Column& column : columns)
    fields.push_back (&column.merged);
  const std::shared_ptr<char> rows = allocateRows (fields, merged.rows);
  for (const Column& column : columns)
    copyColumn (column, clouds, rows.get () + (column.merged.first.get () - rows.get ()));
  for (std::size_t c = 0; c < columns.size (); ++c)
    if (c < 3)
      merged.coordinates[c] = columns[c].merged;
    else
      merged.fields.push_back (columns[c].merged);
  return merged;
}

} // namespace pcl::floater
