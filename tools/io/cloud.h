// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A point cloud with all fields of its file.
#pragma once

#include "field.h"
#include "file_bytes.h"
#include "kept_points.h"
#include "read_error.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl::floater {
/// A point cloud. Whatever the file calls them, colours are the fields red, green, blue (and alpha)
/// of type UINT8, and normals are nx, ny, nz. All other fields keep their names. The fields have
/// all rows of the file, also those of points that have been left out since.
struct Cloud
{
  std::array<Field, 3> coordinates; ///< x, y, z; one value each
  bool single_precision = true;     ///< the coordinates were given as 32-bit floats
  bool are_decimals =
      false; ///< the coordinates are decimals of a text that does not tell their type
  Eigen::Vector3d shift = Eigen::Vector3d::Zero (); ///< is subtracted from the coordinates
  std::array<double, 3> sensor_origin{}; ///< of the sensor, if the file tells; not shifted
  std::vector<Field> fields;             ///< all but the coordinates
  std::size_t rows = 0;                  ///< points of the file
  std::size_t lattice_width = 0;         ///< of an organized cloud: points of a row; else 0
  KeptPoints kept;                       ///< points that are left
  std::vector<std::string> warnings;     ///< oddities of the file, one sentence each
  FileBytes file;                        ///< the file, if the fields refer to it

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
/// \throws ReadError if there are no points or no coordinates
Cloud
makeCloud (std::vector<Field> fields, std::size_t size);

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

/// Leaves out the points with a NaN or infinite coordinate, and renumbers the triangles, which must
/// not use such points. No values are moved or copied.
/// \return the number of points left out
std::size_t
removeNonFinitePoints (Cloud& cloud, Triangles& triangles);

} // namespace pcl::floater
