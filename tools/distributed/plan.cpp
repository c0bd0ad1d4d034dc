// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan.h"

#include "cloud.h"
#include "cloud_reader.h"
#include "format.h"
#include "prepared_input.h"
#include "run_report.h"
#include "store.h"

#include <nlohmann/json.hpp>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* FORMAT = "pcl_floater work folder";

std::uint64_t
hash (const std::string& text)
{
  return XXH3_64bits (text.data (), text.size ());
}

// Calls visit (key, member) for what the manifest has as it is, in its order.
template <typename Of, typename Visit>
void
forMembers (Of& plan, const Visit& visit)
{
  visit ("arguments", plan.arguments);
  visit ("parameters", plan.parameters);
  visit ("points", plan.points);
  visit ("blocks", plan.blocks);
  visit ("cloud_points", plan.cloud_size);
  visit ("selected_points", plan.selected_points);
  visit ("lattice_width", plan.lattice_width);
  visit ("centre", plan.centre);
  visit ("scale", plan.scale);
  visit ("sensor_origin", plan.sensor_origin);
  visit ("shift", plan.shift);
  visit ("fields", plan.fields);
  visit ("warnings", plan.warnings);
  visit ("notes", plan.notes);
  visit ("finite_points", plan.finite_points);
  visit ("is_single", plan.is_single);
}

// All but the id and the checksum.
Json
contents (const Plan& plan)
{
  Json inputs = Json::array ();
  for (const InputFile& input : plan.inputs)
    inputs.push_back (
        {{"file", input.path.string ()}, {"bytes", input.size}, {"checksum", input.checksum}});
  Json json{{"format", FORMAT}, {"version", WORK_FORMAT}, {"inputs", inputs}};
  forMembers (plan, [&json] (const char* key, const auto& value) { json[key] = value; });
  return json;
}

} // namespace

InputFile
describeInput (const std::filesystem::path& path)
{
  InputFile input;
  input.path = path;
  constexpr std::size_t AT_ONCE = std::size_t{1} << 20U;
  std::ifstream file (path, std::ios::binary);
  if (!file || std::filesystem::is_directory (path))
    throw ReadError ("cannot read " + inputName (path) + ": " +
                     (file ? "it is a folder" : std::strerror (errno)));
  std::vector<char> bytes (AT_ONCE);
  while (file) {
    file.read (bytes.data (), static_cast<std::streamsize> (bytes.size ()));
    const auto count = static_cast<std::size_t> (file.gcount ());
    input.size += count;
    input.checksum = XXH3_64bits_withSeed (bytes.data (), count, input.checksum);
  }
  if (!file.eof ())
    throw ReadError ("cannot read " + inputName (path) + ": " + std::strerror (errno));
  return input;
}

std::uint64_t
planId (const std::vector<InputFile>& inputs, const std::string& parameters, std::size_t blocks,
        const std::vector<std::string>& arguments)
{
  std::string text = std::to_string (WORK_FORMAT) + "\n" + parameters + "\n";
  for (const InputFile& input : inputs)
    text += std::to_string (input.size) + " " + std::to_string (input.checksum) + "\n";
  for (const std::string& argument : arguments)
    text += std::to_string (argument.size ()) + " " + argument + "\n";
  return hash (text + std::to_string (blocks));
}

