// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Error of a stage, and the errors of exceptions.
#pragma once

#include <pcl/surface/floater/report.h>

#include <string>

namespace pcl::floater {
/// Status and one sentence for the user; RunStatus::SUCCESS: no problem. If an option is out of
/// range, the sentence begins with its name, which is also in \a option.
struct Problem
{
  RunStatus status = RunStatus::SUCCESS;
  std::string message;
  std::string option = {};

  explicit operator bool () const { return status != RunStatus::SUCCESS; }
};

/// The problem of the exception that is being handled. To be called in a handler. OUT_OF_MEMORY if
/// there is no memory for the message.
Problem
problemOfException () noexcept;

} // namespace pcl::floater
