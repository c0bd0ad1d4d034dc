// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The machine that the figures are of.
#pragma once

#include <string>

namespace pcl
{
namespace floater
{
/// Name of the processor according to /proc; empty where there is no such file.
std::string
processorName ();

} // namespace floater
} // namespace pcl
