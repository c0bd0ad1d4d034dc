// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A parameter of FloaterReconstruction and one of its values, for tests that go over many of them.
#pragma once

#include "mesh_check.h"

#include <functional>
#include <string>

namespace pcl::floater {
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

/// The same for a field of the options that only a disc takes.
#define DISC_CHOICE(field, new_value)                                                              \
  Choice                                                                                           \
  {                                                                                                \
    "disc " #field " " #new_value,                                                                 \
        [] (Floater& floater) {                                                                    \
          DiscOptions options = floater.getDiscOptions ();                                         \
          options.field = new_value;                                                               \
          floater.setDiscOptions (options);                                                        \
        },                                                                                         \
        [] (const Floater& floater) { return floater.getDiscOptions ().field == new_value; }       \
  }

} // namespace pcl::floater
