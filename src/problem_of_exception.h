// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What an exception means to the user.
#pragma once

#include "core/problem.h"

namespace pcl::floater {
/// A message so short that a string takes no memory for it.
constexpr const char* NO_MEMORY = "out of memory";

/// What the exception that is being handled means. To be called in a handler. OUT_OF_MEMORY and
/// NO_MEMORY if there is no memory for the message.
Problem
problemOfException () noexcept;

} // namespace pcl::floater
