// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One field of all points of a cloud.
#pragma once

#include "byte_order.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pcl::floater {
/// Type of the values of a field.
enum class ScalarType
{
  INT8,
  UINT8,
  INT16,
  UINT16,
  INT32,
  UINT32,
  INT64,
  UINT64,
  FLOAT32,
  FLOAT64
};

/// Calls visitor (T{}) with the C++ type T of `type`, and returns its result.
template <typename Visitor>
auto
visitType (ScalarType type, Visitor&& visitor)
{
  switch (type) {
  case ScalarType::INT8:
    return visitor (std::int8_t{});
  case ScalarType::UINT8:
    return visitor (std::uint8_t{});
  case ScalarType::INT16:
    return visitor (std::int16_t{});
  case ScalarType::UINT16:
    return visitor (std::uint16_t{});
  case ScalarType::INT32:
    return visitor (std::int32_t{});
  case ScalarType::UINT32:
    return visitor (std::uint32_t{});
  case ScalarType::INT64:
    return visitor (std::int64_t{});
  case ScalarType::UINT64:
    return visitor (std::uint64_t{});
  case ScalarType::FLOAT32:
    return visitor (float{});
  case ScalarType::FLOAT64:
    break;
  }
  return visitor (double{});
}

/// Size of one value in bytes.
inline std::size_t
sizeOf (ScalarType type)
{
  return visitType (type, [] (auto tag) { return sizeof (tag); });
}

/// One named field of all points: a view of bytes, which it keeps alive. The `count` values of a
/// point are consecutive. Copies are cheap.
struct Field
{
  std::string name;
  ScalarType type = ScalarType::FLOAT32;
  std::size_t count = 1;
  std::shared_ptr<const char> first = {}; ///< first value of the first point; any alignment
  std::size_t stride = 0;                 ///< bytes from one point to the next
  ByteOrder order = HOST_BYTE_ORDER;
  double scale = 1.0;   ///< of coordinates: they are value * scale + offset
  double offset = -0.0; ///< so that the sign of a zero stays

  std::size_t pointBytes () const { return count * sizeOf (type); }

  /// Value c of a point; T must be the C++ type of `type`.
  template <typename T>
  T value (std::size_t point, std::size_t c = 0) const
  {
    return readNumber<T> (first.get () + point * stride + c * sizeof (T), order);
  }

  /// Value of a point as a double; exact except for 64-bit integers.
  double asDouble (std::size_t point) const
  {
    return visitType (
        type, [&] (auto tag) { return static_cast<double> (value<decltype (tag)> (point)); });
  }

  /// Value of a point with scale and offset, as a double.
  double scaled (std::size_t point) const { return asDouble (point) * scale + offset; }
};

/// Makes the fields views of rows: all fields of the first point from `first` on, then all fields
/// of the next.
inline void
viewRows (const std::vector<Field*>& fields, const std::shared_ptr<const char>& first,
          ByteOrder order)
{
  std::size_t stride = 0;
  for (const Field* field : fields)
    stride += field->pointBytes ();
  std::size_t offset = 0;
  for (Field* field : fields) {
    field->first = {first, first.get () + offset};
    field->stride = stride;
    field->order = order;
    offset += field->pointBytes ();
  }
}

/// Allocates rows for the values of `points` points, in the byte order of this machine, and makes
/// the fields views of them.
inline std::shared_ptr<char>
allocateRows (const std::vector<Field*>& fields, std::size_t points)
{
  std::size_t bytes = 0;
  for (const Field* field : fields)
    bytes += points * field->pointBytes ();
  const std::shared_ptr<char> rows (new char[bytes], std::default_delete<char[]> ());
  viewRows (fields, rows, HOST_BYTE_ORDER);
  return rows;
}

} // namespace pcl::floater
