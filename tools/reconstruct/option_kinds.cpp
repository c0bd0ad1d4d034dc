// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_kinds.h"

#include <algorithm>

namespace pcl::floater {
void
addPath (CLI::App& app, const std::string& name, std::filesystem::path& path,
         const std::string& description, const std::string& group, const char* kind)
{
  app.add_option_function<std::string> (
         name, [&path] (const std::string& word) { path = word; }, description)
      ->option_text (kind)
      ->group (group);
}

std::string
toolName (std::string name)
{
  std::replace (name.begin (), name.end (), '_', '-');
  return "--" + name;
}

void
wrapTexts (CLI::App& app)
{
  constexpr std::size_t COLUMNS = 55;
  for (CLI::Option* const option : app.get_options ()) {
    std::string text = option->get_description ();
    std::size_t begin = 0; // of the line
    for (std::size_t i = 0, space = 0; i < text.size (); ++i) {
      if (text[i] == '\n')
        begin = i + 1;
      else if (text[i] == ' ')
        space = i;
      // The words of a choice stay on one line, behind a colon.
      const bool is_choice = begin >= 2 && text[begin - 2] == ':';
      if (i - begin >= COLUMNS && space > begin && !is_choice) {
        text[space] = '\n';
        begin = space + 1;
      }
    }
    option->description (text);
  }
}

std::optional<Eigen::Vector3d>
parsePlace (const std::string& word)
{
  Eigen::Vector3d place;
  std::size_t first = 0;
  bool is_good = std::count (word.begin (), word.end (), ',') == 2;
  for (int axis = 0; axis < 3 && is_good; ++axis) {
    const std::size_t comma = std::min (word.find (',', first), word.size ());
    is_good = parseNumber (std::string_view (word).substr (first, comma - first), place[axis]);
    first = comma + 1;
  }
  return is_good && place.allFinite () ? std::optional (place) : std::nullopt;
}

} // namespace pcl::floater
