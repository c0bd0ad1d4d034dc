// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: the bytes are a file of the format that FUZZED_FORMAT of the environment names;
// table: text with a point in each line.
#include "fuzz_target.h"
#include "reader_target.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace pcl::floater::fuzz {
using Parse = std::function<Cloud (const FileBytes&)>;

/// The cloud of a mesh. Ends the program if the mesh does not hold together.
static Cloud
withCorners (Cloud cloud, const Triangles& triangles)
{
  for (const auto& triangle : triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= cloud.rows)
        fail ("a triangle has a corner that is no point");
  return cloud;
}

static const std::map<std::string, std::vector<Parse>> FORMATS{
    {"pcd",
     {[] (const FileBytes& file) { return parsePcd (file, false); },
      [] (const FileBytes& file) { return parsePcd (file, true); }}},
    {"ply",
     {[] (const FileBytes& file) { return parsePly (file, false); },
      [] (const FileBytes& file) { return parsePly (file, true); },
      [] (const FileBytes& file) {
        Triangles triangles;
        Cloud cloud = parsePly (file, false, &triangles);
        return withCorners (std::move (cloud), triangles);
      }}},
    {"vtk", {[] (const FileBytes& file) {
       Triangles triangles;
       Cloud cloud = parseVtk (file, triangles);
       return withCorners (std::move (cloud), triangles);
     }}},
    {"obj", {[] (const FileBytes& file) { return parseObj (file); }}},
    {"stl", {[] (const FileBytes& file) { return parseStl (file); }}},
    {"las", {[] (const FileBytes& file) { return parseLas (file); }}},
    {"table",
     {[] (const FileBytes& file) { return parseTable (file, false); },
      [] (const FileBytes& file) { return parseTable (file, true); }}}};

static const std::vector<Parse>&
chosenFormat ()
{
  const char* const name = std::getenv ("FUZZED_FORMAT");
  const auto found = FORMATS.find (name == nullptr ? "" : name);
  if (found == FORMATS.end ())
    fail ("FUZZED_FORMAT names no format");
  return found->second;
}
} // namespace pcl::floater::fuzz

int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
  namespace fuzz = pcl::floater::fuzz;
  static const std::vector<fuzz::Parse>& format = fuzz::chosenFormat ();
  for (const fuzz::Parse& parse : format)
    fuzz::readBytes (data, size, parse);
  return 0;
}
