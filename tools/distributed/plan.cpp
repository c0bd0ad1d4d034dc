// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan.h"

#include "array_file.h"
#include "format.h"
#include "read_error.h"

#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* FORMAT = "pcl_floater work folder";

// FNV-1a.
std::uint64_t
hash (const std::string& text)
{
  std::uint64_t value = 0xcbf29ce484222325ULL;
  for (const char c : text)
    value = (value ^ static_cast<unsigned char> (c)) * 0x100000001b3ULL;
  return value;
}

std::string
hexadecimal (std::uint64_t value)
{
  constexpr std::size_t DIGITS = 16;
  std::string text (DIGITS, '0');
  for (std::size_t i = DIGITS; i-- > 0; value >>= 4U)
    text[i] = "0123456789abcdef"[value & 15U];
  return text;
}

// All but the id and the checksum.
Json
contents (const Plan& plan)
{
  Json inputs = Json::array ();
  for (const InputFile& input : plan.inputs)
    inputs.push_back (
        {{"file", input.path.string ()}, {"bytes", input.size}, {"checksum", input.checksum}});
  return {{"format", FORMAT},
          {"version", WORK_FORMAT},
          {"inputs", inputs},
          {"arguments", plan.arguments},
          {"parameters", plan.parameters},
          {"points", plan.points},
          {"blocks", plan.blocks},
          {"parts", plan.parts},
          {"cloud_points", plan.cloud_size},
          {"selected_points", plan.selected_points},
          {"lattice_width", plan.lattice_width},
          {"centre", plan.centre},
          {"scale", plan.scale},
          {"sensor_origin", plan.sensor_origin},
          {"shift", plan.shift},
          {"fields", plan.fields},
          {"warnings", plan.warnings},
          {"finite_points", plan.finite_points},
          {"is_single", plan.is_single},
          {"fits_single", plan.fits_single}};
}

} // namespace

InputFile
describeInput (const std::filesystem::path& path)
{
  InputFile input;
  input.path = path;
  constexpr std::streamoff MOST = 65536;
  std::ifstream file (path, std::ios::binary | std::ios::ate);
  if (!file || std::filesystem::is_directory (path))
    throw ReadError ("cannot read " + inputName (path) + ": " +
                     (file ? "it is a folder" : std::strerror (errno)));
  const std::streamoff size = file.tellg ();
  input.size = static_cast<std::uint64_t> (size);
  std::vector<char> bytes (static_cast<std::size_t> (std::min (size, MOST)));
  for (const std::streamoff at : {std::streamoff{0}, std::max<std::streamoff> (0, size - MOST)}) {
    file.seekg (at);
    file.read (bytes.data (), static_cast<std::streamsize> (bytes.size ()));
    if (!file)
      throw ReadError ("cannot read " + inputName (path) + ": it ends too early");
    input.checksum = static_cast<std::uint32_t> (
        ::crc32 (input.checksum, reinterpret_cast<const Bytef*> (bytes.data ()),
                 static_cast<uInt> (bytes.size ())));
  }
  return input;
}

std::uint64_t
planId (const std::vector<InputFile>& inputs, const std::string& parameters, std::size_t blocks)
{
  std::string text = std::to_string (WORK_FORMAT) + "\n" + parameters + "\n";
  for (const InputFile& input : inputs)
    text += std::to_string (input.size) + " " + std::to_string (input.checksum) + "\n";
  return hash (text + std::to_string (blocks));
}

std::string
manifestText (const Plan& plan)
{
  Json json = contents (plan);
  json["checksum"] =
      hexadecimal (hash (json.dump (-1, ' ', false, Json::error_handler_t::replace)));
  json["id"] = hexadecimal (plan.id);
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
    plan.id = std::stoull (json.at ("id").get<std::string> (), nullptr, 16);
    const std::string checksum = json.at ("checksum").get<std::string> ();
    for (const Json& input : json.at ("inputs"))
      plan.inputs.push_back ({input.at ("file").get<std::string> (),
                              input.at ("bytes").get<std::uint64_t> (),
                              input.at ("checksum").get<std::uint32_t> ()});
    json.at ("arguments").get_to (plan.arguments);
    json.at ("parameters").get_to (plan.parameters);
    json.at ("points").get_to (plan.points);
    json.at ("blocks").get_to (plan.blocks);
    json.at ("parts").get_to (plan.parts);
    json.at ("cloud_points").get_to (plan.cloud_size);
    json.at ("selected_points").get_to (plan.selected_points);
    json.at ("lattice_width").get_to (plan.lattice_width);
    json.at ("centre").get_to (plan.centre);
    json.at ("scale").get_to (plan.scale);
    json.at ("sensor_origin").get_to (plan.sensor_origin);
    json.at ("shift").get_to (plan.shift);
    json.at ("fields").get_to (plan.fields);
    json.at ("warnings").get_to (plan.warnings);
    json.at ("finite_points").get_to (plan.finite_points);
    json.at ("is_single").get_to (plan.is_single);
    json.at ("fits_single").get_to (plan.fits_single);
    if (checksum !=
        hexadecimal (hash (contents (plan).dump (-1, ' ', false, Json::error_handler_t::replace))))
      refuse ("is damaged; delete it and run again");
    return plan;
  }
  catch (const Json::exception&) {
    refuse ("is damaged; delete it and run again");
  }
  catch (const std::logic_error&) { // the id is no number
    refuse ("is damaged; delete it and run again");
  }
  return {};
}

} // namespace pcl::floater
