// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace pcl::floater {
/// A file cannot be used as input. The message names the cause, not the file.
class ReadError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

} // namespace pcl::floater
