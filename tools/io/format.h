// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Names, extensions and numbers in messages.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace pcl::floater {
/// Extension of a file in lower case, with its dot.
inline std::string
lowerExtension (const std::filesystem::path& path)
{
  std::string extension = path.extension ().string ();
  std::transform (extension.begin (), extension.end (), extension.begin (), [] (char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c;
  });
  return extension;
}

/// Whether "-" stands in place of a file: for the standard input, or the standard output.
inline bool
isStandardStream (const std::filesystem::path& path)
{
  return path == "-";
}

/// An input in messages: 'its name', or the standard input.
inline std::string
inputName (const std::filesystem::path& path)
{
  return isStandardStream (path) ? "the standard input" : "'" + path.string () + "'";
}

/// "1 point", "2 points".
inline std::string
counted (std::size_t count, const std::string& noun)
{
  return std::to_string (count) + " " + noun + (count == 1 ? "" : "s");
}

} // namespace pcl::floater
