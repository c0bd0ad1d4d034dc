// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// pcl_floater_scaling_report: tables and charts of the runs that scaling.sh measured.
#include "atomic_file.h"
#include "measurements.h"
#include "mesh_picture.h"
#include "processor.h"
#include "report_folder.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <map>
#include <thread>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
enum ExitCode : int
{
  DONE = 0,
  USAGE = 1,
  FAILED = 2
};

struct CommandLine
{
  std::filesystem::path runs, out;
  std::vector<std::string> notes;
};

using Measurements = std::vector<Measurement>;

constexpr double MEGABYTE = 1e6;

double
seconds (const Measurement& one)
{
  return one.figures["seconds"];
}

double
megabytes (const Measurement& one)
{
  return one.figures["peak_bytes"] / MEGABYTE;
}

// What the run added to libraries and points.
double
addedMegabytes (const Measurement& one)
{
  return (one.figures["peak_bytes"] - one.figures["start_bytes"]) / MEGABYTE;
}

std::string
exponentText (const GrowthSeries& series)
{
  return hasPowerLaw (series) ? fixed (fitPowerLaw (series).exponent, 2) : "-";
}

void
writeIntroduction (const CommandLine& line, ReportFolder& report)
{
  report.heading ("How time and memory grow with the number of points");
  report.paragraph (
      "Each run is a process of its own, the methods take turns; figures are medians of the "
      "repeated runs. Time: from the points in memory to the triangles in memory, on the wall and "
      "of the processors; \"with files\" adds reading the cloud and writing the mesh as PLY, by "
      "the same reader and writer for all. Memory: the largest resident set of the process "
      "(ru_maxrss), with libraries and points.");
  report.paragraph (
      "floater: `pcl::FloaterReconstruction`, all defaults; floater-disc: the same with "
      "`Topology::DISC`. gp3: `pcl::GreedyProjectionTriangulation`, mu 2.5, 100 neighbours, "
      "surface angle 45, angles 10 to 120 degrees, radius 5 times the mean distance to the 6 "
      "nearest neighbours, normals by `NormalEstimationOMP` from 20. afs: CGAL's "
      "`advancing_front_surface_reconstruction`, radius ratio 5, beta 0.52.");
  const std::string processor = processorName ();
  std::string machine = "Cores: " + std::to_string (std::thread::hardware_concurrency ()) + ".";
  if (!processor.empty ())
    machine += " Processor: " + processor + ".";
  for (const std::string& note : line.notes)
    machine += " " + note;
  report.paragraph (machine);
}

Table
runsTable (const Measurements& measurements)
{
  Table table{{"method", "cloud", "points", "seconds", "CPU seconds", "with files",
               "microseconds per point", "MB", "bytes per point", "triangles", "points used, %",
               "runs"},
              {}};
  constexpr double MICRO = 1e6;
  for (const Measurement& one : measurements) {
    const Figures& f = one.figures;
    std::vector<std::string> row{one.method, one.cloud,
                                 grouped (static_cast<std::size_t> (one.points))};
    if (one.outcome != "ok") {
      row.push_back (one.outcome);
      row.resize (table.columns.size (), "-");
    }
    else
      row.insert (row.end (),
                  {fixed (seconds (one), 3), fixed (f["cpu_seconds"], 3),
                   fixed (f["read_seconds"] + seconds (one) + f["write_seconds"], 3),
                   fixed (MICRO * seconds (one) / one.points, 2), fixed (megabytes (one), 0),
                   fixed (f["peak_bytes"] / one.points, 0),
                   grouped (static_cast<std::size_t> (f["triangles"])),
                   fixed (100.0 * f["used_points"] / one.points, 2), std::to_string (one.runs)});
    table.rows.push_back (std::move (row));
  }
  return table;
}

// Seconds and memory of all methods on each cloud.
Table
comparisonTable (const Measurements& all)
{
  const std::vector<std::string> methods = namesOf (all, &Measurement::method);
  Table table{{"cloud", "points"}, {}};
  table.columns.insert (table.columns.end (), methods.begin (), methods.end ());
  std::map<std::pair<std::string, double>, std::size_t> row_of;
  for (const Measurement& one : all) {
    const auto [at, is_new] =
        row_of.emplace (std::pair (one.cloud, one.points), table.rows.size ());
    if (is_new) {
      table.rows.push_back ({one.cloud, grouped (static_cast<std::size_t> (one.points))});
      table.rows.back ().resize (table.columns.size (), "-");
    }
    const auto column = std::find (methods.begin (), methods.end (), one.method);
    table.rows[at->second][2 + static_cast<std::size_t> (column - methods.begin ())] =
        one.outcome == "ok" ? fixed (seconds (one), 2) + " s, " + fixed (megabytes (one), 0) + " MB"
                            : one.outcome;
  }
  return table;
}

// A chart of all that have a power law, if there are any.
void
drawChart (ReportFolder& report, const std::string& name, std::vector<GrowthSeries> series,
           const std::string& quantity, const std::string& caption)
{
  series.erase (std::remove_if (series.begin (), series.end (),
                                [] (const GrowthSeries& one) { return !hasPowerLaw (one); }),
                series.end ());
  if (!series.empty ())
    report.picture (name, drawGrowth (series, quantity), caption);
}

