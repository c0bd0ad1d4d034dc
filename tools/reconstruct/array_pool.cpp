// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Each array is at the first gap into which it fits, so that the memory in use stays together at
// the begin of the range. There are some hundred arrays at most: each has a megabyte or more.
#include "array_pool.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <new>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t HUGE_PAGE = std::size_t{1} << 21U; // of the processors that have such pages

std::size_t
roundedUp (std::size_t bytes, std::size_t unit)
{
  return (bytes + unit - 1) / unit * unit;
}

class Pool
{
public:
  void open (std::size_t most, std::size_t beside_files)
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    most = most / POOL_ALIGNMENT * POOL_ALIGNMENT;
    if (arrays_.empty () && most != last_ - first_) {
      unmap ();
      map (most);
    }
    capacity_ = std::min<std::size_t> (most, last_ - first_);
    beside_files_ = std::min (beside_files / POOL_ALIGNMENT * POOL_ALIGNMENT, capacity_);
    is_open_ = capacity_ > 0;
    have_all_fit_ = capacity_ > 0;
  }

  void close ()
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    is_open_ = false;
    have_all_fit_ = false;
    shrink (0);
  }

  bool haveAllFit () const { return have_all_fit_; }

  void* make (std::size_t size)
  {
    if (!is_open_ || size > PTRDIFF_MAX - POOL_ALIGNMENT)
      return nullptr;
    const std::size_t bytes = roundedUp (size, POOL_ALIGNMENT);
    const std::lock_guard<std::mutex> lock (mutex_);
    if (!is_open_) // meanwhile
      return nullptr;
    std::uintptr_t begin = first_;
    for (const auto& [array, end] : arrays_) {
      if (array - begin >= bytes)
        break;
      begin = end;
    }
    if (first_ + capacity_ < begin || first_ + capacity_ - begin < bytes) {
      have_all_fit_ = false;
      shrink (beside_files_);
      return nullptr;
    }
    try {
      arrays_.emplace (begin, begin + bytes);
    }
    catch (const std::bad_alloc&) {
      return nullptr;
    }
    return reinterpret_cast<void*> (begin);
  }

  bool free (void* pointer)
  {
    const auto begin = reinterpret_cast<std::uintptr_t> (pointer);
    if (begin < first_ || begin >= last_)
      return false;
    const std::lock_guard<std::mutex> lock (mutex_);
    const auto array = arrays_.find (begin);
    if (array == arrays_.end ())
      return false;
    const std::uintptr_t end = array->second;
    arrays_.erase (array);
    giveBack (begin, end);
    if (arrays_.empty () && !is_open_)
      unmap ();
    return true;
  }

private:
  // All of these are called with the lock.
  void map (std::size_t bytes)
  {
    // As many as there are, if the user has limited them.
    for (; bytes >= HUGE_PAGE; bytes /= 2) {
      void* all = ::mmap (nullptr, bytes, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
      if (all == MAP_FAILED)
        continue;
#ifdef MADV_HUGEPAGE
      ::madvise (all, bytes, MADV_HUGEPAGE);
#endif
      first_ = reinterpret_cast<std::uintptr_t> (all);
      last_ = first_ + bytes / POOL_ALIGNMENT * POOL_ALIGNMENT;
      return;
    }
  }

  void unmap ()
  {
    if (last_ > first_)
      ::munmap (reinterpret_cast<void*> (first_.load ()), last_ - first_);
    last_ = 0;
    first_ = 0;
  }

  // Lowers the capacity. What is free above goes back to the system.
  void shrink (std::size_t capacity)
  {
    capacity_ = std::min (capacity_, capacity);
    if (arrays_.empty () && !is_open_)
      return unmap ();
    std::uintptr_t begin = first_;
    for (const auto& [array, end] : arrays_) {
      giveBack (begin, array);
      begin = end;
    }
    giveBack (begin, last_);
  }

  // Gives memory that is free back to the system, if it is above the capacity.
  void giveBack (std::uintptr_t begin, std::uintptr_t end) const
  {
    begin = std::max<std::uintptr_t> (begin, first_ + capacity_);
    if (begin < end)
      ::madvise (reinterpret_cast<void*> (begin), end - begin, MADV_DONTNEED);
  }

  std::mutex mutex_;                               // guards what is no atomic, and all changes
  std::atomic<std::uintptr_t> first_{0}, last_{0}; // addresses; both 0: there are none
  std::size_t capacity_ = 0, beside_files_ = 0;    // bytes
  std::atomic<bool> is_open_{false}, have_all_fit_{false};
  std::map<std::uintptr_t, std::uintptr_t> arrays_; // from the begin of each to its end
};

// Never destroyed, because arrays may be freed until the process ends.
Pool&
pool ()
{
  static Pool& one = *new Pool;
  return one;
}

} // namespace

ArrayPool::ArrayPool (std::size_t most, std::size_t beside_files)
{
  pool ().open (most, beside_files);
}

ArrayPool::~ArrayPool ()
{
  pool ().close ();
}

std::size_t
memoryOfMachine ()
{
  const long pages = ::sysconf (_SC_PHYS_PAGES), bytes = ::sysconf (_SC_PAGESIZE);
  return pages > 0 && bytes > 0
             ? static_cast<std::size_t> (pages) * static_cast<std::size_t> (bytes)
             : 0;
}

bool
areAllInPool ()
{
  return pool ().haveAllFit ();
}

void*
makeInPool (std::size_t size)
{
  return pool ().make (size);
}

bool
freeInPool (void* pointer)
{
  return pool ().free (pointer);
}

} // namespace floater
} // namespace pcl
