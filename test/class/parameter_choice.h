// SPDX-License-Identifier: GPL-3.0-or-later
// A parameter of FloaterReconstruction and one of its values, for tests that go over many of them.
#pragma once

#include "mesh_check.h"

#include <functional>
#include <string>

namespace pcl
{
namespace floater
{
/// A setter given a value, and whether the getter returns that value.
struct Choice
{
  std::string name;
  std::function<void (Floater&)> set;
  std::function<bool (const Floater&)> is_set;
};

#define CHOICE(parameter, value)                                                                   \
  Choice                                                                                           \
  {                                                                                                \
#parameter " " #value, [] (Floater& floater) { floater.set##parameter (value); },              \
        [] (const Floater& floater) { return floater.get##parameter () == (value); }   \
  }

} // namespace floater
} // namespace pcl
