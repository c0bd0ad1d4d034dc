// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "suggestion.h"

#include <algorithm>

namespace pcl::floater {
namespace {
char
lower (char c)
{
  return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c;
}

bool
begins (std::string_view word, std::string_view other)
{
  return word.size () <= other.size () &&
         std::equal (word.begin (), word.end (), other.begin (),
                     [] (char a, char b) { return lower (a) == lower (b); });
}

/// Options are compared without their dashes.
std::string_view
withoutDashes (std::string_view word)
{
  return word.substr (std::min (word.find_first_not_of ('-'), word.size ()));
}

} // namespace

std::size_t
editDistance (std::string_view a, std::string_view b)
{
  // Distances between the first letters of a and of b: rows i - 2, i - 1 and i of the table.
  std::vector<std::size_t> before (b.size () + 1), last (b.size () + 1), now (b.size () + 1);
  for (std::size_t j = 0; j <= b.size (); ++j)
    now[j] = j;
  for (std::size_t i = 1; i <= a.size (); ++i) {
    before.swap (last);
    last.swap (now);
    now[0] = i;
    for (std::size_t j = 1; j <= b.size (); ++j) {
      const bool is_same = lower (a[i - 1]) == lower (b[j - 1]);
      now[j] = std::min ({last[j] + 1, now[j - 1] + 1, last[j - 1] + (is_same ? 0 : 1)});
      if (i > 1 && j > 1 && lower (a[i - 1]) == lower (b[j - 2]) &&
          lower (a[i - 2]) == lower (b[j - 1]))
        now[j] = std::min (now[j], before[j - 2] + 1);
    }
  }
  return now[b.size ()];
}

std::vector<std::string>
nearestWords (std::string_view word, const std::vector<std::string>& words)
{
  constexpr std::size_t LONGEST = 100; // letters; nobody mistypes more
  constexpr std::size_t FEWEST = 3;    // letters that tell what they begin
  const std::string_view typed = withoutDashes (word);
  std::vector<std::string> nearest;
  if (typed.empty () || typed.size () > LONGEST)
    return nearest;
  std::size_t least = LONGEST;
  for (const std::string& candidate : words) {
    const std::string_view known = withoutDashes (candidate);
    std::size_t distance = editDistance (typed, known);
    if (distance > 0 && typed.size () >= FEWEST && begins (typed, known))
      distance = 1;
    if (3 * distance > std::max (typed.size (), known.size ()) || distance > least)
      continue;
    if (distance < least)
      nearest.clear ();
    least = distance;
    nearest.push_back (candidate);
  }
  return nearest;
}

std::string
didYouMean (std::string_view word, const std::vector<std::string>& words)
{
  constexpr std::size_t MOST = 4; // more of them are no help
  const std::vector<std::string> nearest = nearestWords (word, words);
  if (nearest.empty () || nearest.size () > MOST)
    return "";
  std::string text = "; did you mean " + nearest.front ();
  for (std::size_t i = 1; i < nearest.size (); ++i)
    text += (i + 1 < nearest.size () ? ", " : " or ") + nearest[i];
  return text + "?";
}

} // namespace pcl::floater
