// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "failing_malloc.h"

#include <atomic>
#include <cerrno>
#include <cstdlib>

// The functions of glibc under the names that stay when they are replaced.
extern "C" {
void*
__libc_malloc (std::size_t size);
void*
__libc_calloc (std::size_t count, std::size_t size);
void*
__libc_realloc (void* block, std::size_t size);
void*
__libc_memalign (std::size_t alignment, std::size_t size);
void
__libc_free (void* block);
}

namespace pcl::floater::fuzz {
namespace {
// No constructor and no allocation: they are used before main ().
thread_local bool is_counting = false;
thread_local MemoryFault fault = MemoryFault::NONE;
thread_local std::size_t failing = 0, count = 0;
std::atomic<long> live{0};

bool
isToFail ()
{
  if (!is_counting)
    return false;
  const std::size_t n = count++;
  if (fault == MemoryFault::NONE || n < failing || (fault == MemoryFault::ONE && n > failing))
    return false;
  errno = ENOMEM;
  return true;
}

void*
counted (void* block)
{
  if (block != nullptr)
    live.fetch_add (1, std::memory_order_relaxed);
  return block;
}

} // namespace

void
failAllocations (MemoryFault what, std::size_t n)
{
  fault = what;
  failing = n;
  count = 0;
  is_counting = true;
}

std::size_t
stopFailing ()
{
  is_counting = false;
  return count;
}

long
liveBlocks ()
{
  return live;
}

} // namespace pcl::floater::fuzz

using pcl::floater::fuzz::counted;
using pcl::floater::fuzz::isToFail;

extern "C" {
void*
malloc (std::size_t size)
{
  return isToFail () ? nullptr : counted (__libc_malloc (size));
}

void*
calloc (std::size_t count, std::size_t size)
{
  return isToFail () ? nullptr : counted (__libc_calloc (count, size));
}

void*
realloc (void* block, std::size_t size)
{
  if (isToFail ())
    return nullptr;
  void* const moved = __libc_realloc (block, size);
  return block == nullptr ? counted (moved) : moved;
}

void*
memalign (std::size_t alignment, std::size_t size)
{
  return isToFail () ? nullptr : counted (__libc_memalign (alignment, size));
}

void*
aligned_alloc (std::size_t alignment, std::size_t size)
{
  return memalign (alignment, size);
}

int
posix_memalign (void** block, std::size_t alignment, std::size_t size)
{
  *block = memalign (alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

void
free (void* block)
{
  if (block != nullptr)
    pcl::floater::fuzz::live.fetch_sub (1, std::memory_order_relaxed);
  __libc_free (block);
}
}
