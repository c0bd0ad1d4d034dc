// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Operators new and delete that put large arrays into a pool as long as there is one, and into
// scratch files once there is a scratch folder.
#include "array_pool.h"
#include "large_arrays.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace pcl::floater {
namespace {
// Whole huge pages of an array come into memory at once, in a fraction of the time of all their
// small pages. Of other arrays, and where the system has none, this changes nothing.
void*
inHugePages (void* array, std::size_t size) noexcept
{
#ifdef MADV_HUGEPAGE
  const auto begin = reinterpret_cast<std::uintptr_t> (array);
  const std::uintptr_t first = (begin + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
  const std::uintptr_t last = (begin + size) / HUGE_PAGE * HUGE_PAGE;
  if (array != nullptr && first < last)
    ::madvise (reinterpret_cast<void*> (first), last - first, MADV_HUGEPAGE);
#endif
  return array;
}

void*
allocate (std::size_t size, std::size_t alignment) noexcept
{
  if (size >= LARGE_ARRAY && alignment <= POOL_ALIGNMENT)
    if (void* pointer = makeInPool (size))
      return pointer;
  if (size >= LARGE_ARRAY && alignment <= LARGE_ARRAY_ALIGNMENT && hasScratchFolder ())
    return mapLargeArray (size);
  if (alignment <= alignof (std::max_align_t))
    return inHugePages (std::malloc (std::max<std::size_t> (size, 1)), size);
  return std::aligned_alloc (alignment, (size + alignment - 1) / alignment * alignment);
}

void*
allocateOrThrow (std::size_t size, std::size_t alignment = alignof (std::max_align_t))
{
  for (;;) {
    if (void* pointer = allocate (size, alignment))
      return pointer;
    const std::new_handler handler = std::get_new_handler ();
    if (handler == nullptr)
      throw std::bad_alloc ();
    handler ();
  }
}

void*
allocateOrNull (std::size_t size, std::size_t alignment = alignof (std::max_align_t)) noexcept
{
  try {
    return allocateOrThrow (size, alignment);
  }
  catch (...) {
    return nullptr;
  }
}

void
release (void* pointer) noexcept
{
  const auto address = reinterpret_cast<std::uintptr_t> (pointer);
  if (address % POOL_ALIGNMENT == 0 && address != 0) {
    if (freeInPool (pointer))
      return;
    if (address % LARGE_ARRAY_ALIGNMENT == 0 && hasScratchFolder () && unmapLargeArray (pointer))
      return;
  }
  std::free (pointer);
}

} // namespace
} // namespace pcl::floater

// All forms are replaced, because the runtime of a sanitizer brings its own version of each.
void*
operator new (std::size_t size)
{
  return pcl::floater::allocateOrThrow (size);
}
void*
operator new[] (std::size_t size)
{
  return pcl::floater::allocateOrThrow (size);
}
void*
operator new (std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
  return pcl::floater::allocateOrNull (size);
}
void*
operator new[] (std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
  return pcl::floater::allocateOrNull (size);
}
void*
operator new (std::size_t size, std::align_val_t alignment)
{
  return pcl::floater::allocateOrThrow (size, static_cast<std::size_t> (alignment));
}
void*
operator new[] (std::size_t size, std::align_val_t alignment)
{
  return pcl::floater::allocateOrThrow (size, static_cast<std::size_t> (alignment));
}
void*
operator new (std::size_t size, std::align_val_t alignment, const std::nothrow_t& /*tag*/) noexcept
{
  return pcl::floater::allocateOrNull (size, static_cast<std::size_t> (alignment));
}
void*
operator new[] (std::size_t size, std::align_val_t alignment,
                const std::nothrow_t& /*tag*/) noexcept
{
  return pcl::floater::allocateOrNull (size, static_cast<std::size_t> (alignment));
}

void
operator delete (void* pointer) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete[] (void* pointer) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete (void* pointer, std::size_t /*size*/) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete[] (void* pointer, std::size_t /*size*/) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete (void* pointer, const std::nothrow_t& /*tag*/) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete[] (void* pointer, const std::nothrow_t& /*tag*/) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete (void* pointer, std::align_val_t /*alignment*/) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete[] (void* pointer, std::align_val_t /*alignment*/) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete (void* pointer, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete[] (void* pointer, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete (void* pointer, std::align_val_t /*alignment*/,
                 const std::nothrow_t& /*tag*/) noexcept
{
  pcl::floater::release (pointer);
}
void
operator delete[] (void* pointer, std::align_val_t /*alignment*/,
                   const std::nothrow_t& /*tag*/) noexcept
{
  pcl::floater::release (pointer);
}
