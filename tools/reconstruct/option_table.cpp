// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_table.h"

#include "scratch_arrays.h"

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

/// Reads "1,-2.5,3".
/// \return nothing if these are not three finite numbers
std::optional<Eigen::Vector3d>
parsePlace (const std::string& word)
{
  std::vector<std::string> numbers;
  boost::split (numbers, word, boost::is_any_of (","));
  Eigen::Vector3d place;
  bool is_good = numbers.size () == 3;
  for (std::size_t axis = 0; axis < 3 && is_good; ++axis)
    is_good = parseNumber (numbers[axis], place[static_cast<Eigen::Index> (axis)]);
  return is_good && place.allFinite () ? std::optional (place) : std::nullopt;
}

// Adds options of the table.
struct TableOptions
{
  CLI::App& app;

  template <typename Number>
  void operator() (const OptionRow& row, Number& value, const NumberRange& range)
  {
    const bool is_plain = range.text () == NumberRange{0, NO_LIMIT}.text ();
    addNumber (app, nameOf (row), value, row.text + (is_plain ? "" : ", " + range.text ()));
  }
  template <typename Enum, std::size_t N>
  void operator() (const OptionRow& row, Enum& value, Choices<Enum, N>& choices)
  {
    addChoice (app, nameOf (row), value, choices, row.text);
  }
  void operator() (const OptionRow& row, bool& value) { (*this) (row, value, SWITCH_CHOICES); }
  void operator() (const OptionRow& row, HoleOptions& holes, LengthUnit unit)
  {
    const auto parse = [&holes, unit] (const std::string& word) {
      holes.unit = unit;
      return parseNumber (word, holes.largest_hole) ? "" : "is not a number";
    };
    addParsed (app, nameOf (row), parse, row.text, "X");
  }
  void operator() (const OptionRow& row, ViewOptions& view)
  {
    const auto parse = [&view] (const std::string& word) {
      const std::optional<Eigen::Vector3d> place = parsePlace (word);
      view.use = place ? ViewUse::GIVEN : word == "auto" ? ViewUse::AUTO : ViewUse::NEVER;
      Eigen::Map<Eigen::Vector3d> (view.viewpoint.data ()) =
          place.value_or (Eigen::Vector3d::Zero ());
      return place || word == "auto" || word == "none"
                 ? ""
                 : "is neither auto, none, nor three numbers, such as 0,0,1.5";
    };
    addParsed (app, nameOf (row), parse, row.text, "X,Y,Z, auto or none (auto)");
  }

  // "-k,--neighbors"
  static std::string nameOf (const OptionRow& row)
  {
    return (*row.letter == 0 ? "" : "-" + std::string (row.letter) + ",") + toolName (row.name);
  }
};

} // namespace

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

void
addTableOptions (CLI::App& app, CommandLine& line,
                 const std::function<bool (const OptionRow&)>& takes)
{
  visitOptions (line.options, [&] (const OptionRow& row, auto&&... value) {
    beginGroup (app, row.group);
    if (takes (row))
      TableOptions{app}(row, value...);
  });
  beginGroup (app, option_group::NEIGHBORHOODS);
  addChoice (
      app, "--use-input-normals", line.use_input_normals, SWITCH_CHOICES,
      "take the normals of the input for tangent planes, and, with --facing auto, for the front");
  app.get_option ("--largest-hole")->excludes (app.get_option ("--largest-hole-length"));
}

void
addLimitAndCoordinates (CLI::App& app, CommandLine& line)
{
  beginGroup (app, option_group::GENERAL);
  const auto parseLimit = [&line] (const std::string& word) -> std::string {
    if (!parseSize (word, line.max_memory))
      return "is not a size, such as 500M or 2G";
    return line.max_memory < leastMemory (0)
               ? "is too small; it must be " + formatSize (leastMemory (0)) + " or more"
               : "";
  };
  addParsed (app, "--max-memory", parseLimit,
             "keep the memory in use near this, in bytes; arrays that are not in use are kept on "
             "disk; not for discs",
             "SIZE (no limit)");
  addPath (app, "--scratch", line.scratch,
           "--max-memory: folder where the arrays are kept; these files have no names and end with "
           "the run",
           "FOLDER (that of OUTPUT)");
  const auto parseShift = [&line] (const std::string& word) {
    line.auto_shift = word == "auto";
    line.shift = parsePlace (word);
    return line.auto_shift || line.shift
               ? ""
               : "is neither auto nor three numbers, such as 500000,5500000,0";
  };
  addParsed (app, "--shift", parseShift,
             "origin to subtract from all coordinates, where they are too far from zero for 32 "
             "bits; auto: the rounded centre of the points, if they are so far",
             "X,Y,Z or auto (none)");
  const auto parseColumns = [&line] (const std::string& word) {
    const std::optional<Eigen::Vector3d> numbers = parsePlace (word);
    for (Eigen::Index axis = 0; numbers && axis < 3; ++axis)
      line.columns[static_cast<std::size_t> (axis)] =
          static_cast<std::size_t> (std::max (0.0, (*numbers)[axis]));
    const auto& [x, y, z] = line.columns;
    return !numbers || x == 0 || y == 0 || z == 0 || x == y || y == z || z == x
               ? "is no three different numbers of columns, such as 2,3,4"
               : "";
  };
  addParsed (app, "--columns", parseColumns,
             "columns of x, y and z in text with a point in each line, from 1; by default those "
             "that the first line names, or the first three",
             "X,Y,Z");
  const auto parseClasses = [&line] (const std::string& word) {
    std::stringstream words (word);
    for (std::string one; std::getline (words, one, ',');)
      if (!parseNumber (std::string_view (one), line.classes.emplace_back ()))
        return "are no numbers of classes, such as 2,6";
    return "";
  };
  addParsed (app, "--classes", parseClasses,
             "classes of an airborne scan that are taken, such as 2,6 for ground and buildings; by "
             "default all but those of noise, 7 and 18. Withheld points are never taken",
             "N,N,...");
  addChoice (app, "--precision", line.precision, PRECISION_CHOICES,
             "precision of coordinates in outputs; auto: single, with --shift auto for doubles. "
             "PCL reads doubles of a .ply as 0");
}

} // namespace pcl::floater
