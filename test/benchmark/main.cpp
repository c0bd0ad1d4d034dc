// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// pcl_floater_benchmark: makes the tables and figures of TW 385 again, from clouds of the user's.
#include "atomic_file.h"
#include "cloud_reader.h"
#include "floater/solvers/solver.h"
#include "mesh_picture.h"
#include "processor.h"
#include "section.h"
#include "stopwatch.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>

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
  std::filesystem::path out;
  std::vector<std::filesystem::path> clouds;
  std::vector<std::string> only;
  Settings settings;
};

struct NamedSection
{
  std::string name;
  std::unique_ptr<Section> section;
};

const std::vector<std::string> SECTIONS{"memory", "fill",     "times",  "sparsity",
                                        "mesh",   "residual", "quality"};

std::vector<NamedSection>
makeSections (const CommandLine& line)
{
  std::vector<NamedSection> sections;
  const auto add = [&] (const std::string& name, const auto& make) {
    if (line.only.empty () ||
        std::find (line.only.begin (), line.only.end (), name) != line.only.end ())
      sections.push_back ({name, make ()});
  };
  add ("memory", [] { return makeMemoryTable (); });
  add ("fill", [] { return makeFillTable (); });
  add ("times", [&] { return makeTimesTable (line.settings); });
  add ("sparsity", [] { return makeSparsityFigure (); });
  add ("mesh", [] { return makeMeshFigure (); });
  add ("residual", [] { return makeResidualTable (); });
  add ("quality", [&] { return makeQualityTable (line.settings); });
  return sections;
}

Sample
makeSample (const std::filesystem::path& path, const Settings& settings)
{
  Sample sample;
  sample.path = path;
  try {
    sample.cloud = readCloud (path);
  }
  catch (const ReadError& error) {
    throw ReadError ("cannot read '" + path.string () + "': " + error.what ());
  }
  Options options;
  options.topology = Topology::DISC;
  options.threads = settings.threads;
  sample.disc = runStages (path.stem ().string (), sample.cloud, options);
  const Solution solution =
      solve (sample.disc.system, options.disc.solver, nullptr, options.threads);
  if (solution.outcome != Solution::Outcome::OK)
    throw std::runtime_error (sample.disc.name + ": " + solution.message);
  sample.direct = parametersOf (sample.disc, solution.uv);
  return sample;
}

void
run (const CommandLine& line)
{
  const std::vector<NamedSection> sections = makeSections (line);
  ReportFolder report (line.out);
  report.heading ("The tables and figures of TW 385, measured again");
  std::string clouds;
  for (const std::filesystem::path& path : line.clouds) {
    const Sample sample = makeSample (path, line.settings);
    for (const NamedSection& one : sections) {
      std::fprintf (stderr, "%s: %s ", sample.disc.name.c_str (), one.name.c_str ());
      const Stopwatch stopwatch;
      one.section->measure (sample);
      std::fprintf (stderr, "%.1f s\n", stopwatch.seconds ());
    }
    clouds += (clouds.empty () ? "" : ", ") + sample.disc.name + " (" +
              grouped (sample.disc.points.size ()) + " points" +
              (sample.disc.left_out > 0 ? ", " + std::to_string (sample.disc.left_out) +
                                              " left out, since they do not connect to the boundary"
                                        : std::string ()) +
              ")";
  }
  const std::string processor = processorName ();
  report.paragraph (
      "TW 385: *Efficient Triangulation of Point Clouds Using Floater Parameterization*, January "
      "2004. Clouds: " +
      clouds +
      ". Neighbourhoods are Delaunay stars among the 20 nearest, weights are mean values, the loop "
      "is on a circle, unless a table says otherwise." +
      (processor.empty () ? "" : " Processor: " + processor + "."));
  for (const NamedSection& one : sections)
    one.section->write (report);
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
  CLI::App app{
      "Makes the tables and figures of TW 385 again: DIR/report.md, with CSV files and\n"
      "pictures beside it. A ground truth NAME.gt.ply beside NAME.pcd is used where it exists."};
  app.add_option ("--out", line.out, "folder for the report")->required ()->option_text ("DIR");
  app.add_option ("clouds", line.clouds, "clouds, each a disc: .pcd, .ply or .obj")
      ->required ()
      ->option_text ("CLOUD...");
  app.add_option ("--only", line.only, "sections, separated by commas; all without")
      ->delimiter (',')
      ->check (CLI::IsMember (SECTIONS));
  app.add_option ("--repeats", line.settings.repeats, "runs of which the shortest time is taken")
      ->capture_default_str ()
      ->check (CLI::Range (1, 100));
  app.add_option ("-j,--threads", line.settings.threads, "threads of all but GMM++")
      ->capture_default_str ()
      ->check (CLI::Range (1, 256));
  try {
    app.parse (argc, argv);
  }
  catch (const CLI::ParseError& error) {
    return app.exit (error) == 0 ? DONE : USAGE;
  }

  handleSignals ();
  if (!displayAvailable ()) {
    std::cerr << "pcl_floater_benchmark: there is no X display to draw on; put "
                 "tools/picture/on_virtual_display.sh in front\n";
    return FAILED;
  }
  try {
    run (line);
  }
  catch (const std::exception& error) {
    std::cerr << "pcl_floater_benchmark: " << error.what () << "\n";
    return FAILED;
  }
  return DONE;
}
