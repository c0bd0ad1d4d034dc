// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The folder that the benchmark writes: report.md with its pictures and CSV files.
#pragma once

#include "table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// Collects a Markdown text. Pictures and CSV files are written at once, the text by finish ().
class ReportFolder
{
public:
  /// Makes the folder. \throw std::filesystem::filesystem_error
  explicit ReportFolder (std::filesystem::path folder);

  void heading (const std::string& text);

  void paragraph (const std::string& text);

  /// A table in the text, and as NAME.csv.
  void table (const std::string& name, const Table& table);

  /// NAME.csv alone.
  void data (const std::string& name, const Table& table) const;

  /// A picture in the text, and as NAME.png. \throw WriteError
  void picture (const std::string& name, const std::vector<unsigned char>& png,
                const std::string& caption);

  /// Writes report.md. \return its path \throw WriteError
  std::filesystem::path finish () const;

private:
  std::filesystem::path folder_;
  std::string text_;
};

} // namespace floater
} // namespace pcl
