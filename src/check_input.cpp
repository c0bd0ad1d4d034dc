// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_input.h"

#include "core/types.h"

#include <algorithm>
#include <functional>

namespace pcl
{
namespace floater
{
Problem
checkInput (const Input& input)
{
  const std::vector<Index>& indices = input.cloud_index;
  const auto refused = [] (const std::string& why) {
    return Problem{RunStatus::INVALID_INDICES, why};
  };
  if (indices.size () != input.positions.size ())
    return refused ("there are " + std::to_string (input.positions.size ()) + " positions but " +
                    std::to_string (indices.size ()) + " cloud indices; give one for each");
  if (!input.normals.empty () && input.normals.size () != input.cloud_size)
    return refused ("there are " + std::to_string (input.normals.size ()) +
                    " normals, but the whole cloud has " + std::to_string (input.cloud_size) +
                    " points; give one for each, or none");
  if (indices.empty ())
    return {};
  const Index largest = *std::max_element (indices.begin (), indices.end ());
  if (largest >= input.cloud_size)
    return refused ("cloud index " + std::to_string (largest) + " is outside the cloud of size " +
                    std::to_string (input.cloud_size));
  if (std::is_sorted (indices.begin (), indices.end (), std::less_equal<> ()))
    return {}; // each is larger than the one before
  std::vector<bool> is_taken (largest + std::size_t{1}, false);
  for (const Index index : indices) {
    if (is_taken[index])
      return refused ("cloud index " + std::to_string (index) + " is given twice");
    is_taken[index] = true;
  }
  return {};
}

} // namespace floater
} // namespace pcl
