// SPDX-License-Identifier: GPL-3.0-or-later
// One file for each array, with all its room reserved when it is made: freeing the array frees the
// file, no page of it can lack a block when it is written (which would be SIGBUS), and a descriptor
// is open only while it is mapped.
#include "large_arrays.h"

#include "atomic_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <mutex>
#include <new>
#include <system_error>

namespace pcl
{
namespace floater
{
namespace
{
// Addresses of arrays in files are multiples of this. Such a pointer is hardly ever one of
// malloc's, so that all others are freed without a look at the table.
constexpr std::size_t ALIGNMENT = std::size_t{1} << 21U;

/// All arrays in files. Nothing may be freed under the lock of the table, for that may lead to the
/// table again; allocating its nodes is harmless, they are small.
struct ScratchArrays
{
  std::mutex mutex;                         // of the next three
  std::map<std::uintptr_t, std::size_t> at; // bytes by address
  std::uintptr_t hand = 0;                  // dropNextPiece goes on here
  ScratchUse use;

  std::string folder;                          // set once, like the next
  std::function<void (std::size_t)> make_room; // before an array of so many bytes

  std::mutex failure_mutex;
  std::string failure;
};

// Never destroyed: arrays may be freed until the very end.
ScratchArrays&
scratchArrays ()
{
  static ScratchArrays& all = *new ScratchArrays;
  return all;
}

std::atomic<bool> has_scratch{false};

char*
pointerTo (std::uintptr_t address)
{
  return reinterpret_cast<char*> (address);
}

/// A file without a name; -1 and errno if there is none.
int
makeScratchFile (const std::string& folder)
{
#ifdef O_TMPFILE
  constexpr mode_t OWNER = 0600;
  const int file = ::open (folder.c_str (), O_TMPFILE | O_RDWR | O_EXCL | O_CLOEXEC, OWNER);
  if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL))
    return file;
#endif
  std::string name = folder + "/.pcl_floater.scratch.XXXXXX";
  const int named = ::mkostemp (name.data (), O_CLOEXEC);
  if (named >= 0)
    ::unlink (name.c_str ());
  return named;
}

/// Addresses that begin at a multiple of ALIGNMENT.
/// \return 0 if there are none
std::uintptr_t
reserveAddresses (std::size_t bytes)
{
  void* all = ::mmap (nullptr, bytes + ALIGNMENT, PROT_NONE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (all == MAP_FAILED)
    return 0;
  const auto first = reinterpret_cast<std::uintptr_t> (all);
  const std::uintptr_t begin = (first + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
  if (begin > first)
    ::munmap (all, begin - first);
  if (begin < first + ALIGNMENT)
    ::munmap (pointerTo (begin + bytes), first + ALIGNMENT - begin);
  return begin;
}

/// Maps the array there. \return 0, or the error
int
mapScratch (std::uintptr_t begin, std::size_t bytes, const std::string& folder)
{
  const int file = makeScratchFile (folder);
  if (file < 0)
    return errno;
  int error = EINTR;
  while (error == EINTR)
    error = ::posix_fallocate (file, 0, static_cast<off_t> (bytes));
  if (error == 0 && ::mmap (pointerTo (begin), bytes, PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_FIXED, file, 0) == MAP_FAILED)
    error = errno;
  ::close (file);
  return error;
}

void
describeFailure (ScratchArrays& all, std::size_t bytes, int error)
{
  const auto megabytes = [] (std::size_t count) {
    return std::to_string (count / 1'000'000) + " MB";
  };
  const std::size_t there = scratchUse ().bytes;
  const std::lock_guard<std::mutex> lock (all.failure_mutex);
  all.failure = "no room in the scratch folder '" + all.folder + "': " + std::strerror (error) +
                "; " + megabytes (there) + " are there, " + megabytes (bytes) + " more are needed" +
                (error == EFBIG ? "; raise the limit on file sizes (ulimit -f)"
                                : "; free some space or name another folder by --scratch");
}

/// \return nullptr if there is no room, which is then described
void*
mapArray (std::size_t size)
{
  constexpr std::size_t PAGE = 4096; // or a part of one
  if (size > PTRDIFF_MAX - 2 * ALIGNMENT)
    return nullptr;
  const std::size_t bytes = (size + PAGE - 1) / PAGE * PAGE;
  const std::uintptr_t begin = reserveAddresses (bytes);
  if (begin == 0)
    return nullptr;
  ScratchArrays& all = scratchArrays ();
  if (all.make_room)
    all.make_room (bytes);
  const int error = mapScratch (begin, bytes, all.folder);
  try {
    if (error == 0) {
      const std::lock_guard<std::mutex> lock (all.mutex);
      all.at.emplace (begin, bytes);
      all.use.bytes += bytes;
      all.use.peak = std::max (all.use.peak, all.use.bytes);
      return pointerTo (begin);
    }
    describeFailure (all, bytes, error);
  }
  catch (const std::bad_alloc&) {
    // No room for the entry, or for the words: it is out of memory either way.
  }
  ::munmap (pointerTo (begin), bytes);
  return nullptr;
}

/// \return false if there is no such array
bool
unmapArray (void* pointer)
{
  ScratchArrays& all = scratchArrays ();
  decltype (all.at)::node_type node; // freed without the lock
  {
    const std::lock_guard<std::mutex> lock (all.mutex);
    node = all.at.extract (reinterpret_cast<std::uintptr_t> (pointer));
    if (node.empty ())
      return false;
    all.use.bytes -= node.mapped ();
  }
  ::munmap (pointer, node.mapped ());
  return true;
}

void*
allocate (std::size_t size, std::size_t alignment) noexcept
{
  if (size >= LARGE_ARRAY && alignment <= ALIGNMENT && has_scratch)
    return mapArray (size);
  if (alignment <= alignof (std::max_align_t))
    return std::malloc (std::max<std::size_t> (size, 1));
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
  const bool may_be_mapped =
      reinterpret_cast<std::uintptr_t> (pointer) % ALIGNMENT == 0 && has_scratch;
  if (pointer == nullptr || !may_be_mapped || !unmapArray (pointer))
    std::free (pointer);
}

} // namespace

void
keepLargeArraysIn (const std::filesystem::path& scratch_folder,
                   std::function<void (std::size_t)> make_room)
{
  const int file = makeScratchFile (scratch_folder.string ());
  if (file < 0)
    throw WriteError ("cannot use the scratch folder '" + scratch_folder.string () +
                      "': " + std::strerror (errno));
  ::close (file);
  ScratchArrays& all = scratchArrays ();
  all.folder = scratch_folder.string ();
  all.make_room = std::move (make_room);
  has_scratch = true;
}

bool
liesInMemory (const std::filesystem::path& folder)
{
  constexpr std::array<unsigned long, 2> IN_MEMORY{0x01021994UL, 0x858458f6UL}; // tmpfs, ramfs
  struct statfs status = {};
  return ::statfs (folder.c_str (), &status) == 0 &&
         std::find (IN_MEMORY.begin (), IN_MEMORY.end (),
                    static_cast<unsigned long> (status.f_type)) != IN_MEMORY.end ();
}

std::size_t
dropNextPiece ()
{
  ScratchArrays& all = scratchArrays ();
  // Held throughout, so that the component is not unmapped, and its addresses taken by something else.
  const std::lock_guard<std::mutex> lock (all.mutex);
  if (all.at.empty ())
    return 0;
  auto array = all.at.upper_bound (all.hand);
  if (array != all.at.begin () && all.hand < std::prev (array)->first + std::prev (array)->second)
    --array;
  if (array == all.at.end ()) {
    array = all.at.begin ();
    all.hand = 0;
  }
  const std::uintptr_t begin = std::max (all.hand, array->first);
  const std::uintptr_t end = std::min (begin + DROPPED_PIECE, array->first + array->second);
  // Of a shared mapping of a file this drops the pages from the table only, not what they hold.
  ::madvise (pointerTo (begin), end - begin, MADV_DONTNEED);
  all.use.dropped += end - begin;
  all.hand = end;
  return end - begin;
}

ScratchUse
scratchUse ()
{
  ScratchArrays& all = scratchArrays ();
  const std::lock_guard<std::mutex> lock (all.mutex);
  return all.use;
}

std::string
largeArrayFailure ()
{
  ScratchArrays& all = scratchArrays ();
  const std::lock_guard<std::mutex> lock (all.failure_mutex);
  return all.failure;
}

} // namespace floater
} // namespace pcl

