// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A point cloud with all fields of its file.
#pragma once

#include "byte_order.h"
#include "file_bytes.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pcl::floater {
/// A file cannot be used as input. The message names the cause, not the file.
class ReadError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

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

/// What formats call a type; empty if they do not have it.
struct TypeNames
{
  std::string_view ply, sized_ply, vtk;
  std::string_view pcd; // with the size
};
constexpr std::array<TypeNames, 10> TYPE_NAMES{{{"char", "int8", "signed_char", "I"},
                                                {"uchar", "uint8", "unsigned_char", "U"},
                                                {"short", "int16", "short", "I"},
                                                {"ushort", "uint16", "unsigned_short", "U"},
                                                {"int", "int32", "int", "I"},
                                                {"uint", "uint32", "unsigned_int", "U"},
                                                {"", "", "vtktypeint64", "I"},
                                                {"", "", "vtktypeuint64", "U"},
                                                {"float", "float32", "float", "F"},
                                                {"double", "float64", "double", "F"}}};

inline const TypeNames&
namesOf (ScalarType type)
{
  return TYPE_NAMES[static_cast<std::size_t> (type)];
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

/// Pointers to all of them.
inline std::vector<Field*>
pointersTo (std::vector<Field>& fields)
{
  std::vector<Field*> pointers;
  pointers.reserve (fields.size ());
  for (Field& field : fields)
    pointers.push_back (&field);
  return pointers;
}

/// Appends three fields that share an array of three values for each point.
/// \param first value of the first point, which `owner` keeps alive
template <typename T>
void
addColumns (const std::array<const char*, 3>& names, const std::shared_ptr<const void>& owner,
            const T* first, std::vector<Field>& fields)
{
  constexpr ScalarType TYPE = sizeof (T) == 1   ? ScalarType::UINT8
                              : sizeof (T) == 4 ? ScalarType::FLOAT32
                                                : ScalarType::FLOAT64;
  for (std::size_t i = 0; i < 3; ++i) {
    Field& field = fields.emplace_back (Field{names[i], TYPE});
    field.first = {owner, reinterpret_cast<const char*> (first + i)};
    field.stride = 3 * sizeof (T);
  }
}

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

/// A subset of the rows of a file, renumbered from 0. Takes a fifth of a byte per row, and no
/// memory if all rows are kept.
class KeptPoints
{
public:
  /// All rows.
  KeptPoints () = default;

  /// The rows for which keep (row) is true.
  template <typename Keep>
  KeptPoints (std::size_t rows, const Keep& keep)
  {
    std::vector<Word> words ((rows + WORD_ROWS - 1) / WORD_ROWS);
    for (std::size_t row = 0; row < rows; ++row) {
      Word& word = words[row / WORD_ROWS];
      if (row % WORD_ROWS == 0)
        word.before = static_cast<std::uint32_t> (kept_);
      if (keep (row)) {
        word.bits |= std::uint64_t{1} << row % WORD_ROWS;
        ++kept_;
      }
    }
    if (kept_ < rows)
      words_ = std::move (words);
  }

  bool areAll () const { return words_.empty (); }

  /// Number of rows that are kept, unless all are.
  std::size_t size () const { return kept_; }

  /// The new number of a row that is kept.
  std::uint32_t number (std::uint32_t row) const
  {
    if (areAll ())
      return row;
    const Word& word = words_[row / WORD_ROWS];
    const std::uint64_t below = (std::uint64_t{1} << row % WORD_ROWS) - 1;
    return word.before + static_cast<std::uint32_t> (__builtin_popcountll (word.bits & below));
  }

  /// The row of a new number; 0 if it is not below size (). O(log rows) if not all rows are kept.
  std::size_t row (std::size_t number) const
  {
    if (areAll ())
      return number;
    std::size_t first = 0;
    for (std::size_t last = words_.size (); last - first > 1;) {
      const std::size_t middle = first + (last - first) / 2;
      (words_[middle].before <= number ? first : last) = middle;
    }
    std::uint64_t bits = words_[first].bits;
    for (std::size_t i = words_[first].before; i < number; ++i)
      bits &= bits - 1; // clears the lowest bit
    if (bits == 0)
      return 0; // beyond size ()
    return first * WORD_ROWS + static_cast<std::size_t> (__builtin_ctzll (bits));
  }

private:
  static constexpr std::size_t WORD_ROWS = 64;

  struct Word
  {
    std::uint64_t bits = 0;   // kept rows
    std::uint32_t before = 0; // number of kept rows in the words before
  };

  std::vector<Word> words_;
  std::size_t kept_ = 0;
};

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
  std::size_t lattice_width = 0;         ///< of an organized cloud: points of a row; else 0
  std::vector<bool> left_out;            ///< rows that are no points of the mesh; or empty
  std::vector<Eigen::Vector3f>
      towards_sensors;               ///< of several scans: normals to the seen side; or empty
  KeptPoints kept;                   ///< points that are left in an output
  std::vector<std::string> warnings; ///< oddities of the file, one sentence each
  std::vector<std::string> notes;    ///< what it holds and what was left out of it
  FileBytes file;                    ///< the file, if the fields refer to it

  /// Number of points that are left.
  std::size_t size () const { return kept.areAll () ? rows : kept.size (); }

  /// The row of a point.
  std::size_t row (std::size_t point) const { return kept.row (point); }

  /// The coordinates, exactly as in the file if there is no shift.
  Eigen::Vector3d position (std::size_t point) const { return positionOfRow (row (point)); }

  Eigen::Vector3d positionOfRow (std::size_t row) const
  {
    return Eigen::Vector3d (coordinates[0].scaled (row), coordinates[1].scaled (row),
                            coordinates[2].scaled (row)) -
           shift;
  }

  /// Whether a row was left out on purpose.
  bool isLeftOut (std::size_t row) const { return !left_out.empty () && left_out[row]; }

  /// The positions of all points.
  std::vector<Eigen::Vector3d> positions () const;

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
bool
widenCoordinates (const std::vector<Field*>& fields);

/// The warning that the file has faces, which are not read.
std::string
facesLeftOut (std::size_t faces);

/// The shift as text, "500000 5500000 0"; empty if there is none.
std::string
shiftText (const Cloud& cloud);

/// Leaves rows out of the mesh and of its file, with a note that counts them; the numbers of all
/// points stay until that is written.
void
leaveOut (Cloud& cloud, const std::vector<bool>& rows, const std::string& what);

/// Leaves out the rows of the list that have finite coordinates.
void
leaveOut (Cloud& cloud, const std::vector<std::uint32_t>& rows);

/// Takes the rows that were left out, and points with a NaN or infinite coordinate, out of the
/// cloud, and renumbers the triangles, which must not use such points. No values are moved or
/// copied.
/// \return the number of points that are not finite
std::size_t
removeNonFinitePoints (Cloud& cloud, Triangles& triangles);

/// A cloud of some rows of another one, in any order, each as often as it is named; all of them are
/// kept. Coordinates, shift and all fields are copied. O(rows).
/// \param added fields of one value that come after those of the cloud; setValues gives them their
/// values. A field of the cloud that has the name of one of them is left out
Cloud
copyRows (const Cloud& cloud, const std::vector<std::size_t>& rows,
          const std::vector<Field>& added);

/// Sets the values of a field that copyRows has added. \tparam T the C++ type of the field
template <typename T>
void
setValues (Cloud& copied, const std::string& name, const std::vector<T>& values)
{
  const Field& field = *copied.find (name);
  auto* bytes = const_cast<char*> (field.first.get ()); // copyRows has allocated them
  for (std::size_t i = 0; i < values.size (); ++i)
    std::memcpy (bytes + i * field.stride, &values[i], sizeof (T));
}

} // namespace pcl::floater
