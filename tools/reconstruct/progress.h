// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A status line on the terminal.
#pragma once

#include <pcl/surface/floater/options.h>

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace pcl::floater {
/// What a stage does, for people.
inline const char*
stageWords (Stage stage)
{
  constexpr std::array<const char*, static_cast<std::size_t> (Stage::COUNT)> WORDS{
      "sorting points",
      "searching neighbours",
      "fitting planes",
      "connecting points",
      "finding the boundary",
      "weighting neighbours",
      "solving the linear system",
      "triangulating",
      "filling holes",
      "repairing the mesh",
      "checking the mesh"};
  return WORDS[static_cast<std::size_t> (stage)];
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
