// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds of rows of other clouds, with more fields.
#pragma once

#include "cloud.h"

#include <cstring>
#include <string>
#include <vector>

namespace pcl::floater {
/// A cloud of some rows of another one, in any order, each as often as it is named; all of them are
/// kept. Coordinates, shift and all fields are copied. O(rows).
/// \param added fields of one value that come after those of the cloud; setValues gives them their
/// values. A field of the cloud that has the name of one of them is left out
Cloud
copyRows (const Cloud& cloud, const std::vector<std::size_t>& rows,
          const std::vector<Field>& added);

/// Sets the values of a field that copyRows has added. \tparam T the C++ type of the field
template <typename T>
void
setValues (Cloud& copied, const std::string& name, const std::vector<T>& values)
{
  const Field& field = *copied.find (name);
  auto* bytes = const_cast<char*> (field.first.get ()); // copyRows has allocated them
  for (std::size_t i = 0; i < values.size (); ++i)
    std::memcpy (bytes + i * field.stride, &values[i], sizeof (T));
}

} // namespace pcl::floater
