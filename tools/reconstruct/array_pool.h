// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Large arrays whose memory is used again.
#pragma once

#include <cstddef>

namespace pcl::floater {
/// Arrays in a pool begin at multiples of this, a page of most systems. Pointers of malloc rarely
/// are such multiples, so that operator delete hardly ever looks for one of these in a pool.
constexpr std::size_t POOL_ALIGNMENT = 4096;

/// Bytes of a huge page, of the processors that have such pages.
constexpr std::size_t HUGE_PAGE = std::size_t{1} << 21U;

/// As long as this lives, large arrays (see LARGE_ARRAY) are made in ranges of addresses if they
/// fit there, and not in files of their own. This bounds the memory of all arrays, gaps included.
/// Memory of arrays that are freed stays in the pool for the next ones, until the pool ends. Arrays
/// may outlive it; their memory goes when all of their range are freed. There may be one pool at a
/// time, for all threads. Where the system has no such addresses, no array is in it.
class ArrayPool
{
public:
  /// \param in_memory bytes of the pool that always stay in memory
  /// \param in_file bytes behind these, in a scratch file if there is a folder for that. Its pages
  /// stay in memory until an array does not fit; then they may be dropped as those of all others,
  /// and new arrays are in files of their own
  explicit ArrayPool (std::size_t in_memory, std::size_t in_file = 0);
  ~ArrayPool ();
  ArrayPool (const ArrayPool&) = delete;
  ArrayPool& operator= (const ArrayPool&) = delete;
  ArrayPool (ArrayPool&&) = delete;
  ArrayPool& operator= (ArrayPool&&) = delete;
};

/// Bytes of all memory of this machine, for a pool without a limit.
std::size_t
memoryOfMachine ();

/// Whether there is a pool into which all large arrays have fit since it was made, and there were
/// no others in files before. Then memory cannot grow beyond that, and nothing need be dropped.
bool
areAllInPool ();

/// Makes an array in the pool. For operator new.
/// \return nullptr if it does not fit, or there is no pool
void*
makeInPool (std::size_t size);

/// Frees an array of the pool. For operator delete.
/// \return false if it is not in the pool
bool
freeInPool (void* pointer);

} // namespace pcl::floater
