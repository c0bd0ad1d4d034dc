// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What hangs on each limit: how many verdicts change if it is a fifth smaller or larger.
#include "limit_list.h"
#include "reconstruct.h"
#include "truth.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>

namespace
{
namespace floater = pcl::floater;

// Which clouds are reconstructed, and how.
struct Settings
{
  std::filesystem::path folder;
  std::string only; // limits whose name holds this text
  std::size_t most_points = 150'000;
  bool with_sensors = false;
  bool as_discs = false; // by the disc method; clouds whose true mesh is a disc
  int threads = 0;
};

struct Verdict
{
  std::vector<floater::Triangle> triangles;
  std::string flaws;
};

bool
isScan (const std::string& name)
{
  return name.rfind ("sensor_", 0) == 0;
}

std::string
judge (const std::vector<floater::Triangle>& triangles, const floater::Truth& truth)
{
  return isScan (truth.name) ? floater::flawsOfScan (triangles, truth)
                             : floater::flawsOf (triangles, truth);
}

std::vector<floater::Triangle>
reconstruct (const floater::Truth& truth, const floater::Limits& limits, const Settings& settings)
{
  floater::Options options;
  options.threads = settings.threads;
  if (settings.as_discs)
    options.topology = floater::Topology::DISC;
  return floater::reconstruct (
             {truth.points.positions, truth.points.cloud_index, truth.points.size (), nullptr},
             options, limits)
      .triangles;
}

std::vector<floater::Truth>
readCases (const Settings& settings)
{
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator (settings.folder)) {
    const std::string name = entry.path ().filename ().string ();
    if (name.size () > 7 && name.substr (name.size () - 7) == ".gt.ply" &&
        (settings.with_sensors || !isScan (name)))
      files.push_back (entry.path ());
  }
  std::sort (files.begin (), files.end ());
  std::vector<floater::Truth> cases;
  for (const std::filesystem::path& file : files) {
    floater::Truth truth = floater::readTruth (file);
    if (truth.points.size () <= settings.most_points &&
        (!settings.as_discs || truth.found.isDisc ()))
      cases.push_back (std::move (truth));
  }
  return cases;
}

void
run (const Settings& settings)
{
  const std::vector<floater::Truth> cases = readCases (settings);
  if (cases.empty ())
    throw std::runtime_error (settings.folder.string () +
                              " has no such clouds with a ground truth (NAME.gt.ply)");
  std::map<std::string, Verdict> by_default;
  std::size_t clean = 0;
  for (const floater::Truth& truth : cases) {
    Verdict& verdict = by_default[truth.name];
    verdict.triangles = reconstruct (truth, {}, settings);
    verdict.flaws = judge (verdict.triangles, truth);
    clean += verdict.flaws.empty () ? 1 : 0;
    if (!verdict.flaws.empty ())
      std::cout << truth.name << ": " << verdict.flaws << '\n';
  }
  std::cout << clean << " of " << cases.size () << " clean by default\n\n"
            << "| limit | value | factor | meshes that change | become clean | no longer clean | "
               "which |\n"
            << "|---|---:|---:|---:|---:|---:|---|\n";
  for (const floater::NamedLimit& limit : floater::allLimits ())
    for (const double factor : {0.8, 1.2}) {
      if (limit.name.find (settings.only) == std::string::npos)
        continue;
      floater::Limits limits;
      limit.scale (limits, factor);
      std::size_t changed = 0, better = 0, worse = 0;
      std::string which;
      for (const floater::Truth& truth : cases) {
        const Verdict& before = by_default.at (truth.name);
        const std::vector<floater::Triangle> triangles = reconstruct (truth, limits, settings);
        if (triangles == before.triangles)
          continue;
        ++changed;
        const std::string flaws = judge (triangles, truth);
        if (flaws.empty () == before.flaws.empty ())
          continue;
        ++(flaws.empty () ? better : worse);
        which +=
            (which.empty () ? "" : "; ") + truth.name + (flaws.empty () ? "" : " (" + flaws + ")");
      }
      std::cout << "| " << limit.name << " | " << limit.value ({}) << " | " << factor << " | "
                << changed << " | " << better << " | " << worse << " | " << which << " |"
                << std::endl; // a row takes seconds
    }
}

} // namespace

int
main (int argc, char** argv)
{
  CLI::App app ("Reconstructs all clouds of a folder that have a ground truth, NAME.gt.ply, by "
                "default limits "
                "and with each limit at 80 % and at 120 %; prints what changes.");
  Settings settings;
  app.add_option ("folder", settings.folder, "folder with NAME.gt.ply")
      ->required ()
      ->check (CLI::ExistingDirectory);
  app.add_option ("--only", settings.only, "limits whose name holds this text");
  app.add_option ("--most-points", settings.most_points, "largest cloud")->capture_default_str ();
  app.add_flag ("--sensors", settings.with_sensors,
                "also clouds whose name begins with sensor_: of\nthem, clean means usable");
  app.add_flag ("--discs", settings.as_discs,
                "by the disc method, and only clouds whose true mesh is a disc");
  app.add_option ("-j,--threads", settings.threads, "threads; 0: all cores")
      ->capture_default_str ();
  CLI11_PARSE (app, argc, argv);
  try {
    run (settings);
  }
  catch (const std::exception& error) {
    std::cerr << "pcl_floater_limits: " << error.what () << '\n';
    return 1;
  }
  return 0;
}