std::string
manifestText (const Plan& plan)
{
  Json json = contents (plan);
  json["checksum"] = hash (dump (json));
  json["id"] = plan.id;
  return json.dump (2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Plan
parseManifest (const std::string& text, const std::string& name)
{
  const auto refuse = [&name] (const std::string& cause) {
    throw WorkError ("'" + name + "' " + cause);
  };
  try {
    Json json = Json::parse (text);
    if (json.at ("format") != FORMAT)
      refuse ("is no manifest of this program; name another work folder");
    if (json.at ("version") != WORK_FORMAT)
      refuse ("has the format version " + json.at ("version").dump () + ", and this program " +
              std::to_string (WORK_FORMAT) +
              "; use the version that made it, or an empty work folder");
    Plan plan;
    plan.id = json.at ("id").get<std::uint64_t> ();
    for (const Json& input : json.at ("inputs"))
      plan.inputs.push_back ({input.at ("file").get<std::string> (),
                              input.at ("bytes").get<std::uint64_t> (),
                              input.at ("checksum").get<std::uint64_t> ()});
    forMembers (plan, [&json] (const char* key, auto& value) { json.at (key).get_to (value); });
    if (json.at ("checksum") != hash (dump (contents (plan))))
      refuse ("is damaged; delete it and run again");
    return plan;
  }
  catch (const Json::exception&) {
    refuse ("is damaged; delete it and run again");
  }
  return {};
}

namespace {
// A field of the merged cloud, and that of each file.
struct Column
{
  Field merged;
  std::vector<const Field*> parts;
  bool is_coordinate = false; // a double, as it is meant and not as it is in the files
};

Column
coordinateColumn (const std::vector<Cloud>& clouds, std::size_t axis)
{
  constexpr std::array<const char*, 3> NAMES{"x", "y", "z"};
  Column column;
  for (const Cloud& cloud : clouds)
    column.parts.push_back (&cloud.coordinates[axis]);
  column.merged.name = NAMES[axis];
  column.merged.type = ScalarType::FLOAT64;
  column.is_coordinate = true;
  return column;
}

// Nothing if it is not in all files.
std::optional<Column>
fieldColumn (const std::vector<Cloud>& clouds, const Field& first)
{
  Column column;
  for (const Cloud& cloud : clouds) {
    const Field* field = cloud.find (first.name);
    if (field == nullptr || field->type != first.type || field->count != first.count)
      return {};
    column.parts.push_back (field);
  }
  column.merged.name = first.name;
  column.merged.type = first.type;
  column.merged.count = first.count;
  return column;
}

void
copyColumn (const Column& column, const std::vector<Cloud>& clouds, char* to)
{
  for (std::size_t c = 0; c < clouds.size (); ++c) {
    const Field& from = *column.parts[c];
    for (std::size_t row = 0; row < clouds[c].rows; ++row, to += column.merged.stride) {
      if (column.is_coordinate) {
        const double number = from.scaled (row);
        std::memcpy (to, &number, sizeof (number));
        continue;
      }
      visitType (from.type, [&] (auto tag) {
        for (std::size_t i = 0; i < from.count; ++i) {
          const auto number = from.value<decltype (tag)> (row, i);
          std::memcpy (to + i * sizeof (number), &number, sizeof (number));
        }
      });
    }
  }
}

} // namespace

Cloud
readClouds (const std::vector<std::filesystem::path>& files, const ReadOptions& options,
            std::vector<std::size_t>* firsts)
{
  if (firsts != nullptr)
    firsts->assign (1, 0);
  const auto read = [&] (const std::filesystem::path& file) {
    return readNamed (file, [&] { return readCloud (file, options); });
  };
  if (files.size () == 1) {
    Cloud cloud = read (files.front ());
    if (firsts != nullptr)
      firsts->push_back (cloud.rows);
    return cloud;
  }
  std::vector<Cloud> clouds;
  Cloud merged;
  for (const std::filesystem::path& file : files) {
    const Cloud& cloud = clouds.emplace_back (read (file));
    for (const std::string& warning : cloud.warnings)
      merged.warnings.push_back ("'" + file.string () + "': " + warning);
    merged.single_precision = merged.single_precision && cloud.single_precision;
    for (const std::string& note : cloud.notes)
      merged.notes.push_back ("'" + file.string () + "': " + note);
    if (!cloud.left_out.empty ()) {
      merged.left_out.resize (merged.rows, false);
      merged.left_out.insert (merged.left_out.end (), cloud.left_out.begin (),
                              cloud.left_out.end ());
    }
    merged.rows += cloud.rows;
    if (firsts != nullptr)
      firsts->push_back (merged.rows);
  }
  if (merged.rows > static_cast<std::size_t> (std::numeric_limits<std::int32_t>::max ()))
    throw ReadError ("the files have more points together than a mesh file can number "
                     "(2147483647); reconstruct fewer of them at a time");
  if (!merged.left_out.empty ())
    merged.left_out.resize (merged.rows, false);
  std::vector<Column> columns;
  for (std::size_t axis = 0; axis < 3; ++axis)
    columns.push_back (coordinateColumn (clouds, axis));
  for (const Field& field : clouds.front ().fields)
    if (std::optional<Column> column = fieldColumn (clouds, field))
      columns.push_back (std::move (*column));
    else
      merged.warnings.push_back ("the field '" + field.name +
                                 "' was left out: not all files have it with the same type");
  std::vector<Field*> fields;
  fields.reserve (columns.size ());
  for (Column& column : columns)
    fields.push_back (&column.merged);
  const std::shared_ptr<char> rows = allocateRows (fields, merged.rows);
  for (const Column& column : columns)
    copyColumn (column, clouds, rows.get () + (column.merged.first.get () - rows.get ()));
  for (std::size_t c = 0; c < columns.size (); ++c)
    if (c < 3)
      merged.coordinates[c] = columns[c].merged;
    else
      merged.fields.push_back (columns[c].merged);
  return merged;
}

} // namespace pcl::floater
