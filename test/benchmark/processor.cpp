// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "processor.h"

#include <fstream>

namespace pcl
{
namespace floater
{
std::string
processorName ()
{
  std::ifstream file ("/proc/cpuinfo");
  for (std::string line; std::getline (file, line);)
    if (line.rfind ("model name", 0) == 0)
      return line.substr (line.find (':') + 2);
  return {};
}

} // namespace floater
} // namespace pcl
