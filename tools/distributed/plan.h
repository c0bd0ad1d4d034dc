// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The manifest of a work folder: what is reconstructed, how, and in which blocks.
#pragma once

#include "run_report.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl::floater {
/// A file of points as it was when the plan was made.
struct InputFile
{
  std::string file;
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0; ///< of all bytes
};

/// All that the steps after the first need to know, but the points.
struct Plan
{
  std::uint64_t id = 0; ///< of inputs, parameters and format; in all files of the folder
  std::vector<InputFile> inputs;
  std::vector<std::string> arguments; ///< options of the command line that made it
  std::string parameters;             ///< those that decide the result, as text
  std::size_t points = 0;             ///< of the working set, with outliers
  std::size_t blocks = 0;
  std::size_t selected_points = 0;
  std::array<double, 3> centre{}, sensor_origin{};
  double scale = 1.0;
  std::vector<std::string> warnings; ///< of the cloud
  RunFigures figures;                ///< what is known of the cloud

  std::size_t cloudSize () const { return figures.input_points; }
  Eigen::Vector3d shift () const { return Eigen::Vector3d (figures.shift.data ()); }
};

/// \throws ReadError if a file is missing
InputFile
describeInput (const std::filesystem::path& path);

/// Identifies a plan: the same for the same files, parameters and arguments of the one that made it.
std::uint64_t
planId (const std::vector<InputFile>& inputs, const std::string& parameters, std::size_t blocks,
        const std::vector<std::string>& arguments);

std::string
manifestText (const Plan& plan);

/// \param name for messages
/// \throws WorkError if it is no manifest of this version, or damaged
Plan
parseManifest (const std::string& text, const std::string& name);

/// Reads all files, one after the other; a single one is mapped as it is. Of several, the fields
/// are those that all files have with one type, and coordinates are doubles.
/// \param[out] firsts the first row of each file, and the number of all rows
/// \throws ReadError, which names the file
Cloud
readClouds (const std::vector<std::filesystem::path>& files, const ReadOptions& options,
            std::vector<std::size_t>& firsts);

} // namespace pcl::floater
