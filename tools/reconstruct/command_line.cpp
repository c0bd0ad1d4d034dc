// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"

#include "option_table.h"
#include "scratch_arrays.h"

#include <cstdio>
#include <new>

namespace pcl::floater {
namespace {
using Words = std::vector<std::string>;

std::string
plain (const std::string& word)
{
  return boost::to_lower_copy (boost::trim_left_copy_if (word, boost::is_any_of ("-")));
}

/// Letters of the longer word that are left when equal beginnings and ends are taken off both: one
/// if a letter was inserted, dropped or replaced, two if neighbours were swapped.
std::size_t
difference (std::string_view a, std::string_view b)
{
  const auto common = [] (auto first, auto last, auto other, auto other_last) {
    return static_cast<std::size_t> (std::mismatch (first, last, other, other_last).first - first);
  };
  const std::size_t begin = common (a.begin (), a.end (), b.begin (), b.end ());
  a.remove_prefix (begin);
  b.remove_prefix (begin);
  return std::max (a.size (), b.size ()) - common (a.rbegin (), a.rend (), b.rbegin (), b.rend ());
}

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

void
checkTextureOptions (const CommandLine& line)
{
  const MeshFormat format = line.meshFormat ();
  if (line.texture_coordinates && (format == writeStl || format == writeOff || format == writeGlb))
    throw UsageError ("STL, OFF and GLB are written without texture coordinates; write .vtk, .ply "
                      "or .obj, or leave --uv and --texture out");
  if (line.texture_coordinates && format == writeObj && isStandardStream (line.output))
    throw UsageError ("the file of materials beside an OBJ file has no place on the standard "
                      "output; write .ply or .vtk there, or leave --uv and --texture out");
  if (!line.texture.empty () && lowerExtension (line.texture) != ".png")
    throw UsageError ("--texture: '" + line.texture.string () +
                      "' is no PNG file; give a name that ends with .png");
  if (line.texture_size != 0 && line.texture.empty ())
    throw UsageError ("--texture-size is of no use without --texture");
  if (line.texture_coordinates && line.max_memory > 0)
    throw UsageError (
        "--max-memory cannot limit the memory of --uv and --texture; leave one of them out");
}

void
checkMemoryLimit (CommandLine& line)
{
  if (line.max_memory == 0) {
    if (!line.scratch.empty ())
      throw UsageError ("--scratch is of no use without --max-memory");
    return;
  }
  // The solver allocates the factors of the linear system itself, and they are the larger part.
  if (line.options.topology == Topology::DISC)
    throw UsageError (
        "--max-memory cannot limit the memory for the linear system of a disc; use it with "
        "--topology surface or auto, and without --loop and --parameterization");
  if (!line.html.empty ())
    throw UsageError ("--max-memory cannot limit the memory of --html; leave one of them out");
  if (line.scratch.empty ())
    line.scratch = line.output.has_parent_path () ? line.output.parent_path () : ".";
}

// Takes the options of TW 385. Warns of those that were given, and that it sets otherwise.
void
takePublished (const CLI::App& app, CommandLine& line)
{
  choosePublished (line.options.disc, app.count ("--boundary") > 0, app.count ("--ordering") > 0);
  const OptionValues given (line.options);
  line.options = effectiveOptions (line.options); // the report lists these
  const OptionValues effective (line.options);
  Words names;
  for (std::size_t i = 0; i < given.rows.size (); ++i)
    if (const std::string name = toolName (given.rows[i].name);
        given.values[i] != effective.values[i] && app.count (name) > 0)
      names.push_back (name);
  if (!names.empty ())
    line.warnings.push_back (
        (names.size () == 1 ? "an option has no effect: " : "options have no effect: ") +
        boost::join (names, ", ") + "; --method tw385 is that report and nothing else");
}

bool
areSame (const std::filesystem::path& a, const std::filesystem::path& b)
{
  std::error_code error;
  if (std::filesystem::equivalent (a, b, error) && !error)
    return true;
  // weakly_canonical would leave a relative path as it is if no part of it exists.
  const auto full = [&error] (const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical (std::filesystem::absolute (path), error);
  };
  return full (a) == full (b);
}

void
checkPaths (const CommandLine& line)
{
  if (line.input_format == nullptr && isStandardStream (line.input))
    throw UsageError ("INPUT is the standard input: give its format by --input-format, such as "
                      "--input-format pcd");
  if (line.input_format == nullptr)
    readNamed (line.input, [&line] {
      return requireCloudFormat (line.input, ", or give its format by --input-format");
    });
  // The first two are inputs.
  const std::array<std::pair<std::string, std::filesystem::path>, 8> all{
      {{"INPUT", line.input},
       {"--loop", line.loop},
       {"OUTPUT", line.output},
       {"--parameterization", line.parameterization},
       {"--report", line.report},
       {"--html", line.html},
       {"the file of materials", line.materials ()},
       {"--texture", line.texture}}};
  for (const auto& [name, path] : all)
    if (name.front () == '-' && isStandardStream (path))
      throw UsageError (name + " takes the name of a file, not -");
  for (const auto& [name, path] : {all[6], all[7]})
    if (path.filename ().string ().find_first_of ("\n\r") != std::string::npos)
      throw UsageError ("the name of the file of materials or of the texture has a line break in "
                        "it, which files in OBJ cannot hold; choose another one");
  for (std::size_t i = 2; i < all.size (); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto& [name, path] = all[i];
      const auto& [other_name, other] = all[j];
      if (!path.empty () && !other.empty () && !isStandardStream (path) &&
          !isStandardStream (other) && areSame (path, other))
        throw UsageError (other_name + " and " + name + " are the same file, '" + path.string () +
                          "'; give different ones");
    }
  if (line.meshFormat () == nullptr && isStandardStream (line.output))
    throw UsageError ("OUTPUT is the standard output: give its format by --output-format, such as "
                      "--output-format ply");
  if (line.meshFormat () == nullptr)
    throw WriteError ("cannot write '" + line.output.string () +
                      "': " + unknownExtension (line.output) + "; use " + MESH_EXTENSIONS +
                      ", or give its format by --output-format");
  if (!line.parameterization.empty () && meshFormatOf (line.parameterization) == nullptr)
    throw WriteError ("cannot write '" + line.parameterization.string () + "': " +
                      unknownExtension (line.parameterization) + "; use " + MESH_EXTENSIONS);
  for (std::size_t i = 2; i < all.size (); ++i)
    if (!all[i].second.empty ())
      requireWritable (all[i].second);
}

} // namespace

int
guarded (const char* program, const char* if_no_memory, const std::function<int ()>& work)
{
  int code = EXIT_INTERNAL;
  std::string message;
  try {
    return work ();
  }
  catch (const ToolError& error) {
    code = error.code;
    message = std::string (error.what ()) + (code == EXIT_USAGE ? "\nTry --help." : "");
  }
  catch (const std::bad_alloc&) {
    message = scratchFailure ();
    if (message.empty ())
      message = std::string ("not enough memory; ") + if_no_memory;
  }
  catch (const std::exception& error) {
    message = std::string ("unexpected error: ") + error.what ();
  }
  std::fprintf (stderr, "%s: %s\n", program, printable (message).c_str ());
  return code;
}

std::string
didYouMean (const std::string& word, const std::vector<std::string>& words)
{
  constexpr std::size_t FEWEST = 3; // letters that tell what they begin
  constexpr std::size_t MOST = 4;   // more words are no help
  const std::string typed = plain (word);
  Words nearest;
  std::size_t least = typed.size ();
  for (const std::string& candidate : words) {
    const std::string known = plain (candidate);
    std::size_t distance = difference (typed, known);
    if (distance > 0 && typed.size () >= FEWEST && known.compare (0, typed.size (), typed) == 0)
      distance = 1;
    if (2 * distance > std::min (typed.size (), known.size ()) || distance > least)
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

std::optional<int>
parseCommandLine (int argc, char** argv, CommandLine& line)
{
  CLI::App app ("", line.program);
  const std::vector<std::string> arguments (argv + (argc > 0 ? 1 : 0), argv + argc);
  addOptions (app, line);
  if (const std::optional<int> done = parseArguments (app, arguments))
    return done;
  if (line.compute_normals && line.meshFormat () == writeStl)
    line.warnings.emplace_back ("an option has no effect: --normals; STL has normals of "
                                "triangles only, write .ply, .vtk or .obj");
  if (line.options.disc.as_published)
    takePublished (app, line);
  if (line.input.empty () || line.output.empty ())
    throw UsageError ("INPUT and OUTPUT are names of files; one of them is empty");
  const bool needs_disc = !line.loop.empty () || !line.parameterization.empty ();
  Topology& topology = line.options.topology;
  if (needs_disc && topology == Topology::SURFACE)
    throw UsageError ("--loop and --parameterization are for a disc, not for --topology surface");
  if (needs_disc)
    topology = Topology::DISC;
  requireOptions (app, line.options);
  line.texture_coordinates |= !line.texture.empty ();
  checkTextureOptions (line);
  checkMemoryLimit (line);
  checkPaths (line);
  return std::nullopt;
}

} // namespace pcl::floater
