// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads point clouds: PCD, PLY, OBJ, STL, VTK, LAS, lidar's floats, and text with a point in each
// line; and meshes: PLY and VTK.
//
// PCL's own readers would do for most PCD, PLY and OBJ files. But they read a word that is no
// number as 0 without an error, round the coordinates of OBJ to single precision, and need 2 s for
// a million points in ASCII PLY or OBJ, against 0.2 s here. And libpcl_io loads VTK, which costs
// every start 20 ms and 20 MB. Debian has no library for LAS that is kept.
#pragma once

#include "cloud.h"

namespace pcl::floater {
/// Cuts a polygon into triangles at its first corner.
/// \param points of which the corners must be
/// \throws ReadError if there is no such point
inline void
addFan (const std::vector<double>& corners, std::size_t points, Triangles& triangles)
{
  const auto corner = [&corners] (std::size_t i) {
    return static_cast<std::uint32_t> (corners[i]);
  };
  for (std::size_t i = 0; i < corners.size (); ++i) {
    if (!(corners[i] >= 0.0 && corners[i] < static_cast<double> (points)))
      throw ReadError ("a polygon has a corner that is none of the " + counted (points, "point"));
    if (i > 1)
      triangles.push_back ({corner (0), corner (i - 1), corner (i)});
  }
}

/// Calls read (), and adds the name of the file to a ReadError.
template <typename Read>
auto
readNamed (const std::filesystem::path& path, Read&& read)
{
  try {
    return read ();
  }
  catch (const ReadError& error) {
    throw ReadError ("cannot read " + inputName (path) + ": " + error.what ());
  }
}

/// Fails because a file has less than its header tells.
[[noreturn]] inline void
failPromise (const std::string& what, std::uint64_t promised, std::size_t found)
{
  throw ReadError ("the header promises " + std::to_string (promised) + " " + what +
                   ", but the file has only " + std::to_string (found) +
                   "; it is truncated or its header is wrong");
}

/// Requires that the bytes that are left can hold what the header promises. To be called before
/// anything is allocated, because a header may claim any number.
/// \param each least bytes of each
inline void
requireRoom (const std::string& what, std::uint64_t promised, std::size_t each, std::size_t bytes)
{
  const std::size_t most = each > 0 ? bytes / each : 0;
  if (promised > most)
    failPromise (what + " of at least " + counted (each, "byte") + " each", promised, most);
}

constexpr const char* CLOUD_EXTENSIONS =
    ".pcd, .ply, .obj, .stl, .vtk, .vtp, .las, .bin, .ptx, .pts, .xyz, .txt, .csv, .asc or .pwn";

/// What to do with a compressed LAS file.
constexpr const char* LAZ_ADVICE = "it is compressed (LAZ), which cannot be read; decompress it: "
                                   "laszip -i a.laz -o a.las, or pdal translate a.laz a.las";

struct ReadOptions
{
  /// read the coordinates of text files as doubles, also where the file says float;
  /// Cloud::single_precision is as the file says
  bool all_digits = false;
  std::array<std::size_t, 3> columns{}; ///< of x, y and z in text, from 1; zeros: found
  std::vector<int> classes{};           ///< of airborne scans; empty: all but those of noise
  Triangles* faces = nullptr;           ///< get those of PLY and VTK, polygons as several
};

/// Makes a cloud of the bytes of a file, which are not empty. It has points of all classes.
/// doc/formats.md has the variants of each format, and what is read of them.
using CloudParser = Cloud (const FileBytes& file, const ReadOptions& options);

CloudParser parsePcd; ///< padding fields ("_") are skipped; coordinates are not transformed
CloudParser
    parsePly; ///< "face" if faces are asked for; without it, what follows "vertex" is ignored
CloudParser parseVtk; ///< polygons of both layouts; texture coordinates are the fields s and t
CloudParser parseVtp; ///< its faces are counted only
CloudParser parseObj; ///< normals of as many "vn" as "v" lines, or of those that faces name
CloudParser parseStl;
CloudParser parsePtx; ///< of several scans, each point has the number of its scan
CloudParser parseLas; ///< a class, the flags synthetic and withheld, and a time are fields

/// Floats, as KITTI and nuScenes store what a spinning lidar has seen: x, y, z and intensity of each
/// point, and the ring, a whole number, where there are five.
CloudParser parseBin;

/// Text with a point in each line.
/// \throws ReadError also if the first column counts the points, or a header names no coordinates
CloudParser parseXyz;

/// The same, as scanners write it: of columns without names, where a colour could begin in the fourth or
/// the fifth, the intensity comes before it.
CloudParser parsePts;

using CloudFormat = CloudParser*;

/// The names of formats, which are extensions as well; others are those of text.
constexpr std::pair<const char*, CloudFormat> CLOUD_FORMATS[] = {
    {"auto", nullptr}, {"pcd", parsePcd}, {"ply", parsePly}, {"obj", parseObj},
    {"stl", parseStl}, {"vtk", parseVtk}, {"vtp", parseVtp}, {"las", parseLas},
    {"bin", parseBin}, {"ptx", parsePtx}, {"xyz", parseXyz}, {"pts", parsePts}};

/// The format that the extension of a file tells, in upper or lower case; nullptr if it is unknown.
inline CloudFormat
cloudFormatOf (const std::filesystem::path& path)
{
  for (const char* text : {".txt", ".csv", ".asc", ".pwn"})
    if (lowerExtension (path) == text)
      return parseXyz;
  return formatOf (path, CLOUD_FORMATS);
}

/// The same.
/// \param advice what else to do if the format is unknown
/// \throws ReadError if it is; of formats that are not read, with the command that converts them
inline CloudFormat
requireCloudFormat (const std::filesystem::path& path, const char* advice = "")
{
  const std::string extension = lowerExtension (path);
  if (extension == ".laz")
    throw ReadError (LAZ_ADVICE);
  if (extension == ".e57")
    throw ReadError ("it is an E57 file, which cannot be read; convert it: pdal translate a.e57 "
                     "a.las, or CloudCompare -SILENT -O a.e57 -C_EXPORT_FMT PLY -SAVE_CLOUDS");
  if (const CloudFormat format = cloudFormatOf (path))
    return format;
  throw ReadError (unknownExtension (path) + "; use " + CLOUD_EXTENSIONS + advice);
}

/// Reads a cloud. The fields of uncompressed binary files stay in the mapped file.
/// \param path "-": the standard input
/// \param format nullptr: that which the extension tells
/// \throws ReadError if the file is not a complete and valid cloud, or the extension is unknown
Cloud
readCloud (const std::filesystem::path& path, const ReadOptions& options = {},
           CloudFormat format = nullptr);

} // namespace pcl::floater
