// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes random surfaces as clouds with their truth: NAME.pcd and NAME.gt.ply.
#include "solid_surface.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>

namespace
{
using pcl::floater::SolidSurface;

void
writePositions (const SolidSurface& surface, std::ofstream& file)
{
  file.precision (std::numeric_limits<float>::max_digits10);
  for (const Eigen::Vector3d& p : surface.positions)
    file << p.x () << ' ' << p.y () << ' ' << p.z () << '\n';
}

void
writeCloud (const SolidSurface& surface, const std::filesystem::path& path)
{
  std::ofstream file (path);
  file << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
       << surface.positions.size () << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
       << surface.positions.size () << "\nDATA ascii\n";
  writePositions (surface, file);
  if (!file)
    throw std::runtime_error ("cannot write " + path.string ());
}

void
writeTruth (const SolidSurface& surface, const std::filesystem::path& path)
{
  std::ofstream file (path);
  file << "ply\nformat ascii 1.0\nelement vertex " << surface.positions.size ()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
       << surface.triangles.size () << "\nproperty list uchar int vertex_indices\nend_header\n";
  writePositions (surface, file);
  for (const auto& [a, b, c] : surface.triangles)
    file << "3 " << a << ' ' << b << ' ' << c << '\n';
  if (!file)
    throw std::runtime_error ("cannot write " + path.string ());
}

void
run (const std::filesystem::path& folder, std::uint64_t first, std::uint64_t count)
{
  std::filesystem::create_directories (folder);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const std::optional<SolidSurface> surface = pcl::floater::makeSolidSurface (seed);
    if (!surface)
      continue;
    const std::string name = "solid_" + std::to_string (seed);
    writeCloud (*surface, folder / (name + ".pcd"));
    writeTruth (*surface, folder / (name + ".gt.ply"));
    std::cout << name << ": " << surface->positions.size () << " points, " << surface->description
              << std::endl; // one takes a second
  }
}

} // namespace

int
main (int argc, char** argv)
{
  CLI::App app (
      "Writes clouds of random bodies with their true surfaces, NAME.pcd and NAME.gt.ply. "
      "pcl_floater_limits tells which of a folder are reconstructed without a flaw.");
  std::filesystem::path folder;
  std::uint64_t first = 0, count = 100;
  app.add_option ("folder", folder, "where they are written")->required ();
  app.add_option ("--first", first, "seed of the first one")->capture_default_str ();
  app.add_option ("--count", count, "number of seeds, about two thirds of which give a surface")
      ->capture_default_str ();
  CLI11_PARSE (app, argc, argv);
  try {
    run (folder, first, count);
  }
  catch (const std::exception& error) {
    std::cerr << "pcl_floater_solids: " << error.what () << '\n';
    return 1;
  }
  return 0;
}
