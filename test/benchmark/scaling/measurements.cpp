// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "measurements.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace pcl
{
namespace floater
{
namespace
{
using Row = std::map<std::string, std::string>;

constexpr const char* OK = "ok";
// Columns that are no figures.
const std::vector<std::string> LABELS{"surface", "cloud",   "points", "method",
                                      "repeat",  "outcome", "stages"};

std::vector<std::string>
split (const std::string& text, char separator)
{
  std::vector<std::string> parts;
  std::istringstream stream (text);
  for (std::string part; std::getline (stream, part, separator);)
    parts.push_back (part);
  return parts;
}

std::vector<Row>
readRows (const std::filesystem::path& path)
{
  std::ifstream file (path);
  std::string line;
  std::getline (file, line);
  const std::vector<std::string> columns = split (line, ',');
  std::vector<Row> rows;
  while (std::getline (file, line)) {
    const std::vector<std::string> cells = split (line, ',');
    Row row;
    for (std::size_t i = 0; i < columns.size (); ++i)
      row[columns[i]] = i < cells.size () ? cells[i] : "";
    rows.push_back (std::move (row));
  }
  for (const std::string& label : LABELS)
    if (std::find (columns.begin (), columns.end (), label) == columns.end ())
      throw std::runtime_error ("'" + path.string () + "' has no column " + label);
  if (rows.empty ())
    throw std::runtime_error ("'" + path.string () + "' has no runs");
  return rows;
}

Figures
figuresOf (const Row& row)
{
  Figures figures;
  for (const auto& [name, text] : row)
    if (!text.empty () && std::find (LABELS.begin (), LABELS.end (), name) == LABELS.end ())
      figures.set (name, std::stod (text));
  return figures;
}

// "neighbors=0.012;stars=0.034"
Figures
stagesOf (const Row& row)
{
  Figures stages;
  for (const std::string& stage : split (row.at ("stages"), ';')) {
    const std::size_t sign = stage.find ('=');
    stages.set (stage.substr (0, sign), std::stod (stage.substr (sign + 1)));
  }
  return stages;
}

double
median (std::vector<double> values)
{
  std::sort (values.begin (), values.end ());
  const std::size_t half = values.size () / 2;
  return values.size () % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
}

Figures
medians (const std::vector<Figures>& runs)
{
  Figures result;
  if (runs.empty ())
    return result;
  for (const std::string& name : runs.front ().names) {
    std::vector<double> values (runs.size ());
    std::transform (runs.begin (), runs.end (), values.begin (),
                    [&name] (const Figures& run) { return run[name]; });
    result.set (name, median (std::move (values)));
  }
  return result;
}

Measurement
join (const std::vector<Row>& rows)
{
  const Row& first = rows.front ();
  Measurement result;
  result.surface = first.at ("surface");
  result.cloud = first.at ("cloud");
  result.method = first.at ("method");
  result.points = std::stod (first.at ("points"));
  result.outcome = OK;
  std::vector<Figures> figures, stages;
  for (const Row& row : rows) {
    if (row.at ("outcome") == OK) {
      figures.push_back (figuresOf (row));
      stages.push_back (stagesOf (row));
    }
    else if (result.outcome == OK)
      result.outcome = row.at ("outcome");
  }
  result.figures = medians (figures);
  result.stages = medians (stages);
  result.runs = figures.size ();
  return result;
}

} // namespace

double
Figures::operator[] (const std::string& name) const
{
  const auto found = std::find (names.begin (), names.end (), name);
  return found == names.end () ? 0.0 : values[static_cast<std::size_t> (found - names.begin ())];
}

void
Figures::set (const std::string& name, double value)
{
  names.push_back (name);
  values.push_back (value);
}

std::vector<Measurement>
readMeasurements (const std::filesystem::path& path)
{
  std::vector<std::vector<Row>> groups;
  std::map<std::string, std::size_t> group_of; // by surface, cloud, points and method
  for (Row& row : readRows (path)) {
    const std::string key =
        row["surface"] + "," + row["cloud"] + "," + row["points"] + "," + row["method"];
    const auto [at, is_new] = group_of.emplace (key, groups.size ());
    if (is_new)
      groups.emplace_back ();
    groups[at->second].push_back (std::move (row));
  }
  std::vector<Measurement> result;
  try {
    std::transform (groups.begin (), groups.end (), std::back_inserter (result), join);
  }
  catch (const std::logic_error&) { // of std::stod
    throw std::runtime_error ("'" + path.string () +
                              "' has something else where a number should "
                              "be");
  }
  return result;
}

std::vector<std::string>
namesOf (const std::vector<Measurement>& measurements, std::string Measurement::*name)
{
  std::vector<std::string> names;
  for (const Measurement& one : measurements)
    if (std::find (names.begin (), names.end (), one.*name) == names.end ())
      names.push_back (one.*name);
  return names;
}

std::vector<Measurement>
select (const std::vector<Measurement>& measurements, std::string Measurement::*name,
        const std::string& value)
{
  std::vector<Measurement> result;
  std::copy_if (measurements.begin (), measurements.end (), std::back_inserter (result),
                [&] (const Measurement& one) { return one.*name == value; });
  return result;
}

GrowthSeries
seriesOf (const std::string& name, const std::vector<Measurement>& measurements,
          const std::function<double (const Measurement&)>& value)
{
  GrowthSeries series;
  series.name = name;
  for (const Measurement& one : measurements) {
    if (one.outcome != OK)
      continue;
    series.points.push_back (one.points);
    series.values.push_back (value (one));
  }
  return series;
}

} // namespace floater
} // namespace pcl
