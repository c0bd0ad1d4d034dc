// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of tables with 32-bit indices.
#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace pcl::floater {
/// A table would exceed its index type. The message names the table and a remedy. The run ends with
/// RunStatus::OUT_OF_MEMORY.
class IndexLimitReached : public std::length_error
{
public:
  using std::length_error::length_error;
};

/// Largest number of matrix entries in libraries with indices of type int.
constexpr std::size_t MOST_MATRIX_ENTRIES = std::numeric_limits<int>::max ();

/// \param what remedy, for the message
/// \throws IndexLimitReached if there are more than `most` entries
inline void
requireCountable (std::size_t entries, std::size_t most, const char* table, const char* what)
{
  if (entries > most)
    throw IndexLimitReached (std::string (table) + " would have " + std::to_string (entries) +
                             " entries, more than the " + std::to_string (most) +
                             " that 32-bit indices can count: " + what);
}

} // namespace pcl::floater
