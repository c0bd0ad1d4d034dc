// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_folder.h"

#include "atomic_file.h"

#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
void
writeFile (const std::filesystem::path& path, const void* bytes, std::size_t size)
{
  AtomicFile file (path);
  file.write (bytes, size);
  file.close ();
  file.publish ();
}

} // namespace

ReportFolder::ReportFolder (std::filesystem::path folder) : folder_ (std::move (folder))
{
  std::filesystem::create_directories (folder_);
}

void
ReportFolder::heading (const std::string& text)
{
  text_ += (text_.empty () ? "# " : "\n## ") + text + "\n";
}

void
ReportFolder::paragraph (const std::string& text)
{
  text_ += "\n" + text + "\n";
}

void
ReportFolder::table (const std::string& name, const Table& table)
{
  data (name, table);
  text_ += "\n" + toMarkdown (table);
}

void
ReportFolder::data (const std::string& name, const Table& table) const
{
  const std::string csv = toCsv (table);
  writeFile (folder_ / (name + ".csv"), csv.data (), csv.size ());
}

void
ReportFolder::picture (const std::string& name, const std::vector<unsigned char>& png,
                       const std::string& caption)
{
  writeFile (folder_ / (name + ".png"), png.data (), png.size ());
  text_ += "\n![" + caption + "](" + name + ".png)\n\n*" + caption + "*\n";
}

std::filesystem::path
ReportFolder::finish () const
{
  const std::filesystem::path path = folder_ / "report.md";
  writeFile (path, text_.data (), text_.size ());
  return path;
}

} // namespace floater
} // namespace pcl
