// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options of the tools, in the groups of their help.
#pragma once

#include "command_line.h"
#include "options/check_options.h"
#include "text_scanner.h"

#include <CLI/CLI.hpp>
#include <boost/algorithm/string.hpp>

#include <sstream>

namespace pcl::floater {
/// "; did you mean a or b?" with the words that a mistyped one begins, or else those that differ
/// least from it, in at most half of the letters. Empty if there are none, or too many.
std::string
didYouMean (const std::string& word, const std::vector<std::string>& words);

// Options by the kind of their value, in the group that beginGroup () has named last. Each shows the
// default in the help, and refuses a malformed word by name.

/// The next options are below this heading of the help.
inline void
beginGroup (CLI::App& app, const std::string& group)
{
  app.option_defaults ()->group (group);
}

/// Takes the word of an option.
/// \return what is wrong with it, such as "is not a number"; empty if nothing is
using ParseWord = std::function<std::string (const std::string& word)>;

/// An option whose word `parse` takes.
/// \param kind of the value, and its default, for the help
inline CLI::Option*
addParsed (CLI::App& app, const std::string& name, const ParseWord& parse, const std::string& text,
           const std::string& kind)
{
  const auto take = [long_name = name.substr (name.find (',') + 1),
                     parse] (const std::string& word) {
    if (const std::string cause = parse (word); !cause.empty ())
      throw CLI::ValidationError (long_name, "'" + word + "' " + cause);
  };
  return app.add_option_function<std::string> (name, take, text)->option_text (kind);
}

/// An option whose value is one of several words.
template <typename Enum, std::size_t N>
CLI::Option*
addChoice (CLI::App& app, const std::string& name, Enum& value, Choices<Enum, N>& choices,
           const std::string& description)
{
  std::vector<std::string> known;
  known.reserve (N);
  for (const auto& choice : choices)
    known.emplace_back (choice.first);
  const std::string words = boost::join (known, ", ");
  const auto choose = [&value, choices, words, known] (const std::string& word) -> std::string {
    for (const auto& choice : choices)
      if (word == choice.first) {
        value = choice.second;
        return "";
      }
    return "is none of: " + words + didYouMean (word, known);
  };
  return addParsed (app, name, choose, description + ":\n" + words,
                    std::string ("NAME (") + choiceName (choices, value) + ")");
}

/// An option whose value is a number. All of the word has to be one.
template <typename Number>
CLI::Option*
addNumber (CLI::App& app, const std::string& name, Number& value, const std::string& description)
{
  const auto parse = [&value] (const std::string& word) {
    return parseNumber (word, value)    ? ""
           : std::is_integral_v<Number> ? "is not a whole number"
                                        : "is not a number";
  };
  std::ostringstream text;
  text << (std::is_integral_v<Number> ? "N (" : "X (") << value << ")";
  return addParsed (app, name, parse, description, text.str ());
}

/// An option whose value is the path of a file or a folder.
inline CLI::Option*
addPath (CLI::App& app, const std::string& name, std::filesystem::path& path,
         const std::string& description, const char* kind = "FILE")
{
  const auto take = [&path] (const std::string& word) { path = word; };
  return app.add_option_function<std::string> (name, take, description)->option_text (kind);
}

/// The name that the tools have for an option of the table: "--kept-loops" of "kept_loops".
inline std::string
toolName (std::string name)
{
  std::replace (name.begin (), name.end (), '_', '-');
  return "--" + name;
}

/// Sets the texts around the options of a tool, and adds --help and --version.
inline void
prepareApp (CLI::App& app, const char* description, const char* footer)
{
  constexpr std::size_t NAME_COLUMN = 34;
  app.description (description);
  app.get_formatter ()->column_width (NAME_COLUMN);
  app.get_formatter ()->label ("Positionals", "Arguments");
  app.footer (footer);
  beginGroup (app, option_group::GENERAL);
  app.set_help_flag ("-h,--help", "print this and exit");
  app.set_version_flag ("--version", app.get_name () + " " PCL_FLOATER_VERSION,
                        "print the version and exit");
}

/// Parses a command line. Prints the help, with texts broken into lines, or the version if asked for.
/// \return the exit code if there is nothing else to do
/// \throws UsageError
std::optional<int>
parseArguments (CLI::App& app, const std::vector<std::string>& arguments);

/// \throws UsageError if an option is out of its range, and so on, see checkOptions ()
inline void
requireOptions (const CLI::App& app, const Options& options)
{
  const Problem problem = checkOptions (options);
  const std::string name = toolName (problem.option);
  if (problem)
    throw UsageError (problem.option.empty () || app.get_option_no_throw (name) == nullptr
                          ? problem.message
                          : name + problem.message.substr (problem.option.size ()));
}

/// The rows of the table of options that the tool takes, and --use-input-normals.
void
addTableOptions (CLI::App& app, CommandLine& line,
                 const std::function<bool (const OptionRow&)>& takes);

inline void
addOutputs (CLI::App& app, CommandLine& line)
{
  beginGroup (app, "More output");
  app.add_flag (
      "--normals", line.compute_normals,
      "give the vertices normals, made from the triangles; those of the input are replaced");
  addPath (app, "--report", line.report, "write a report on the run as JSON");
}

/// The memory limit, and how the coordinates are read and written.
void
addLimitAndCoordinates (CLI::App& app, CommandLine& line);

} // namespace pcl::floater
