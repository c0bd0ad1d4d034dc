// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// pcl_floater_generate: writes points on a known surface, as a sample cloud.
#include "small_tool.h"
#include "surfaces.h"

#include <map>

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  CLI::App app{"Writes points on a known surface, in random order, as a sample cloud (.pcd or "
               ".ply, binary).\n"
               "The unit of length is the mean spacing of the points: one point per unit of area.\n"
               "Exit codes: 0 success, 1 usage, 3 there is not enough memory, 4 the output cannot "
               "be written.",
               "pcl_floater_generate"};
  app.option_defaults ()->always_capture_default ();
  constexpr std::size_t MOST_POINTS = 1000000000;
  std::string name, path;
  SurfaceSpec spec;
  const std::map<std::string, SurfaceKind> kinds (SURFACES.begin (), SURFACES.end ());
  app.add_option ("surface", name, "kind of surface")->required ()->check (CLI::IsMember (kinds));
  app.add_option ("output", path, "file to write, .pcd or .ply")->required ();
  app.add_option ("--points", spec.points, "number of points")
      ->check (CLI::Range (MIN_SURFACE_POINTS, MOST_POINTS));
  app.add_option ("--seed", spec.seed, "seed of the random numbers")
      ->check (CLI::NonNegativeNumber);
  app.add_option ("--density-ratio", spec.density_ratio,
                  "largest over smallest density in points per area, 1 to 100");
  app.add_option ("--noise", spec.noise, "standard deviation of each coordinate, in mean spacings");
  app.add_option ("--length", spec.length, "finger: length of the cylinder over its radius");
  app.add_option ("--gap", spec.gap, "folded-sheet: distance of its halves, in mean spacings");
  app.add_option ("--holes", spec.holes, "cut-out: number of holes");
  return runSmallTool (app, argc, argv, [&] {
    const std::string extension = std::filesystem::path (path).extension ().string ();
    if (extension != ".pcd" && extension != ".ply")
      throw std::invalid_argument ("'" + path + "' must end in .pcd or .ply");
    spec.kind = kinds.at (name);
    requireWritable (path);
    const std::vector<Eigen::Vector3d> points = generateSurface (spec);
    AtomicFile file (path);
    if (extension == ".pcd")
      file.print (
          "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
          "TYPE F F F\nCOUNT 1 1 1\nWIDTH ",
          points.size (), "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS ", points.size (),
          "\nDATA binary\n");
    else
      file.print ("ply\nformat binary_little_endian 1.0\nelement vertex ", points.size (),
                  "\nproperty float x\nproperty float y\nproperty float z\nend_header\n");
    for (const Eigen::Vector3d& point : points)
      for (const double coordinate : point)
        file.writeNumber (static_cast<float> (coordinate));
    file.publish ();
  });
}
