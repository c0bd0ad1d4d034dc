// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Prints what the reader makes of a file, as JSON: read_cloud FILE [COLUMNS [CLASSES]], both lists of JSON.
// read_cloud --prefixes FILE STEP: lengths of its beginnings that are not refused, the longest first.
#include "cloud_reader.h"

#include <nlohmann/json.hpp>

#include <iostream>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;

Json
describe (Cloud& cloud)
{
  Json points = Json::array (), fields = Json::array ();
  for (const Eigen::Vector3d& p : cloud.positions ())
    points.push_back ({p.x (), p.y (), p.z ()});
  for (const Field& field : cloud.fields) {
    Json values = Json::array (); // null where they are no numbers
    visitType (field.type, [&] (auto tag) {
      for (std::size_t row = 0; row < cloud.rows; ++row)
        for (std::size_t c = 0; c < field.count; ++c)
          values.push_back (static_cast<double> (field.value<decltype (tag)> (row, c)));
    });
    fields.push_back ({field.name, values});
  }
  Json all{{"points", points},
           {"fields", fields},
           {"is_single", cloud.single_precision},
           {"has_colors", cloud.colors ()[0] != nullptr},
           {"may_be_degrees", cloud.may_be_degrees},
           {"sensor_origin", cloud.sensor_origin},
           {"towards_sensors", cloud.towards_sensors.size ()},
           {"left_out", cloud.left_out},
           {"warnings", cloud.warnings},
           {"notes", cloud.notes}};
  Triangles none;
  all["not_finite"] = removeNonFinitePoints (cloud, none);
  all["kept"] = Json::array ();
  for (std::size_t point = 0; point < cloud.size (); ++point)
    all["kept"].push_back (cloud.row (point));
  return all;
}

Json
readablePrefixes (const std::filesystem::path& path, std::size_t step)
{
  const FileBytes file (path);
  Json lengths = Json::array ();
  for (std::size_t length = file.view ().size (); length > 0; length -= std::min (length, step))
    try {
      // A copy, so that a sanitizer notices reads beyond the prefix.
      const std::vector<char> prefix (file.view ().begin (), file.view ().begin () + length);
      Cloud cloud = cloudFormatOf (path) (FileBytes (std::string_view (prefix.data (), length)),
                                          {true, {}, {}});
      describe (cloud);
      lengths.push_back (length);
    }
    catch (const ReadError& error) {
      if (*error.what () == 0)
        throw std::logic_error ("a message is empty");
    }
  return lengths;
}

} // namespace
} // namespace pcl::floater

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  Json result;
  try {
    if (argc > 3 && std::string (argv[1]) == "--prefixes")
      result = readablePrefixes (argv[2], std::stoul (argv[3]));
    else {
      ReadOptions options;
      if (argc > 2)
        Json::parse (argv[2]).get_to (options.columns);
      if (argc > 3)
        Json::parse (argv[3]).get_to (options.classes);
      Cloud cloud = readCloud (argv[1], options);
      result = describe (cloud);
    }
  }
  catch (const ReadError& error) {
    result = {{"error", error.what ()}};
  }
  std::cout << result.dump (-1, ' ', false, Json::error_handler_t::replace) << '\n';
}
