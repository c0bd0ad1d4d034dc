// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Each array is at the first gap into which it fits, so that the memory in use stays together at
// the begin of a range. There are some hundred arrays at most: each has a megabyte or more.
#include "array_pool.h"

#include "large_arrays.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <new>

namespace pcl::floater {
namespace {
std::size_t
roundedUp (std::size_t bytes)
{
  return (bytes + POOL_ALIGNMENT - 1) / POOL_ALIGNMENT * POOL_ALIGNMENT;
}

char*
pointerTo (std::uintptr_t address)
{
  return reinterpret_cast<char*> (address);
}

/// Addresses with arrays. All but has () is called with a lock.
class Range
{
public:
  explicit Range (bool is_in_file) : is_in_file_ (is_in_file) {}

  bool has (std::uintptr_t address) const { return address >= first_ && address < last_; }
  bool isEmpty () const { return arrays_.empty (); }

  /// Reserves addresses. There are less, or none, if the system has no more.
  void map (std::size_t bytes)
  {
    if (bytes == last_ - first_)
      return;
    unmap ();
    for (bytes = bytes / POOL_ALIGNMENT * POOL_ALIGNMENT; bytes >= HUGE_PAGE; bytes /= 2) {
      void* all = is_in_file_ ? mapLargeArray (bytes)
                              : ::mmap (nullptr, bytes, PROT_READ | PROT_WRITE,
                                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
      if (all == nullptr || all == MAP_FAILED)
        continue;
#ifdef MADV_HUGEPAGE
      if (!is_in_file_)
        ::madvise (all, bytes, MADV_HUGEPAGE);
#endif
      first_ = reinterpret_cast<std::uintptr_t> (all);
      last_ = first_ + bytes / POOL_ALIGNMENT * POOL_ALIGNMENT;
      return;
    }
  }

  void unmap ()
  {
    const std::uintptr_t first = first_, last = last_;
    last_ = 0;
    first_ = 0;
    if (last > first && is_in_file_)
      unmapLargeArray (pointerTo (first));
    else if (last > first)
      ::munmap (pointerTo (first), last - first);
  }

  /// \return nullptr if it does not fit; may throw std::bad_alloc
  void* make (std::size_t bytes)
  {
    std::uintptr_t begin = first_;
    for (const auto& [array, end] : arrays_) {
      if (array - begin >= bytes)
        break;
      begin = end;
    }
    if (last_ - begin < bytes)
      return nullptr;
    arrays_.emplace (begin, begin + bytes);
    return pointerTo (begin);
  }

  bool free (std::uintptr_t begin)
  {
    return arrays_.erase (begin) > 0;
  }

  /// Gives what is free back to the system.
  void giveBack () const
  {
    std::uintptr_t begin = first_;
    for (const auto& [array, end] : arrays_) {
      giveBack (begin, array);
      begin = end;
    }
    giveBack (begin, last_);
  }

private:
  static void giveBack (std::uintptr_t begin, std::uintptr_t end)
  {
    if (begin < end)
      ::madvise (pointerTo (begin), end - begin, MADV_DONTNEED);
  }

  bool is_in_file_;
  std::atomic<std::uintptr_t> first_{0}, last_{0};  // both 0: there are no addresses
  std::map<std::uintptr_t, std::uintptr_t> arrays_; // from the begin of each to its end
};

class Pool
{
public:
  void open (std::size_t in_memory, std::size_t in_file)
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    if (in_memory_.isEmpty ())
      in_memory_.map (in_memory);
    if (in_file_.isEmpty ())
      in_file_.unmap ();
    have_all_fit_ = scratchUse ().bytes == 0;
    if (in_file_.isEmpty () && hasScratchFolder ())
      in_file_.map (in_file);
    is_open_ = true;
  }

  void close ()
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    is_open_ = false;
    have_all_fit_ = false;
    for (Range* range : {&in_memory_, &in_file_})
      if (range->isEmpty ())
        range->unmap ();
      else
        range->giveBack ();
  }

  bool haveAllFit () const { return have_all_fit_; }

  void* make (std::size_t size)
  {
    if (!is_open_ || size > PTRDIFF_MAX - POOL_ALIGNMENT)
      return nullptr;
    try {
      const std::lock_guard<std::mutex> lock (mutex_);
      if (!is_open_) // any more
        return nullptr;
      if (void* array = in_memory_.make (roundedUp (size)))
        return array;
      // As soon as one has not fit, others are in files of their own: for each of them, the thread
      // that makes it makes room.
      if (have_all_fit_)
        if (void* array = in_file_.make (roundedUp (size)))
          return array;
    }
    catch (const std::bad_alloc&) {
      // There is no memory for the entry: it fits no more than a large array.
    }
    have_all_fit_ = false;
    return nullptr;
  }

  bool free (void* pointer)
  {
    const auto begin = reinterpret_cast<std::uintptr_t> (pointer);
    for (Range* range : {&in_memory_, &in_file_})
      if (range->has (begin)) {
        const std::lock_guard<std::mutex> lock (mutex_);
        if (!range->free (begin))
          continue;
        if (range->isEmpty () && !is_open_)
          range->unmap ();
        return true;
      }
    return false;
  }

private:
  std::mutex mutex_; // guards the ranges
  Range in_memory_{false}, in_file_{true};
  std::atomic<bool> is_open_{false}, have_all_fit_{false};
};

// Never destroyed, because arrays may be freed until the process ends.
Pool&
pool ()
{
  static Pool& one = *new Pool;
  return one;
}

} // namespace

ArrayPool::ArrayPool (std::size_t in_memory, std::size_t in_file)
{
  pool ().open (in_memory, in_file);
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

} // namespace pcl::floater
