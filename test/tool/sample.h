// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A small cloud with colours, normals and intensities, and files of it.
#pragma once

#include "cloud.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl::floater {
/// Points of a wavy square in random order.
struct Sample
{
  bool is_double = false;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint8_t, 3>> colors;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> intensities;

  std::size_t size () const { return points.size (); }
};

/// Makes side * side points. In single precision every coordinate is a float. In double precision
/// the points are centimetres apart at map coordinates of a million metres, where floats could not
/// tell them apart.
Sample
makeSample (bool is_double, int side = 12);

enum class PcdKind
{
  ASCII,
  BINARY,
  COMPRESSED
};

/// The kinds that the tool reads: those that are compressed only where it was built with liblzf.
#ifdef PCL_FLOATER_HAS_LZF
constexpr bool READS_COMPRESSED = true;
#else
constexpr bool READS_COMPRESSED = false;
#endif
inline std::vector<PcdKind>
readPcdKinds ()
{
  std::vector<PcdKind> kinds{PcdKind::ASCII, PcdKind::BINARY};
  if (READS_COMPRESSED)
    kinds.push_back (PcdKind::COMPRESSED);
  return kinds;
}

/// The names of its fields.
inline std::vector<std::string>
namesOf (const Cloud& cloud)
{
  std::vector<std::string> names;
  for (const Field& field : cloud.fields)
    names.push_back (field.name);
  return names;
}

/// Writes a PCD file with PCL's own writer: x y z, rgb, normals, intensity.
void
writePcd (const std::string& path, const Sample& sample, PcdKind kind);

enum class PlyKind
{
  ASCII,
  LITTLE,
  BIG
};

/// A PLY file: x y z, red green blue, nx ny nz, intensity, with an element before the vertices, a
/// list among their properties, and a face.
std::string
plyText (const Sample& sample, PlyKind kind);

/// An OBJ file: points with colours, normals, a face.
std::string
objText (const Sample& sample);

/// A PCD file of ASCII numbers: x y z only.
std::string
pcdText (const std::vector<Eigen::Vector3d>& points);

} // namespace pcl::floater
