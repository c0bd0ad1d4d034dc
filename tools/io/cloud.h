// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A point cloud with all fields of its file.
#pragma once

#include "file_bytes.h"
#include "format.h"

#include <Eigen/Core>
#include <boost/range/algorithm_ext/erase.hpp>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

namespace pcl::floater {
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

/// The C++ types in the order of ScalarType.
using ScalarTypes = std::tuple<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
                               std::uint32_t, std::int64_t, std::uint64_t, float, double>;

/// Calls visitor (T{}) with the C++ type T of `type`, and returns its result.
template <std::size_t First = 0, typename Visitor>
auto
visitType (ScalarType type, Visitor&& visitor)
{
  if constexpr (First + 1 < std::tuple_size_v<ScalarTypes>)
    if (static_cast<std::size_t> (type) != First)
      return visitType<First + 1> (type, visitor);
  return visitor (std::tuple_element_t<First, ScalarTypes>{});
}

inline std::size_t
sizeOf (ScalarType type)
{
  return visitType (type, [] (auto tag) { return sizeof (tag); });
}

/// What formats call a type; empty if they do not have it.
struct TypeNames
{
  std::string_view ply, sized_ply, vtk, vtp;
  std::string_view pcd; // with the size
};
constexpr std::array<TypeNames, 10> TYPE_NAMES{
    {{"char", "int8", "signed_char", "Int8", "I1"},
     {"uchar", "uint8", "unsigned_char", "UInt8", "U1"},
     {"short", "int16", "short", "Int16", "I2"},
     {"ushort", "uint16", "unsigned_short", "UInt16", "U2"},
     {"int", "int32", "int", "Int32", "I4"},
     {"uint", "uint32", "unsigned_int", "UInt32", "U4"},
     {"", "", "vtktypeint64", "Int64", "I8"},
     {"", "", "vtktypeuint64", "UInt64", "U8"},
     {"float", "float32", "float", "Float32", "F4"},
     {"double", "float64", "double", "Float64", "F8"}}};

inline const TypeNames&
namesOf (ScalarType type)
{
  return TYPE_NAMES[static_cast<std::size_t> (type)];
}

/// The type that a format calls so, if there is one.
inline std::optional<ScalarType>
typeCalled (std::string_view name, std::string_view TypeNames::*format)
{
  for (std::size_t type = 0; type < TYPE_NAMES.size (); ++type)
    if (!name.empty () && TYPE_NAMES[type].*format == name)
      return static_cast<ScalarType> (type);
  return std::nullopt;
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
  ByteOrder order = ByteOrder::native;
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

inline std::vector<Field*>
pointersTo (std::vector<Field>& fields)
{
  std::vector<Field*> pointers;
  pointers.reserve (fields.size ());
  for (Field& field : fields)
    pointers.push_back (&field);
  return pointers;
}

/// Appends fields of one value each, columns of an array that they keep.
/// \param values a vector of numbers, or of arrays of numbers
/// \param width columns of the array; 0: as many as there are names
template <typename Values>
void
addColumns (const std::vector<std::string>& names, ScalarType type, Values values,
            std::vector<Field>& fields, std::size_t width = 0)
{
  const auto kept = std::make_shared<const Values> (std::move (values));
  const auto* first = reinterpret_cast<const char*> (kept->data ());
  const std::size_t stride = (width > 0 ? width : names.size ()) * sizeOf (type);
  for (const std::string& name : names) {
    fields.push_back ({name, type, 1, {kept, first}, stride});
    if (first != nullptr) // there are values
      first += sizeOf (type);
  }
}

inline std::size_t
rowBytes (const std::vector<Field*>& fields)
{
  std::size_t bytes = 0;
  for (const Field* field : fields)
    bytes += field->pointBytes ();
  return bytes;
}

/// Makes the fields views of rows: all fields of the first point from `first` on, then all fields
/// of the next.
inline void
viewRows (const std::vector<Field*>& fields, const std::shared_ptr<const char>& first,
          ByteOrder order)
{
  const std::size_t stride = rowBytes (fields);
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
  const std::shared_ptr<char> rows (new char[points * rowBytes (fields)],
                                    std::default_delete<char[]> ());
  viewRows (fields, rows, ByteOrder::native);
  return rows;
}

/// Writes the values that a field has of one point, in the byte order of this machine.
/// \param next next (T{}, c) is value c, of the C++ type T of the field
/// \return where the next field begins in rows of allocateRows
template <typename Next>
char*
putValues (const Field& field, char* to, const Next& next)
{
  visitType (field.type, [&] (auto value) {
    for (std::size_t c = 0; c < field.count; ++c, to += sizeof value) {
      value = next (value, c);
      std::memcpy (to, &value, sizeof value);
    }
  });
  return to;
}

/// Three fields of one value each: the channels of a colour, or the coordinates of a normal.
using FieldTriple = std::array<const Field*, 3>;

/// A point cloud. Whatever the file calls them, colours are the fields red, green, blue (and alpha)
/// of type UINT8, and normals are nx, ny, nz. All other fields keep their names. The fields have
/// all rows of the file, also those of points that have been left out since.
struct Cloud
{
  std::array<Field, 3> coordinates;                 ///< x, y, z; one value each
  bool single_precision = true;                     ///< the coordinates were given as 32-bit floats
  Eigen::Vector3d shift = Eigen::Vector3d::Zero (); ///< is subtracted from the coordinates
  bool may_be_degrees = false;                      ///< names or scales say so of x and y
  std::string projection; ///< if x and y seem to be degrees beside metres: what to do about it
  std::array<double, 3> sensor_origin{}; ///< of the sensor, if the file tells; not shifted
  std::vector<Field> fields;             ///< all but the coordinates
  std::size_t rows = 0;                  ///< points of the file
  std::vector<bool> left_out;            ///< rows that are no points of the mesh; or empty
  std::vector<Eigen::Vector3f>
      towards_sensors;               ///< of several scans: normals to the seen side; or empty
  std::vector<std::uint32_t> kept;   ///< rows that are left in an output, ascending; empty: all
  std::vector<std::string> warnings; ///< oddities of the file, one sentence each
  std::vector<std::string> notes;    ///< what it holds and what was left out of it
  FileBytes file;                    ///< the file, if the fields refer to it

  std::size_t size () const { return kept.empty () ? rows : kept.size (); }

  std::size_t row (std::size_t point) const { return kept.empty () ? point : kept[point]; }

  /// The point of a row that is left. O(log rows).
  std::uint32_t pointOf (std::uint32_t row) const
  {
    const auto found = std::lower_bound (kept.begin (), kept.end (), row);
    return kept.empty () ? row : static_cast<std::uint32_t> (found - kept.begin ());
  }

  /// The coordinates, exactly as in the file if there is no shift.
  Eigen::Vector3d position (std::size_t point) const { return positionOfRow (row (point)); }

  Eigen::Vector3d positionOfRow (std::size_t row) const
  {
    return Eigen::Vector3d (coordinates[0].scaled (row), coordinates[1].scaled (row),
                            coordinates[2].scaled (row)) -
           shift;
  }

  bool isLeftOut (std::size_t row) const { return !left_out.empty () && left_out[row]; }

  std::vector<Eigen::Vector3d> positions () const
  {
    std::vector<Eigen::Vector3d> result (size ());
    for (std::size_t i = 0; i < result.size (); ++i)
      result[i] = position (i);
    return result;
  }

  /// The shift, "500000 5500000 0"; empty if there is none.
  std::string shiftText () const;

  /// The field of this name, or nullptr.
  const Field* find (const std::string& name) const
  {
    for (const Field& field : fields)
      if (field.name == name)
        return &field;
    return nullptr;
  }

  /// The fields of these names if they have one value each and one of these types.
  FieldTriple findTriple (const std::array<const char*, 3>& names,
                          std::initializer_list<ScalarType> types) const
  {
    FieldTriple triple{};
    for (std::size_t i = 0; i < 3; ++i) {
      triple[i] = find (names[i]);
      if (!triple[i] || triple[i]->count != 1 || triple[i]->type != triple[0]->type)
        return {};
    }
    const bool fits = std::find (types.begin (), types.end (), triple[0]->type) != types.end ();
    return fits ? triple : FieldTriple{};
  }

  /// The fields red, green and blue if they are 8-bit colours, else three times nullptr.
  FieldTriple colors () const { return findTriple ({"red", "green", "blue"}, {ScalarType::UINT8}); }

  /// The fields nx, ny and nz if they are floats of one type, else three times nullptr.
  FieldTriple normals () const
  {
    return findTriple ({"nx", "ny", "nz"}, {ScalarType::FLOAT32, ScalarType::FLOAT64});
  }
};

inline std::vector<Field*>
allFields (Cloud& cloud)
{
  std::vector<Field*> fields = pointersTo (cloud.fields);
  fields.insert (fields.begin (),
                 {&cloud.coordinates[0], &cloud.coordinates[1], &cloud.coordinates[2]});
  return fields;
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

inline Eigen::Vector3d
vectorOf (const FieldTriple& fields, std::size_t row)
{
  return {fields[0]->asDouble (row), fields[1]->asDouble (row), fields[2]->asDouble (row)};
}

/// Makes a cloud from the fields of a file: finds x, y and z (or X, Y, Z), unpacks PCL's rgb and
/// rgba, and names normals nx, ny and nz. A second field of a name gets another one, and a second
/// colour is left out; warnings tell.
/// \param warnings come before these
/// \throws ReadError if there are no points or no coordinates
Cloud
makeCloud (std::vector<Field> fields, std::size_t size, std::vector<std::string> warnings = {});

/// Makes the fields x, y and z of a text double if they are float: then they get all digits of the
/// text.
/// \return whether all three were float
inline bool
widenCoordinates (const std::vector<Field*>& fields)
{
  int widened = 0;
  for (Field* field : fields)
    if ((field->name == "x" || field->name == "y" || field->name == "z") &&
        field->type == ScalarType::FLOAT32) {
      field->type = ScalarType::FLOAT64;
      ++widened;
    }
  return widened == 3;
}

/// The warning that the file has faces, which are not read.
inline std::string
facesLeftOut (std::size_t faces)
{
  return counted (faces, "face") + " of the input file " + (faces == 1 ? "was" : "were") +
         " left out: only its points are used";
}

/// Leaves rows out of the mesh and of its file, with a note that counts them; the numbers of all
/// points stay until that is written.
inline void
leaveOut (Cloud& cloud, const std::vector<bool>& rows, const std::string& what)
{
  const auto count = static_cast<std::size_t> (std::count (rows.begin (), rows.end (), true));
  if (count == 0)
    return;
  cloud.notes.push_back (counted (count, "point") + " " + what + (count == 1 ? " was" : " were") +
                         " left out");
  cloud.left_out.resize (cloud.rows, false);
  for (std::size_t row = 0; row < cloud.rows; ++row)
    cloud.left_out[row] = cloud.left_out[row] || rows[row];
}

/// Takes the rows that were left out, and points with a NaN or infinite coordinate, out of the
/// cloud, and renumbers the triangles; those that use such a point are removed. No values are moved
/// or copied.
/// \return the number of points that are not finite
std::size_t
removeNonFinitePoints (Cloud& cloud, Triangles& triangles);

/// The points that triangles use, in the order in which they come first; the triangles are renumbered
/// by their places in it.
inline std::vector<std::uint32_t>
takeUsed (std::size_t points, Triangles& triangles)
{
  constexpr std::uint32_t UNUSED = std::numeric_limits<std::uint32_t>::max ();
  std::vector<std::uint32_t> place (points, UNUSED), used;
  for (auto& triangle : triangles)
    for (std::uint32_t& corner : triangle) {
      if (place[corner] == UNUSED) {
        place[corner] = static_cast<std::uint32_t> (used.size ());
        used.push_back (corner);
      }
      corner = place[corner];
    }
  return used;
}

/// Adds fields like addColumns, in place of those that have their names.
template <typename Values>
void
replaceColumns (const std::vector<std::string>& names, ScalarType type, Values values,
                std::vector<Field>& fields)
{
  boost::remove_erase_if (fields, [&names] (const Field& field) {
    return std::find (names.begin (), names.end (), field.name) != names.end ();
  });
  addColumns (names, type, std::move (values), fields);
}

/// A cloud of some rows of another one, in any order, each as often as it is named; all of them are
/// kept. Coordinates, shift and all fields are copied. O(rows).
Cloud
copyRows (const Cloud& cloud, const std::vector<std::size_t>& rows);

} // namespace pcl::floater
