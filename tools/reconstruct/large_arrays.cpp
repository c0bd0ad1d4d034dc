// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Each array has a file of its own, so that the file goes when the array is freed. Its space is
// reserved when it is made: a page without a block on the disk would be SIGBUS when it is written.
// The descriptor is closed as soon as the file is mapped.
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

namespace pcl::floater {
namespace {
struct ScratchArray
{
  std::size_t bytes;
  bool is_fresh; ///< not yet dropped as a whole
};

/// All arrays in files. Nothing may be freed while the table is locked, because operator delete may
/// lock it as well. Allocating nodes of the table is safe: they are too small to be in it.
struct ScratchArrays
{
  std::mutex mutex;                          // guards the next three
  std::map<std::uintptr_t, ScratchArray> at; // by address
  std::uintptr_t hand = 0;                   // where dropNextChunk () continues
  ScratchUse use;

  // Both are set once, before there are arrays.
  std::string folder;
  std::function<void (std::size_t)> make_room; // called before an array of so many bytes is made

  std::mutex failure_mutex;
  std::string failure;
};

// Never destroyed, because arrays may be freed until the process ends.
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

/// Makes a file without a name.
/// \return its descriptor; -1 and errno if there is none
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

/// Reserves addresses that begin at a multiple of LARGE_ARRAY_ALIGNMENT.
/// \return the first address; 0 if there are none
std::uintptr_t
reserveAddresses (std::size_t bytes)
{
  void* all = ::mmap (nullptr, bytes + LARGE_ARRAY_ALIGNMENT, PROT_NONE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (all == MAP_FAILED)
    return 0;
  const auto first = reinterpret_cast<std::uintptr_t> (all);
  const std::uintptr_t begin =
      (first + LARGE_ARRAY_ALIGNMENT - 1) / LARGE_ARRAY_ALIGNMENT * LARGE_ARRAY_ALIGNMENT;
  if (begin > first)
    ::munmap (all, begin - first);
  if (begin < first + LARGE_ARRAY_ALIGNMENT)
    ::munmap (pointerTo (begin + bytes), first + LARGE_ARRAY_ALIGNMENT - begin);
  return begin;
}

/// Maps a new scratch file at reserved addresses.
/// \return 0, or the error number
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
#ifdef MADV_NOHUGEPAGE
  // With huge pages, one access may read back 2 MB, faster than pages can be dropped.
  if (error == 0)
    ::madvise (pointerTo (begin), bytes, MADV_NOHUGEPAGE);
#endif
  // Nor is anything read ahead while it is filled: Linux keeps what it has read ahead in pieces of
  // up to two megabytes, and since 6.18 one touch maps a whole piece.
  if (error == 0)
    ::madvise (pointerTo (begin), bytes, MADV_RANDOM);
  return error;
}

void
describeFailure (ScratchArrays& all, std::size_t bytes, int error)
{
  const auto megabytes = [] (std::size_t count) {
    return std::to_string (count / 1'000'000) + " MB";
  };
  const std::size_t used = scratchUse ().bytes;
  const std::lock_guard<std::mutex> lock (all.failure_mutex);
  all.failure = "no room in the scratch folder '" + all.folder + "': " + std::strerror (error) +
                "; it holds " + megabytes (used) + ", and " + megabytes (bytes) +
                " more are needed" +
                (error == EFBIG ? "; raise the limit on file sizes (ulimit -f)"
                                : "; free some space or name another folder by --scratch");
}

} // namespace

bool
hasScratchFolder ()
{
  return has_scratch;
}

void*
mapLargeArray (std::size_t size)
{
  constexpr std::size_t PAGE = 4096; // or a part of one
  if (size > PTRDIFF_MAX - 2 * LARGE_ARRAY_ALIGNMENT)
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
      all.at.emplace (begin, ScratchArray{bytes, true});
      all.use.bytes += bytes;
      all.use.peak = std::max (all.use.peak, all.use.bytes);
      return pointerTo (begin);
    }
    describeFailure (all, bytes, error);
  }
  catch (const std::bad_alloc&) {
    // There is no memory for the entry or for the message: it fails like the array itself.
  }
  ::munmap (pointerTo (begin), bytes);
  return nullptr;
}

bool
unmapLargeArray (void* pointer)
{
  ScratchArrays& all = scratchArrays ();
  decltype (all.at)::node_type node; // freed without the lock
  {
    const std::lock_guard<std::mutex> lock (all.mutex);
    node = all.at.extract (reinterpret_cast<std::uintptr_t> (pointer));
    if (node.empty ())
      return false;
    all.use.bytes -= node.mapped ().bytes;
  }
  ::munmap (pointer, node.mapped ().bytes);
  return true;
}

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
dropNextChunk ()
{
  ScratchArrays& all = scratchArrays ();
  // Locked throughout, so that the chunk is not unmapped and its addresses are not used again.
  const std::lock_guard<std::mutex> lock (all.mutex);
  if (all.at.empty ())
    return 0;
  auto array = all.at.upper_bound (all.hand);
  if (array != all.at.begin () &&
      all.hand < std::prev (array)->first + std::prev (array)->second.bytes)
    --array;
  if (array == all.at.end ()) {
    array = all.at.begin ();
    all.hand = 0;
  }
  const std::uintptr_t begin = std::max (all.hand, array->first);
  const std::uintptr_t end = std::min (begin + DROPPED_CHUNK, array->first + array->second.bytes);
  // With a shared mapping of a file, this removes the pages from the page table; the contents stay
  // in the file.
  ::madvise (pointerTo (begin), end - begin, MADV_DONTNEED);
  // Dropped as a whole for the first time: now its pages may go to the disk, and are read ahead
  // when they come back.
  if (array->second.is_fresh && end == array->first + array->second.bytes) {
    ::madvise (pointerTo (array->first), array->second.bytes, MADV_NORMAL);
    array->second.is_fresh = false;
  }
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

} // namespace pcl::floater
