// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a command line, in words of the user.
#include "option_table.h"

#include <algorithm>

namespace pcl::floater {
namespace {
using Words = std::vector<std::string>;

std::string
plain (const std::string& word)
{
  std::string text = word.substr (std::min (word.find_first_not_of ('-'), word.size ()));
  std::transform (text.begin (), text.end (), text.begin (), lowerCase);
  return text;
}

/// Number of letters to insert, drop or replace, or of neighbours to swap, to make one word of the
/// other.
std::size_t
editDistance (const std::string& a, const std::string& b)
{
  // Distances between the first letters of a and of b.
  std::vector<std::vector<std::size_t>> table (a.size () + 1,
                                               std::vector<std::size_t> (b.size () + 1));
  for (std::size_t i = 0; i <= a.size (); ++i)
    for (std::size_t j = 0; j <= b.size (); ++j) {
      std::size_t& distance = table[i][j] = i + j;
      if (i == 0 || j == 0)
        continue;
      distance = std::min ({table[i - 1][j] + 1, table[i][j - 1] + 1,
                            table[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        distance = std::min (distance, table[i - 2][j - 2] + 1);
    }
  return table[a.size ()][b.size ()];
}

} // namespace

std::string
didYouMean (const std::string& word, const std::vector<std::string>& words)
{
  constexpr std::size_t LONGEST = 100; // letters; nobody mistypes more
  constexpr std::size_t FEWEST = 3;    // letters that tell what they begin
  constexpr std::size_t MOST = 4;      // more words are no help
  const std::string typed = plain (word);
  Words nearest;
  std::size_t least = LONGEST;
  for (const std::string& candidate : words) {
    const std::string known = plain (candidate);
    if (typed.empty () || typed.size () > LONGEST)
      break;
    std::size_t distance = editDistance (typed, known);
    if (distance > 0 && typed.size () >= FEWEST && known.compare (0, typed.size (), typed) == 0)
      distance = 1;
    if (3 * distance > std::max (typed.size (), known.size ()) || distance > least)
      continue;
    if (distance < least)
      nearest.clear ();
    least = distance;
    nearest.push_back (candidate);
  }
  if (nearest.empty () || nearest.size () > MOST)
    return "";
  std::string text = "; did you mean " + nearest.front ();
  for (std::size_t i = 1; i < nearest.size (); ++i)
    text += (i + 1 < nearest.size () ? ", " : " or ") + nearest[i];
  return text + "?";
}

namespace {
std::string
usageMessage (const CLI::App& app, const CLI::ParseError& error, const Words& arguments)
{
  const std::string message = error.what ();
  const auto kind = static_cast<CLI::ExitCodes> (error.get_exit_code ());
  // A mistyped option may leave its value where INPUT should be: so it is told first.
  for (const std::string& word : app.remaining ())
    if (word.size () > 1 && word.front () == '-' && word != "--") {
      const std::string unknown = word.substr (0, word.find ('='));
      Words names;
      for (const CLI::Option* const option : app.get_options ())
        if (!option->get_lnames ().empty ())
          names.push_back (option->get_name ());
      return "there is no option " + unknown + didYouMean (unknown, names);
    }
  if (kind == CLI::ExitCodes::ExtrasError)
    return "'" + app.remaining ().front () +
           "' is one file too many: there are one INPUT and one OUTPUT";
  if (kind == CLI::ExitCodes::RequiredError)
    return message + "; the simplest command is " + app.get_name () + " scan.pcd mesh.ply";
  const bool is_mismatch = kind == CLI::ExitCodes::ArgumentMismatch;
  if (is_mismatch ||
      kind == CLI::ExitCodes::ConversionError) // of which the parser converts flags only
    for (const std::string& argument : arguments) {
      const std::size_t equals = std::min (argument.find ('='), argument.size ());
      const std::string name = argument.substr (0, equals);
      const CLI::Option* const option = app.get_option_no_throw (name);
      if (option != nullptr && option->get_items_expected () == 0 && equals < argument.size ())
        return name + " takes no value, but has '" + argument.substr (equals + 1) + "'";
    }
  const CLI::Option* const option =
      app.get_option_no_throw (message.substr (0, message.find (':')));
  if (!is_mismatch || option == nullptr)
    return message;
  if (option->count () > 1)
    return option->get_name () + " is given " + std::to_string (option->count ()) +
           " times; give it once";
  const std::string& text = option->get_option_text ();
  return option->get_name () + " needs a value, " + text.substr (0, text.find (" ("));
}

/// Breaks the texts of all options into lines.
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

} // namespace

std::optional<int>
parseArguments (CLI::App& app, const std::vector<std::string>& arguments)
{
  wrapTexts (app);
  try {
    app.parse (std::vector<std::string> (arguments.rbegin (), arguments.rend ()));
    return std::nullopt;
  }
  catch (const CLI::ParseError& error) {
    if (error.get_exit_code () == static_cast<int> (CLI::ExitCodes::Success))
      return app.exit (error);
    throw UsageError (usageMessage (app, error, arguments));
  }
}

std::string
rangeMessage (const CLI::App& app, const Problem& problem)
{
  const std::string name = toolName (problem.option);
  return problem.option.empty () || app.get_option_no_throw (name) == nullptr
             ? problem.message
             : name + problem.message.substr (problem.option.size ());
}

} // namespace pcl::floater
