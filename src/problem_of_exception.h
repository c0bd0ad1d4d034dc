// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The problem that an exception reports.
#pragma once

#include "core/problem.h"

namespace pcl::floater {
/// Short enough that a string does not allocate memory for it.
constexpr const char* NO_MEMORY = "out of memory";

/// The problem of the exception that is being handled. To be called in a handler. OUT_OF_MEMORY and
/// NO_MEMORY if there is no memory for the message.
Problem
problemOfException () noexcept;

} // namespace pcl::floater
