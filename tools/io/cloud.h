// SPDX-License-Identifier: GPL-3.0-or-later
// A point cloud with all its fields, as the files have it.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
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

/// Calls visitor (T{}) with the C++ type that `type` stands for and returns its result.
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

/// Bytes of one value.
inline std::size_t
sizeOf (ScalarType type)
{
  return visitType (type, [] (auto tag) { return sizeof (tag); });
}

/// One named field of all points: `count` values for each point, one point after the other.
struct Field
{
  std::string name;
  ScalarType type = ScalarType::FLOAT32;
  std::size_t count = 1;
  std::vector<std::uint8_t> bytes = {}; ///< in the byte order of this machine

  std::size_t pointBytes () const { return count * sizeOf (type); }

  /// Value i, counted over all points; T must be the type that `type` stands for.
  template <typename T>
  T value (std::size_t i) const
  {
    T result;
    std::memcpy (&result, bytes.data () + i * sizeof (T), sizeof (T));
    return result;
  }
};

/// A point cloud. Colours are the fields red, green, blue (and alpha) of type UINT8, normals are
/// nx, ny, nz, whatever the file calls them; all other fields have their own names.
struct Cloud
{
  std::vector<Eigen::Vector3d> positions; ///< exactly the numbers of the file
  bool single_precision = true;           ///< the coordinates were given as 32-bit floats
  std::vector<Field> fields;              ///< all but the coordinates; each as long as positions
  std::vector<std::string> warnings;      ///< what was odd about the file, one sentence each

  std::size_t size () const { return positions.size (); }

  /// The field of this name, or nullptr.
  const Field* find (const std::string& name) const
  {
    for (const Field& field : fields)
      if (field.name == name)
        return &field;
    return nullptr;
  }
};

/// Triangles as indices into a cloud.
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Three fields of one value each: the channels of a colour, or the coordinates of a normal.
using FieldTriple = std::array<const Field*, 3>;

/// The fields red, green and blue if they are 8-bit colours, else three times nullptr.
FieldTriple
colorFields (const Cloud& cloud);

/// The fields nx, ny and nz if they are floats of one type, else three times nullptr.
FieldTriple
normalFields (const Cloud& cloud);

/// A file cannot be used as input. The text names the cause, not the file.
class ReadError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Makes a cloud of the fields of a file: finds x, y and z, unpacks PCL's rgb and rgba, and gives
/// normals their common names.
/// \throws ReadError if there are no points, no coordinates, or two fields of one name
Cloud
makeCloud (std::vector<Field> fields, std::size_t size);

/// Removes the points that have a NaN or an infinity among their coordinates, and renumbers the
/// triangles, which must not use such points.
/// \return how many were removed
std::size_t
removeNonFinitePoints (Cloud& cloud, Triangles& triangles);

} // namespace floater
} // namespace pcl
