// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// All limits of the stages by name.
#pragma once

#include "stage_limits.h"

#include <functional>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// A limit that can be made larger or smaller.
struct NamedLimit
{
  std::string name; ///< as in the code: "outliers.far"
  /// Multiplies it. A count is rounded, and changes by one at least; it does not fall below 1.
  std::function<void (Limits&, double factor)> scale;
  std::function<double (const Limits&)> value;
};

std::vector<NamedLimit>
allLimits ();

} // namespace floater
} // namespace pcl
