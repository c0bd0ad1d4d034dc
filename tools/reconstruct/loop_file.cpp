// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "loop_file.h"

#include "text_scanner.h"

#include <algorithm>

namespace pcl::floater {
std::vector<std::uint32_t>
readLoop (const std::filesystem::path& path)
{
  std::string text (FileBytes (path).view ());
  std::replace (text.begin (), text.end (), ',', ' ');
  std::vector<std::uint32_t> loop;
  TextScanner scanner (text);
  while (scanner.nextLine ())
    for (std::string_view word = scanner.word (); !word.empty () && word.front () != '#';
         word = scanner.word ())
      if (!parseNumber (word, loop.emplace_back ()))
        scanner.fail ("'" + std::string (word) + "' is not the index of a point");
  if (loop.empty ())
    throw ReadError ("it has no indices of points");
  return loop;
}

} // namespace pcl::floater