void
writeSurface (const std::string& surface, const Measurements& measurements, ReportFolder& report)
{
  report.heading (surface);
  report.table ("runs_" + surface, runsTable (measurements));
  std::vector<GrowthSeries> times, memory;
  for (const std::string& method : namesOf (measurements, &Measurement::method)) {
    const Measurements of_method = select (measurements, &Measurement::method, method);
    times.push_back (seriesOf (method, of_method, seconds));
    memory.push_back (seriesOf (method, of_method, megabytes));
  }
  drawChart (report, "time_" + surface, times, "seconds", surface + ": seconds against points");
  drawChart (report, "memory_" + surface, memory, "peak memory, MB",
             surface + ": peak memory against points");
}

void
writeExponents (const Measurements& all, ReportFolder& report)
{
  Table table{{"surface", "method", "time", "CPU time", "memory", "memory above start"}, {}};
  for (const std::string& surface : namesOf (all, &Measurement::surface)) {
    const Measurements of_surface = select (all, &Measurement::surface, surface);
    for (const std::string& method : namesOf (of_surface, &Measurement::method)) {
      const Measurements of_method = select (of_surface, &Measurement::method, method);
      const auto cpu = [] (const Measurement& one) { return one.figures["cpu_seconds"]; };
      table.rows.push_back ({surface, method, exponentText (seriesOf ("", of_method, seconds)),
                             exponentText (seriesOf ("", of_method, cpu)),
                             exponentText (seriesOf ("", of_method, megabytes)),
                             exponentText (seriesOf ("", of_method, addedMegabytes))});
    }
  }
  report.heading ("Exponents");
  report.paragraph ("p of the power law c N^p nearest to the figures, by least squares of the "
                    "logarithms. Above start: without what was resident when the run began, which "
                    "is libraries and points, and most of the memory of small clouds.");
  report.table ("exponents", table);
}

// Those that took any time at all.
std::vector<std::string>
stageNames (const Measurements& measurements)
{
  std::vector<std::string> names;
  for (const Measurement& one : measurements)
    for (std::size_t i = 0; i < one.stages.names.size (); ++i)
      if (one.stages.values[i] > 0.0 &&
          std::find (names.begin (), names.end (), one.stages.names[i]) == names.end ())
        names.push_back (one.stages.names[i]);
  return names;
}

void
writeStages (const std::string& surface, const std::string& method,
             const Measurements& measurements, ReportFolder& report)
{
  const std::vector<std::string> names = stageNames (measurements);
  if (names.empty ())
    return;
  Table table{{"cloud", "points"}, {}};
  table.columns.insert (table.columns.end (), names.begin (), names.end ());
  for (const Measurement& one : measurements) {
    if (one.outcome != "ok")
      continue;
    std::vector<std::string> row{one.cloud, grouped (static_cast<std::size_t> (one.points))};
    for (const std::string& name : names)
      row.push_back (fixed (one.stages[name], 4));
    table.rows.push_back (std::move (row));
  }
  std::vector<std::string> exponents{"exponent", ""};
  std::vector<GrowthSeries> series;
  for (const std::string& name : names) {
    series.push_back (
        seriesOf (name, measurements, [&] (const Measurement& one) { return one.stages[name]; }));
    exponents.push_back (exponentText (series.back ()));
  }
  table.rows.push_back (std::move (exponents));
  report.heading (surface + ", " + method + ": seconds by stage");
  report.table ("stages_" + surface + "_" + method, table);
  drawChart (report, "stages_" + surface + "_" + method, series, "seconds",
             surface + ", " + method + ": seconds by stage against points");
}

void
run (const CommandLine& line)
{
  const Measurements all = readMeasurements (line.runs);
  ReportFolder report (line.out);
  writeIntroduction (line, report);
  report.heading ("Side by side");
  report.table ("comparison", comparisonTable (all));
  const std::vector<std::string> surfaces = namesOf (all, &Measurement::surface);
  for (const std::string& surface : surfaces)
    writeSurface (surface, select (all, &Measurement::surface, surface), report);
  writeExponents (all, report);
  for (const std::string& surface : surfaces) {
    const Measurements of_surface = select (all, &Measurement::surface, surface);
    for (const std::string& method : namesOf (of_surface, &Measurement::method))
      writeStages (surface, method, select (of_surface, &Measurement::method, method), report);
  }
  std::cout << report.finish ().string () << "\n";
}

} // namespace
} // namespace floater
} // namespace pcl

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  CommandLine line;
  CLI::App app{"Makes DIR/report.md, with CSV files and pictures beside it, of measured runs."};
  app.add_option ("runs", line.runs, "CSV file of scaling.sh")->required ()->option_text ("RUNS");
  app.add_option ("--out", line.out, "folder for the report")->required ()->option_text ("DIR");
  app.add_option ("--note", line.notes, "sentences on how it was measured")->option_text ("TEXT");
  try {
    app.parse (argc, argv);
  }
  catch (const CLI::ParseError& error) {
    return app.exit (error) == 0 ? DONE : USAGE;
  }
  handleSignals ();
  if (!displayAvailable ()) {
    std::cerr << "pcl_floater_scaling_report: there is no X display to draw on; put "
                 "tools/picture/on_virtual_display.sh in front\n";
    return FAILED;
  }
  try {
    run (line);
  }
  catch (const std::exception& error) {
    std::cerr << "pcl_floater_scaling_report: " << error.what () << "\n";
    return FAILED;
  }
  return DONE;
}
