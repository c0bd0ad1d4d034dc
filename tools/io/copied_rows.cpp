// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "copied_rows.h"

#include <algorithm>

namespace pcl::floater {
namespace {
void
copyField (const Field& from, const std::vector<std::size_t>& rows, const Field& to)
{
  auto* bytes = const_cast<char*> (to.first.get ()); // just allocated
  visitType (from.type, [&] (auto tag) {
    using T = decltype (tag);
    for (std::size_t i = 0; i < rows.size (); ++i)
      for (std::size_t c = 0; c < from.count; ++c) {
        const T value = from.value<T> (rows[i], c);
        std::memcpy (bytes + i * to.stride + c * sizeof (T), &value, sizeof (T));
      }
  });
}

} // namespace

Cloud
copyRows (const Cloud& cloud, const std::vector<std::size_t>& rows, const std::vector<Field>& added)
{
  Cloud copied;
  copied.coordinates = cloud.coordinates;
  copied.single_precision = cloud.single_precision;
  copied.shift = cloud.shift;
  copied.sensor_origin = cloud.sensor_origin;
  copied.rows = rows.size ();
  for (const Field& field : cloud.fields)
    if (std::none_of (added.begin (), added.end (),
                      [&field] (const Field& other) { return other.name == field.name; }))
      copied.fields.push_back (field);
  const std::vector<Field> sources (copied.fields);
  copied.fields.insert (copied.fields.end (), added.begin (), added.end ());
  std::vector<Field*> fields;
  for (Field& field : copied.coordinates)
    fields.push_back (&field);
  for (Field& field : copied.fields)
    fields.push_back (&field);
  allocateRows (fields, rows.size ());
  for (std::size_t axis = 0; axis < 3; ++axis)
    copyField (cloud.coordinates[axis], rows, copied.coordinates[axis]);
  for (std::size_t f = 0; f < sources.size (); ++f)
    copyField (sources[f], rows, copied.fields[f]);
  return copied;
}

} // namespace pcl::floater
