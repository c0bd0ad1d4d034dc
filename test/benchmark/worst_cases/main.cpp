// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Processor time of clouds that are hard on a reconstruction, and the factor to an ordinary one.
#include "hard_clouds.h"

#include <pcl/surface/floater/reconstruct.h>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

#include <sys/resource.h>

namespace
{
using namespace pcl::floater;

double
userSeconds ()
{
  rusage usage{};
  ::getrusage (RUSAGE_SELF, &usage);
  return static_cast<double> (usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double> (usage.ru_utime.tv_usec);
}

Options
optionsOf (const HardCloud& cloud, Neighborhood neighborhood)
{
  Options options;
  options.neighbors.kind = neighborhood;
  if (cloud.closes_holes)
    options.holes.policy = HolePolicy::CLOSE_ALL;
  if (cloud.is_view)
    options.view.use = ViewUse::GIVEN;
  return options;
}

struct Taken
{
  double seconds = 0.0;
  Result result;
};

Taken
run (const HardCloud& cloud, std::size_t points, Neighborhood neighborhood, int times)
{
  Taken taken;
  for (int i = 0; i < times; ++i) {
    std::vector<Eigen::Vector3d> positions = cloud.make (points);
    const double start = userSeconds ();
    taken.result = reconstruct (std::move (positions), optionsOf (cloud, neighborhood));
    const double seconds = userSeconds () - start;
    taken.seconds = i == 0 ? seconds : std::min (taken.seconds, seconds);
  }
  return taken;
}

void
print (const std::string& name, const Taken& taken, double ordinary)
{
  const Statistics& statistics = taken.result.report.statistics;
  double slowest = 0.0;
  std::size_t stage = 0;
  for (std::size_t i = 0; i < statistics.seconds.size (); ++i)
    if (statistics.seconds[i] > slowest) {
      slowest = statistics.seconds[i];
      stage = i;
    }
  std::printf ("%-20s %9.2f %7.1f   %-12s %-12s %9zu triangles\n", name.c_str (), taken.seconds,
               taken.seconds / ordinary, stageName (static_cast<Stage> (stage)),
               statusName (taken.result.report.status), taken.result.triangles.size ());
  std::fflush (stdout);
}

} // namespace

int
main (int argc, char** argv)
{
  CLI::App app{
      "User time of clouds that are hard on a reconstruction, the least of some runs, the factor "
      "to an ordinary cloud of as many points, and the stage that took most."};
  std::size_t points = 50000;
  int times = 1;
  std::string only;
  bool lists = false;
  app.add_option ("--points", points, "of each cloud")->check (CLI::Range (1000, 10000000));
  app.add_option ("--times", times, "runs of each cloud")->check (CLI::Range (1, 100));
  app.add_option ("--only", only, "one cloud, by its name");
  app.add_flag ("--list", lists, "tell what the clouds are");
  CLI11_PARSE (app, argc, argv);
  const std::vector<HardCloud>& clouds = hardClouds ();
  if (lists) {
    for (const HardCloud& cloud : clouds)
      std::printf ("%-20s %s\n", cloud.name.c_str (), cloud.meaning.c_str ());
    return 0;
  }
  std::printf ("%-20s %9s %7s   %-12s\n", "cloud", "user s", "factor", "slowest");
  for (const auto neighborhood : {Neighborhood::NEAREST_DELAUNAY, Neighborhood::BALL}) {
    const double ordinary = run (clouds.front (), points, neighborhood, times).seconds;
    for (const HardCloud& cloud : clouds)
      if (only.empty () || cloud.name == only)
        print (cloud.name + (neighborhood == Neighborhood::BALL ? ", ball" : ""),
               run (cloud, points, neighborhood, times), ordinary);
  }
  return 0;
}
