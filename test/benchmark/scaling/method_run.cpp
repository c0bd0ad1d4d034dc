// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "method_run.h"

#include "cloud_reader.h"
#include "mesh_writer.h"
#include "stopwatch.h"

#include <CLI/CLI.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

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

constexpr const char* COLUMNS = "seconds,cpu_seconds,read_seconds,write_seconds,start_bytes,"
                                "peak_bytes,triangles,used_points,stages";

struct CommandLine
{
  std::string method;
  std::filesystem::path cloud, mesh;
  int threads = 0;
  bool columns = false, count = false;
};

// One row; see COLUMNS.
struct Figures
{
  double seconds = 0.0, cpu_seconds = 0.0, read_seconds = 0.0, write_seconds = 0.0;
  std::size_t start_bytes = 0; // resident when the measurement begins
  std::size_t peak_bytes = 0;  // largest resident set of the process until the measurement ends
};

// Of all threads, in user and system mode.
double
cpuSeconds ()
{
  constexpr double MICROSECOND = 1e-6;
  rusage usage{};
  ::getrusage (RUSAGE_SELF, &usage);
  return static_cast<double> (usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         MICROSECOND * static_cast<double> (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

// The process must have been started from a small one: what that had resident is counted, too.
std::size_t
peakBytes ()
{
  constexpr std::size_t UNIT = 1024; // Linux counts in kB
  rusage usage{};
  ::getrusage (RUSAGE_SELF, &usage);
  return static_cast<std::size_t> (usage.ru_maxrss) * UNIT;
}

std::size_t
residentBytes ()
{
  std::ifstream file ("/proc/self/statm");
  std::size_t all = 0, resident = 0; // pages
  file >> all >> resident;
  return resident * static_cast<std::size_t> (::sysconf (_SC_PAGESIZE));
}

// The finite points of a file alone.
Cloud
readPoints (const std::filesystem::path& path)
{
  Cloud cloud = readCloud (path);
  cloud.fields.clear ();
  Triangles none;
  removeNonFinitePoints (cloud, none);
  return cloud;
}

// The same writer for all methods; the file goes away again.
double
writeSeconds (const CommandLine& line, const Triangles& triangles)
{
  const Cloud cloud = readPoints (line.cloud);
  const Stopwatch stopwatch;
  AtomicFile file (line.mesh);
  writeMesh (file, line.mesh, cloud, triangles);
  file.close ();
  return stopwatch.seconds ();
}

std::size_t
countUsed (const Triangles& triangles, std::size_t points)
{
  std::vector<bool> is_used (points, false);
  for (const auto& triangle : triangles)
    for (const std::uint32_t p : triangle)
      is_used.at (p) = true;
  return static_cast<std::size_t> (std::count (is_used.begin (), is_used.end (), true));
}

std::string
stagesText (const std::vector<StageTime>& stages)
{
  std::string text;
  for (const StageTime& stage : stages)
    text += (text.empty () ? "" : ";") + stage.name + "=" + std::to_string (stage.seconds);
  return text;
}

void
measure (const CommandLine& line, Method& method)
{
  Figures figures;
  std::size_t points = 0;
  {
    const Stopwatch reading;
    const Cloud cloud = readPoints (line.cloud);
    figures.read_seconds = reading.seconds ();
    points = cloud.size ();
    method.prepare (cloud.positions ());
  }
  figures.start_bytes = residentBytes ();
  const double cpu_before = cpuSeconds ();
  const Stopwatch stopwatch;
  method.run ();
  figures.seconds = stopwatch.seconds ();
  figures.cpu_seconds = cpuSeconds () - cpu_before;
  figures.peak_bytes = peakBytes ();

  const Triangles triangles = method.triangles ();
  if (triangles.empty ())
    throw std::runtime_error ("there is no triangle");
  if (!line.mesh.empty ())
    figures.write_seconds = writeSeconds (line, triangles);
  std::printf ("%.6f,%.6f,%.6f,%.6f,%zu,%zu,%zu,%zu,%s\n", figures.seconds, figures.cpu_seconds,
               figures.read_seconds, figures.write_seconds, figures.start_bytes, figures.peak_bytes,
               triangles.size (), countUsed (triangles, points),
               stagesText (method.stages ()).c_str ());
  if (std::fflush (stdout) != 0)
    throw WriteError ("cannot write to the standard output");
}

void
run (const CommandLine& line, const MakeMethod& make)
{
  if (line.columns)
    std::printf ("%s\n", COLUMNS);
  else if (line.count)
    std::printf ("%zu\n", readPoints (line.cloud).size ());
  else
    measure (line, *make (line.method, line.threads));
}

} // namespace

int
runMethod (int argc, char** argv, const std::vector<std::string>& names, const MakeMethod& make)
{
  CommandLine line;
  line.method = names.front ();
  CLI::App app{"Runs a method on a cloud once and prints what it took, as a row of CSV."};
  app.add_option ("cloud", line.cloud,
                  "cloud: .pcd, .ply or .obj; points that are not finite are "
                  "left out")
      ->option_text ("CLOUD");
  app.add_option ("--method", line.method, "method")
      ->capture_default_str ()
      ->check (CLI::IsMember (names));
  app.add_option ("-j,--threads", line.threads, "threads; 0: one for each core")
      ->capture_default_str ()
      ->check (CLI::Range (0, 256));
  app.add_option ("--mesh", line.mesh,
                  "file that is written to measure it (.ply, .vtk, .obj, .stl), and removed")
      ->option_text ("FILE");
  app.add_flag ("--columns", line.columns, "prints the head of the row instead");
  app.add_flag ("--count", line.count, "prints the number of points instead");
  try {
    app.parse (argc, argv);
    if (line.cloud.empty () && !line.columns)
      throw CLI::RequiredError ("CLOUD");
  }
  catch (const CLI::ParseError& error) {
    return app.exit (error) == 0 ? DONE : USAGE;
  }
  handleSignals ();
  try {
    run (line, make);
  }
  catch (const std::exception& error) {
    std::fprintf (stderr, "%s: %s: %s\n", line.method.c_str (), line.cloud.c_str (), error.what ());
    return FAILED;
  }
  return DONE;
}

} // namespace floater
} // namespace pcl
