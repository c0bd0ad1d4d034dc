// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How memory is allocated while blocks are worked on.
#pragma once

#include "array_pool.h"
#include "memory_limit.h"

#ifdef __GLIBC__
#include <malloc.h>

#include <climits>
#endif

namespace pcl::floater {
/// Makes all threads allocate from one heap. To be called before there are any.
inline void
useOneHeap ()
{
#ifdef __GLIBC__
  mallopt (M_ARENA_MAX, 1);
#endif
}

/// As long as this lives, memory that is freed stays with the process, for the next array or block.
/// The steps of a block make and free many arrays of some megabytes; if the system took each back,
/// a tenth of the time would go by until it has given cleared pages again. The price is a fifth
/// more memory. So the steps of the whole cloud, which need the most, do without.
class HeapReuse
{
public:
  /// \param limit that must not be exceeded; nullptr: there is none
  explicit HeapReuse (const MemoryLimit* limit)
      : pool_ (limit == nullptr ? memoryOfMachine () : limit->residentSet ().poolInMemory (),
               limit == nullptr ? 0 : limit->residentSet ().poolInFile ())
  {
#ifdef __GLIBC__
    mallopt (M_MMAP_MAX, 0);
    mallopt (M_TRIM_THRESHOLD, INT_MAX);
#endif
  }
  ~HeapReuse ()
  {
#ifdef __GLIBC__
    constexpr int USUAL_MAPS = 65536, USUAL_TRIM = 128 * 1024; // of the C library
    mallopt (M_MMAP_MAX, USUAL_MAPS);
    mallopt (M_TRIM_THRESHOLD, USUAL_TRIM);
    malloc_trim (0);
#endif
  }
  HeapReuse (const HeapReuse&) = delete;
  HeapReuse& operator= (const HeapReuse&) = delete;
  HeapReuse (HeapReuse&&) = delete;
  HeapReuse& operator= (HeapReuse&&) = delete;

private:
  ArrayPool pool_; // of large arrays; the rest is in the heap
};

} // namespace pcl::floater
