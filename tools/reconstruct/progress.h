// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A status line on the terminal.
#pragma once

#include <pcl/surface/floater/options.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace pcl::floater {
/// What a stage does, for people.
inline const char*
stageWords (Stage stage)
{
  switch (stage) {
  case Stage::WORKING_SET:
    return "sorting points";
  case Stage::NEIGHBORS:
    return "searching neighbours";
  case Stage::STARS:
    return "fitting planes";
  case Stage::CONSENSUS:
    return "connecting points";
  case Stage::BOUNDARY:
    return "finding the boundary";
  case Stage::WEIGHTS:
    return "weighting neighbours";
  case Stage::SOLVE:
    return "solving the linear system";
  case Stage::DELAUNAY:
    return "triangulating";
  case Stage::HOLES:
    return "filling holes";
  case Stage::FLIPS:
    return "repairing the mesh";
  case Stage::CHECK:
    return "checking the mesh";
  case Stage::COUNT:
    break;
  }
  return "working";
}

/// Shows the current step on the standard error stream if that is a terminal that can erase a line.
/// The line is erased at the end.
class Progress
{
public:
  explicit Progress (bool wanted)
      : is_shown_ (wanted && ::isatty (STDERR_FILENO) == 1 && canErase (std::getenv ("TERM")))
  {
  }
  ~Progress () { clear (); }
  Progress (const Progress&) = delete;
  Progress& operator= (const Progress&) = delete;
  Progress (Progress&&) = delete;
  Progress& operator= (Progress&&) = delete;

  void show (const std::string& step)
  {
    if (is_shown_ && step != shown_) {
      std::fprintf (stderr, "\r\033[K%s ...", step.c_str ());
      std::fflush (stderr);
      shown_ = step;
    }
  }

  void clear ()
  {
    if (is_shown_ && !shown_.empty ()) {
      std::fputs ("\r\033[K", stderr);
      std::fflush (stderr);
      shown_.clear ();
    }
  }

private:
  static bool canErase (const char* terminal)
  {
    return terminal != nullptr && *terminal != '\0' && std::string (terminal) != "dumb";
  }

  bool is_shown_;
  std::string shown_;
};

} // namespace pcl::floater
