// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Large arrays whose memory is used again.
#pragma once

#include <cstddef>

namespace pcl
{
namespace floater
{
/// Arrays in a pool begin at multiples of this, a page of most systems. Pointers of malloc rarely
/// are such multiples, so that operator delete hardly ever looks for one of these in a pool.
constexpr std::size_t POOL_ALIGNMENT = 4096;

/// As long as this lives, large arrays (see LARGE_ARRAY) are made in one range of addresses if they
/// fit there, and not in scratch files. So their sum is bounded, with all gaps between them. Memory
/// of arrays that are freed stays in the pool for the next ones, until the pool ends. Arrays may
/// outlive it; their memory goes when they are freed. There may be one pool at a time, for all
/// threads. Where the system has no such addresses, no array is in it.
class ArrayPool
{
public:
  /// \param most bytes of the pool
  /// \param beside_files the same as soon as one array has not fit: it and others are in scratch
  /// files then, and their pages need room
  explicit ArrayPool (std::size_t most, std::size_t beside_files = 0);
  ~ArrayPool ();
  ArrayPool (const ArrayPool&) = delete;
  ArrayPool& operator= (const ArrayPool&) = delete;
  ArrayPool (ArrayPool&&) = delete;
  ArrayPool& operator= (ArrayPool&&) = delete;
};

/// Bytes of all memory of this machine, for a pool without a limit.
std::size_t
memoryOfMachine ();

/// Whether there is a pool and all large arrays have fit into it. Else memory may fill fast.
bool
areAllInPool ();

/// Makes an array in the pool. For operator new. \return nullptr if it does not fit, or there is no
/// pool
void*
makeInPool (std::size_t size);

/// Frees an array of the pool. For operator delete. \return false if it is not in the pool
bool
freeInPool (void* pointer);

} // namespace floater
} // namespace pcl
