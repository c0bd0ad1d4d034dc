// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Names, extensions and numbers in messages.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace pcl::floater {
/// A letter of ASCII in lower case.
inline char
lowerCase (char c)
{
  return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c;
}

/// Extension of a file in lower case, with its dot.
inline std::string
lowerExtension (const std::filesystem::path& path)
{
  std::string extension = path.extension ().string ();
  std::transform (extension.begin (), extension.end (), extension.begin (), lowerCase);
  return extension;
}

/// The value of the row that has the extension of a file as its name; a default one if none has.
template <typename Format, std::size_t N>
Format
formatOf (const std::filesystem::path& path,
          const std::array<std::pair<const char*, Format>, N>& formats)
{
  for (const auto& [name, format] : formats)
    if (lowerExtension (path) == "." + std::string (name))
      return format;
  return {};
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

/// Bytes of the UTF-8 character that a text begins with; 0: of none.
inline std::size_t
characterBytes (std::string_view text)
{
  const auto byte = [text] (std::size_t i) -> unsigned {
    return i < text.size () ? static_cast<unsigned char> (text[i]) : 0U;
  };
  const unsigned first = byte (0);
  const std::size_t count = first < 0x80   ? 1
                            : first < 0xC2 ? 0
                            : first < 0xE0 ? 2
                            : first < 0xF0 ? 3
                            : first < 0xF5 ? 4
                                           : 0;
  for (std::size_t i = 1; i < count; ++i)
    if ((byte (i) & 0xC0U) != 0x80)
      return 0;
  return count;
}

inline bool
isUtf8 (std::string_view text)
{
  while (!text.empty ()) {
    const std::size_t bytes = characterBytes (text);
    if (bytes == 0)
      return false;
    text.remove_prefix (bytes);
  }
  return true;
}

/// A text for a terminal: what would control it, and what is no UTF-8, as \x1b.
inline std::string
printable (std::string_view text)
{
  std::string shown;
  while (!text.empty ()) {
    const std::size_t bytes = characterBytes (text);
    const auto first = static_cast<unsigned char> (text[0]);
    const bool is_control = bytes == 1
                                ? (first < ' ' && first != '\n' && first != '\t') || first == 0x7F
                                : first == 0xC2 && static_cast<unsigned char> (text[1]) < 0xA0;
    for (std::size_t i = 0; i < std::max<std::size_t> (bytes, 1); ++i)
      if (bytes == 0 || is_control) {
        const auto value = static_cast<unsigned char> (text[i]);
        shown += {'\\', 'x', "0123456789abcdef"[value >> 4U], "0123456789abcdef"[value & 15U]};
      }
      else
        shown += text[i];
    text.remove_prefix (std::max<std::size_t> (bytes, 1));
  }
  return shown;
}

/// "1 point", "2 points".
inline std::string
counted (std::size_t count, const std::string& noun)
{
  return std::to_string (count) + " " + noun + (count == 1 ? "" : "s");
}

} // namespace pcl::floater
