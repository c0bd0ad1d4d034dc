// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a command line, in words of the user.
#include "option_table.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <utility>

namespace pcl::floater {
namespace {
using Words = std::vector<std::string>;

/// A word in lower case and without dashes before it.
std::string
plain (const std::string& word)
{
  std::string text = word.substr (std::min (word.find_first_not_of ('-'), word.size ()));
  std::transform (text.begin (), text.end (), text.begin (),
                  [] (unsigned char c) { return std::tolower (c); });
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

/// "-k" and "--neighbors".
Words
namesOf (const CLI::Option& option)
{
  Words names;
  for (const std::string& name : option.get_snames ())
    names.push_back ("-" + name);
  for (const std::string& name : option.get_lnames ())
    names.push_back ("--" + name);
  return names;
}

/// An option as it was typed: "-k", "-k20", "--neighbors=20".
struct Typed
{
  const CLI::Option* option;
  std::string name, value; // what is behind =
};

std::vector<Typed>
typedOptions (const CLI::App& app, const Words& arguments)
{
  std::vector<Typed> typed;
  for (const std::string& argument : arguments)
    for (const CLI::Option* const option : app.get_options ())
      for (const std::string& name : namesOf (*option)) {
        const std::size_t size = name.size ();
        const bool begins = argument.compare (0, size, name) == 0;
        if (begins && (argument.size () == size || argument[size] == '='))
          typed.push_back ({option, name, argument.substr (std::min (size + 1, argument.size ()))});
        else if (begins && size == 2) // one letter
          typed.push_back ({option, name, ""});
      }
  return typed;
}

/// The name by which an option was typed last, and how often it was.
std::pair<std::string, std::size_t>
nameAndTimes (const CLI::Option& option, const std::vector<Typed>& typed)
{
  std::pair<std::string, std::size_t> result (option.get_name (), 0);
  for (const Typed& one : typed)
    if (one.option == &option)
      result = {one.name, result.second + 1};
  return result;
}

/// The option that a message begins with, by any of its names or all of them.
const CLI::Option*
optionOf (const CLI::App& app, const std::string& message)
{
  const auto begins = [&message] (const std::string& name) {
    return !name.empty () && message.compare (0, name.size (), name) == 0 &&
           (message.size () == name.size () || message[name.size ()] == ':' ||
            message[name.size ()] == ' ');
  };
  for (const CLI::Option* const option : app.get_options ()) {
    const Words names = namesOf (*option);
    if (begins (option->get_name (false, true)) ||
        std::any_of (names.begin (), names.end (), begins))
      return option;
  }
  return nullptr;
}

/// An argument that looks like an option and is none; empty if there is none such.
std::string
unknownOption (const CLI::App& app)
{
  for (const std::string& word : app.remaining ())
    if (word.size () > 1 && word.front () == '-' && word != "--")
      return word.substr (0, word.find ('='));
  return "";
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
/// The message for a command line that could not be parsed. Options are named as they were typed.
std::string
usageMessage (const CLI::App& app, const CLI::ParseError& error, const Words& arguments)
{
  const std::string message = error.what ();
  const auto kind = static_cast<CLI::ExitCodes> (error.get_exit_code ());
  // A mistyped option may leave its value where INPUT should be: so it is told first.
  if (const std::string unknown = unknownOption (app); !unknown.empty ()) {
    Words names;
    for (const CLI::Option* const option : app.get_options ())
      for (std::string& name : namesOf (*option))
        names.push_back (std::move (name));
    return "there is no option " + unknown + didYouMean (unknown, names);
  }
  if (kind == CLI::ExitCodes::ExtrasError)
    return "'" + app.remaining ().front () +
           "' is one file too many: there are one INPUT and one OUTPUT";
  if (kind == CLI::ExitCodes::RequiredError)
    return message + "; the simplest command is " + app.get_name () + " scan.pcd mesh.ply";
  if (kind == CLI::ExitCodes::ExcludesError)
    return message;
  const std::vector<Typed> typed = typedOptions (app, arguments);
  const bool is_mismatch = kind == CLI::ExitCodes::ArgumentMismatch;
  if (is_mismatch ||
      kind == CLI::ExitCodes::ConversionError) // of which the parser converts flags only
    for (const Typed& one : typed)
      if (one.option->get_items_expected () == 0 && !one.value.empty ())
        return one.name + " takes no value, but has '" + one.value + "'";
  const CLI::Option* const option = optionOf (app, message);
  if (option == nullptr)
    return message;
  const auto [name, times] = nameAndTimes (*option, typed);
  if (!is_mismatch)
    return name + message.substr (std::min (message.find (": "), message.size ()));
  if (times > 1)
    return name + " is given " + std::to_string (times) + " times; give it once";
  const std::string& text = option->get_option_text ();
  return name + " needs a value, " + text.substr (0, text.find (" ("));
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
rangeMessage (const CLI::App& app, const Problem& problem, const Words& arguments)
{
  const std::string name = toolName (problem.option);
  if (problem.option.empty () || app.get_option_no_throw (name) == nullptr)
    return problem.message;
  return nameAndTimes (*app.get_option (name), typedOptions (app, arguments)).first +
         problem.message.substr (problem.option.size ());
}

} // namespace pcl::floater