using pcl::floater::allocateOrNull;
using pcl::floater::allocateOrThrow;
using pcl::floater::release;

// All forms, for a sanitizer's runtime has its own of each, which know nothing of these.
void*
operator new (std::size_t size)
{
  return allocateOrThrow (size);
}
void*
operator new[] (std::size_t size)
{
  return allocateOrThrow (size);
}
void*
operator new (std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
  return allocateOrNull (size);
}
void*
operator new[] (std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
  return allocateOrNull (size);
}
void*
operator new (std::size_t size, std::align_val_t alignment)
{
  return allocateOrThrow (size, static_cast<std::size_t> (alignment));
}
void*
operator new[] (std::size_t size, std::align_val_t alignment)
{
  return allocateOrThrow (size, static_cast<std::size_t> (alignment));
}
void*
operator new (std::size_t size, std::align_val_t alignment, const std::nothrow_t& /*tag*/) noexcept
{
  return allocateOrNull (size, static_cast<std::size_t> (alignment));
}
void*
operator new[] (std::size_t size, std::align_val_t alignment,
                const std::nothrow_t& /*tag*/) noexcept
{
  return allocateOrNull (size, static_cast<std::size_t> (alignment));
}

void
operator delete (void* pointer) noexcept
{
  release (pointer);
}
void
operator delete[] (void* pointer) noexcept
{
  release (pointer);
}
void
operator delete (void* pointer, std::size_t /*size*/) noexcept
{
  release (pointer);
}
void
operator delete[] (void* pointer, std::size_t /*size*/) noexcept
{
  release (pointer);
}
void
operator delete (void* pointer, const std::nothrow_t& /*tag*/) noexcept
{
  release (pointer);
}
void
operator delete[] (void* pointer, const std::nothrow_t& /*tag*/) noexcept
{
  release (pointer);
}
void
operator delete (void* pointer, std::align_val_t /*alignment*/) noexcept
{
  release (pointer);
}
void
operator delete[] (void* pointer, std::align_val_t /*alignment*/) noexcept
{
  release (pointer);
}
void
operator delete (void* pointer, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
  release (pointer);
}
void
operator delete[] (void* pointer, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
  release (pointer);
}
void
operator delete (void* pointer, std::align_val_t /*alignment*/,
                 const std::nothrow_t& /*tag*/) noexcept
{
  release (pointer);
}
void
operator delete[] (void* pointer, std::align_val_t /*alignment*/,
                   const std::nothrow_t& /*tag*/) noexcept
{
  release (pointer);
}
