// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Memory that runs out when a test wants it to. A program that links this gets malloc and its kin
// replaced, and with them operator new and what C libraries allocate. For glibc, and not together
// with a sanitizer, which replaces them itself.
#pragma once

#include <cstddef>

namespace pcl::floater::fuzz {
/// What fails of the allocations that a thread makes after failAllocations ().
enum class MemoryFault
{
  NONE, ///< none; they are counted
  ONE,  ///< a single one
  ALL   ///< that one and all later ones
};

/// Begins to count the allocations of this thread.
/// \param n the one that fails, from 0
void
failAllocations (MemoryFault fault, std::size_t n);

/// Ends it.
/// \return how many there were, with those that failed
std::size_t
stopFailing ();

/// Blocks of the whole process that are allocated now.
long
liveBlocks ();

} // namespace pcl::floater::fuzz
