// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Names, extensions and numbers in messages.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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
  constexpr std::array<unsigned, 5> FROM{0x80, 0xC2, 0xE0, 0xF0, 0xF5}; // first bytes
  constexpr std::array<std::size_t, 6> COUNTS{1, 0, 2, 3, 4, 0};
  const auto* const range = std::upper_bound (FROM.begin (), FROM.end (), first);
  const std::size_t count = COUNTS[static_cast<std::size_t> (range - FROM.begin ())];
  for (std::size_t i = 1; i < count; ++i)
    if ((byte (i) & 0xC0U) != 0x80)
      return 0;
  return count;
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
    const std::string_view character = text.substr (0, std::max<std::size_t> (bytes, 1));
    text.remove_prefix (character.size ());
    if (bytes > 0 && !is_control)
      shown += character;
    else
      for (const unsigned char value : character)
        shown += {'\\', 'x', "0123456789abcdef"[value >> 4U], "0123456789abcdef"[value & 15U]};
  }
  return shown;
}

/// "1 point", "2 points".
inline std::string
counted (std::size_t count, const std::string& noun)
{
  return std::to_string (count) + " " + noun + (count == 1 ? "" : "s");
}

/// The time that a run still takes, "34 %, 12 s left", if it goes on as it began; empty at the
/// beginning, when that says little, and of runs that end soon.
inline std::string
remainingTime (double seconds, double fraction)
{
  constexpr double FIRST = 1.5, LEAST = 0.02; // seconds, fraction of the run
  if (seconds < FIRST || fraction < LEAST)
    return "";
  constexpr double PERCENT = 100.0, MINUTE = 60.0, LONG = 100.0;
  const auto whole = [] (double number) { return std::to_string (std::lround (number)); };
  const double left = seconds / fraction - seconds;
  return whole (std::floor (PERCENT * fraction)) + " %, " +
         (left < LONG ? whole (std::ceil (left)) + " s" : whole (left / MINUTE) + " min") + " left";
}

} // namespace pcl::floater
