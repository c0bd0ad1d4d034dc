// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A status line on the terminal.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

namespace pcl
{
namespace floater
{
/// Shows the current step on the standard error stream if that is a terminal. The line is erased at
/// the end.
class Progress
{
public:
  explicit Progress (bool wanted) : is_shown_ (wanted && ::isatty (STDERR_FILENO) == 1) {}
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
  bool is_shown_;
  std::string shown_;
};

} // namespace floater
} // namespace pcl
