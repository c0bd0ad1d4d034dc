// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud.h"

#include <algorithm>
#include <limits>
#include <set>

namespace pcl
{
namespace floater
{
namespace
{
FieldTriple
findTriple (const Cloud& cloud, const std::array<const char*, 3>& names)
{
  FieldTriple triple{};
  for (std::size_t i = 0; i < 3; ++i) {
    triple[i] = cloud.find (names[i]);
    if (!triple[i] || triple[i]->count != 1 || triple[i]->type != triple[0]->type)
      return {};
  }
  return triple;
}

std::string
listNames (const std::vector<Field>& fields)
{
  std::string names;
  for (const Field& field : fields)
    names += (names.empty () ? "" : ", ") + field.name;
  return names.empty () ? "none" : names;
}

std::size_t
coordinateField (const std::vector<Field>& fields, const std::string& name)
{
  const auto found = std::find_if (fields.begin (), fields.end (),
                                   [&] (const Field& field) { return field.name == name; });
  if (found == fields.end ())
    throw ReadError ("the points have no coordinate '" + name +
                     "' (fields of the file: " + listNames (fields) + ")");
  if (found->count != 1)
    throw ReadError ("the coordinate '" + name + "' has more than one value for each point");
  if (found->type == ScalarType::INT64 || found->type == ScalarType::UINT64)
    throw ReadError ("the coordinate '" + name +
                     "' is a 64-bit integer, which a double cannot hold; convert it to double");
  return static_cast<std::size_t> (found - fields.begin ());
}

/// PCL packs a colour into the 32 bits of one number, from the highest: alpha, red, green, blue.
void
unpackColor (const Field& packed, bool with_alpha, std::vector<Field>& fields)
{
  const std::size_t size = packed.bytes.size () / sizeof (std::uint32_t);
  const std::array<const char*, 4> names{"red", "green", "blue", "alpha"};
  const std::array<unsigned, 4> shifts{16, 8, 0, 24};
  for (std::size_t channel = 0; channel < (with_alpha ? 4U : 3U); ++channel) {
    Field field{names[channel], ScalarType::UINT8};
    field.bytes.resize (size);
    for (std::size_t i = 0; i < size; ++i)
      field.bytes[i] =
          static_cast<std::uint8_t> (packed.value<std::uint32_t> (i) >> shifts[channel]);
    fields.push_back (std::move (field));
  }
}

std::string
commonName (const std::string& name)
{
  static const std::array<std::array<const char*, 2>, 3> others{
      {{"normal_x", "nx"}, {"normal_y", "ny"}, {"normal_z", "nz"}}};
  for (const auto& other : others)
    if (name == other[0])
      return other[1];
  return name;
}

} // namespace

FieldTriple
colorFields (const Cloud& cloud)
{
  const FieldTriple colors = findTriple (cloud, {"red", "green", "blue"});
  return colors[0] && colors[0]->type == ScalarType::UINT8 ? colors : FieldTriple{};
}

FieldTriple
normalFields (const Cloud& cloud)
{
  const FieldTriple normals = findTriple (cloud, {"nx", "ny", "nz"});
  const bool are_floats = normals[0] && (normals[0]->type == ScalarType::FLOAT32 ||
                                         normals[0]->type == ScalarType::FLOAT64);
  return are_floats ? normals : FieldTriple{};
}

Cloud
makeCloud (std::vector<Field> fields, std::size_t size)
{
  if (size == 0)
    throw ReadError ("it holds no points");
  if (size > static_cast<std::size_t> (std::numeric_limits<std::int32_t>::max ()))
    throw ReadError ("it holds more points than a mesh file can number (2147483647); split it");
  const std::array<std::size_t, 3> columns{
      coordinateField (fields, "x"), coordinateField (fields, "y"), coordinateField (fields, "z")};
  Cloud cloud;
  cloud.positions.resize (size);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Field& field = fields[columns[axis]];
    cloud.single_precision &= field.type == ScalarType::FLOAT32;
    visitType (field.type, [&] (auto tag) {
      for (std::size_t i = 0; i < size; ++i)
        cloud.positions[i][static_cast<Eigen::Index> (axis)] =
            static_cast<double> (field.value<decltype (tag)> (i));
    });
    std::vector<std::uint8_t> ().swap (field.bytes);
  }
  std::set<std::string> names;
  for (std::size_t f = 0; f < fields.size (); ++f) {
    if (!names.insert (fields[f].name).second)
      throw ReadError ("there are two fields '" + fields[f].name + "'");
    if (std::find (columns.begin (), columns.end (), f) != columns.end ())
      continue;
    const bool is_rgb = fields[f].name == "rgb" || fields[f].name == "rgba";
    if (is_rgb && fields[f].pointBytes () == sizeof (std::uint32_t) && fields[f].count == 1) {
      unpackColor (fields[f], fields[f].name == "rgba", cloud.fields);
      continue;
    }
    cloud.fields.push_back (std::move (fields[f]));
    cloud.fields.back ().name = commonName (cloud.fields.back ().name);
  }
  names.clear ();
  for (const Field& field : cloud.fields)
    if (!names.insert (field.name).second)
      throw ReadError ("there are two fields for '" + field.name + "'");
  return cloud;
}

std::size_t
removeNonFinitePoints (Cloud& cloud, Triangles& triangles)
{
  const std::size_t size = cloud.size ();
  std::vector<std::uint32_t> new_index (size);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size; ++i) {
    new_index[i] = static_cast<std::uint32_t> (kept);
    kept += cloud.positions[i].allFinite () ? 1 : 0;
  }
  if (kept == size)
    return 0;
  const auto move_row = [&] (std::uint8_t* bytes, std::size_t row, std::size_t i) {
    std::memmove (bytes + new_index[i] * row, bytes + i * row, row);
  };
  for (Field& field : cloud.fields) {
    for (std::size_t i = 0; i < size; ++i)
      if (cloud.positions[i].allFinite ())
        move_row (field.bytes.data (), field.pointBytes (), i);
    field.bytes.resize (kept * field.pointBytes ());
  }
  cloud.positions.erase (std::remove_if (cloud.positions.begin (), cloud.positions.end (),
                                         [] (const Eigen::Vector3d& p) { return !p.allFinite (); }),
                         cloud.positions.end ());
  for (auto& triangle : triangles)
    for (std::uint32_t& corner : triangle)
      corner = new_index[corner];
  return size - kept;
}

} // namespace floater
} // namespace pcl
