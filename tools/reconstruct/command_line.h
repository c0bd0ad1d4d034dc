// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of pcl_floater_reconstruct.
#pragma once

#include "cloud_reader.h"
#include "mesh_writer.h"
#include "options/option_rows.h"

namespace pcl::floater {
/// The command line is wrong, or asks for something impossible.
using UsageError = ErrorOf<EXIT_USAGE>;

/// Calls work (), and makes an exit code of what it throws, which it prints.
/// \param if_no_memory what to do where memory was not enough
int
guarded (const char* program, const char* if_no_memory, const std::function<int ()>& work);

/// Precision of the coordinates in outputs. Readers that expect 32-bit floats, as PCL's loadPLYFile
/// into PointXYZ does, take doubles of a PLY file for (0, 0, 0).
enum class Precision
{
  AUTO,   ///< SINGLE, after a shift where floats are too coarse
  SINGLE, ///< 32-bit floats; other coordinates are rounded
  DOUBLE  ///< 64-bit floats
};

/// What the user asked for. Paths that were not given are empty.
struct CommandLine
{
  const char* program = "pcl_floater_reconstruct"; ///< that tells of a failure
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path report;
  std::filesystem::path html;              ///< the report as a page
  std::size_t shown_triangles = 1'000'000; ///< most triangles of the page
  std::filesystem::path parameterization;
  std::filesystem::path loop;
  std::filesystem::path texture;         ///< image of the colours of the points
  int texture_size = 0;                  ///< of its side, in pixels; 0: chosen by the points
  bool texture_coordinates = false;      ///< --uv; also if a texture is asked for
  CloudFormat input_format = nullptr;    ///< nullptr: that of its extension
  MeshFormat output_format = nullptr;    ///< nullptr: that of its extension
  std::array<std::size_t, 3> columns{};  ///< of x, y and z in text, from 1; zeros: found
  std::vector<int> classes;              ///< of airborne scans; empty: all but noise
  std::filesystem::path scratch;         ///< folder; used with a limit only
  std::size_t max_memory = 0;            ///< bytes; 0: no limit
  std::optional<Eigen::Vector3d> shift;  ///< --shift x,y,z
  bool auto_shift = false;               ///< --shift auto, or needed for floats
  Precision precision = Precision::AUTO; ///< of coordinates in outputs
  bool use_input_normals = false;        ///< for tangent planes, and so for the facing
  bool compute_normals = false;          ///< of the vertices of the mesh
  Options options;                       ///< without the loop, which has not been read yet
  bool quiet = false;
  bool verbose = false; ///< print all warnings, and what the run is not sure of
  bool json = false;
  bool strict = false;                 ///< write no poor mesh, and none with points left out
  std::vector<std::string> warnings{}; ///< on options that have no effect, whatever the cloud is

  /// How the input is read: all digits of a text count if it is shifted.
  ReadOptions readOptions () const { return {auto_shift || shift, columns, classes}; }

  MeshFormat meshFormat () const
  {
    return output_format != nullptr ? output_format : meshFormatOf (output);
  }

  /// The file of materials beside an OBJ file with texture coordinates; else empty.
  std::filesystem::path materials () const
  {
    return texture_coordinates && meshFormat () == writeObj ? materialsBeside (output)
                                                            : std::filesystem::path ();
  }
};

constexpr Choice<Precision> PRECISION_CHOICES[] = {
    {"auto", Precision::AUTO}, {"single", Precision::SINGLE}, {"double", Precision::DOUBLE}};

/// Parses the command line, and checks all paths against each other and against the disk. Prints the
/// help or the version if asked for.
/// \return the exit code if there is nothing else to do
/// \throws UsageError also if one file is named twice, WriteError if an output cannot be written,
/// ReadError if the extension of the input is unknown
std::optional<int>
parseCommandLine (int argc, char** argv, CommandLine& line);

} // namespace pcl::floater
