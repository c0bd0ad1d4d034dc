// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Names, extensions and numbers in messages.
#pragma once

#include <boost/locale/utf.hpp>

#include <algorithm>
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
formatOf (const std::filesystem::path& path, const std::pair<const char*, Format> (&formats)[N])
{
  for (const auto& [name, format] : formats)
    if (lowerExtension (path) == "." + std::string (name))
      return format;
  return {};
}

/// What is wrong with the name of a file whose format is unknown.
inline std::string
unknownExtension (const std::filesystem::path& path)
{
  const std::string extension = lowerExtension (path);
  return extension.empty () ? "it has no extension that tells its format"
                            : "its extension '" + extension + "' is unknown";
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

/// A text for a terminal: what would control it, and what is no UTF-8, as \x1b.
inline std::string
printable (std::string_view text)
{
  constexpr unsigned DELETE = 0x7F, LAST_CONTROL = 0x9F;
  std::string shown;
  for (const char *at = text.data (), *const end = at + text.size (); at != end;) {
    const char* const first = at;
    const auto code = boost::locale::utf::utf_traits<char>::decode (at, end);
    const bool is_utf8 = boost::locale::utf::is_valid_codepoint (code);
    if (!is_utf8)
      at = first + 1;
    if (is_utf8 &&
        (code > LAST_CONTROL || (code >= ' ' && code < DELETE) || code == '\n' || code == '\t'))
      shown.append (first, at);
    else
      for (const unsigned char value :
           std::string_view (first, static_cast<std::size_t> (at - first)))
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
