// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Each array has a file of its own, so that the file goes when the array is freed. Its space is
// reserved when it is made: a page without a block on the disk would be SIGBUS when it is written.
// The descriptor is closed as soon as the file is mapped.
#include "scratch_arrays.h"

#include "atomic_file.h"
#include "text_scanner.h"

#include <fcntl.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <map>
#include <mutex>
#include <new>
#include <thread>

namespace pcl::floater {
namespace {
constexpr std::chrono::milliseconds BETWEEN_LOOKS{1};

/// All arrays in files. Nothing may be freed while it is locked, because operator delete locks it as
/// well. Nodes of the table can be allocated, because they are no large arrays.
struct ScratchArrays
{
  std::mutex mutex;                   // guards all but the folder
  std::map<void*, std::size_t> sizes; // by address
  ScratchUse use;
  struct
  {
    int error = 0;
    std::size_t wanted = 0, held = 0; // bytes
  } failure;                          // why the last array that could not be made had no room
  std::string folder;                 // set once, before there are arrays
};

// Never destroyed, because arrays may be freed until the process ends.
ScratchArrays&
scratchArrays ()
{
  static ScratchArrays& all = *new ScratchArrays;
  return all;
}

std::atomic<bool> has_scratch{false};

/// \return its descriptor; -1 and errno if there is none
int
makeScratchFile (const std::string& folder)
{
  constexpr mode_t OWNER = 0600;
  const int file = ::open (folder.c_str (), O_TMPFILE | O_RDWR | O_EXCL | O_CLOEXEC, OWNER);
  if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL))
    return file;
  std::string name = folder + "/.pcl_floater.scratch.XXXXXX";
  const int named = ::mkostemp (name.data (), O_CLOEXEC);
  if (named >= 0)
    ::unlink (name.c_str ());
  return named;
}

/// Maps a new file. The addresses come first: a size beyond all of them must not fill the disk.
/// \return MAP_FAILED and errno if that is impossible
void*
mapNewFile (std::size_t bytes)
{
  const int file = makeScratchFile (scratchArrays ().folder);
  void* array =
      file < 0 ? MAP_FAILED : ::mmap (nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  int error = array == MAP_FAILED ? errno : EINTR;
  while (error == EINTR)
    error = ::posix_fallocate (file, 0, static_cast<off_t> (bytes));
  if (error != 0 && array != MAP_FAILED)
    ::munmap (array, bytes);
  if (file >= 0)
    ::close (file);
  errno = error;
  return error == 0 ? array : MAP_FAILED;
}

/// \return nullptr if there is no room
[[maybe_unused]] void*
makeLargeArray (std::size_t size)
{
  if (size > PTRDIFF_MAX)
    return nullptr;
  void* const array = mapNewFile (size);
  const int error = errno;
  ScratchArrays& all = scratchArrays ();
  const std::lock_guard<std::mutex> lock (all.mutex);
  if (array == MAP_FAILED) {
    all.failure = {error, size, all.use.bytes};
    return nullptr;
  }
  try {
    all.sizes.emplace (array, size);
  }
  catch (const std::bad_alloc&) {
    ::munmap (array, size);
    return nullptr;
  }
  all.use.bytes += size;
  all.use.peak = std::max (all.use.peak, all.use.bytes);
  return array;
}

/// Bytes of this process that are in memory; 0 if that is unknown.
double
residentSet (int statm)
{
  std::array<char, 128> text{};
  const ssize_t size = ::pread (statm, text.data (), text.size () - 1, 0);
  // The first number is the size of the program, the second its resident set, both in pages.
  const char* const second = size > 0 ? std::strchr (text.data (), ' ') : nullptr;
  return second == nullptr
             ? 0.0
             : std::strtod (second, nullptr) * static_cast<double> (::sysconf (_SC_PAGESIZE));
}

} // namespace

void
dropPages ()
{
  giveBackMappedFiles ();
  ScratchArrays& all = scratchArrays ();
  // Locked, so that no array is unmapped meanwhile and its addresses are used again.
  const std::lock_guard<std::mutex> lock (all.mutex);
  for (const auto& [array, size] : all.sizes)
    ::madvise (array, size, MADV_DONTNEED); // of a shared mapping: the contents stay in the file
}

void
keepLargeArraysIn (const std::filesystem::path& folder, std::size_t limit)
{
  const int file = makeScratchFile (folder.string ());
  if (file < 0)
    throw WriteError ("cannot use the scratch folder '" + folder.string () +
                      "': " + std::strerror (errno));
  ::close (file);
  scratchArrays ().folder = folder.string ();
  has_scratch = true;
  try {
    std::thread ([most = MOST_RESIDENT * static_cast<double> (limit)] {
      const int statm = ::open ("/proc/self/statm", O_RDONLY | O_CLOEXEC);
      for (;; std::this_thread::sleep_for (BETWEEN_LOOKS))
        if (residentSet (statm) > most)
          dropPages ();
    }).detach ();
  }
  catch (const std::system_error&) {
    // No thread can be started: pages leave memory when the system needs it, and the report tells
    // if the limit was exceeded.
  }
}

ScratchUse
scratchUse ()
{
  ScratchArrays& all = scratchArrays ();
  const std::lock_guard<std::mutex> lock (all.mutex);
  return all.use;
}

std::string
scratchFailure ()
{
  const auto megabytes = [] (std::size_t bytes) {
    return std::to_string (bytes / 1'000'000) + " MB";
  };
  ScratchArrays& all = scratchArrays ();
  std::unique_lock<std::mutex> lock (all.mutex);
  const auto last = all.failure;
  lock.unlock ();
  if (last.error == 0)
    return "";
  return "no room in the scratch folder '" + all.folder + "': " + std::strerror (last.error) +
         "; it holds " + megabytes (last.held) + ", and " + megabytes (last.wanted) +
         " more are needed" +
         (last.error == EFBIG ? "; raise the limit on file sizes (ulimit -f)"
                              : "; free some space or name another folder by --scratch");
}

bool
parseSize (std::string_view word, std::size_t& bytes)
{
  constexpr std::string_view UNITS = "kKmMgGtT";
  double unit = 1.0;
  if (!word.empty () && UNITS.find (word.back ()) != std::string_view::npos) {
    const std::size_t power = UNITS.find (word.back ()) / 2 + 1;
    unit = std::pow (1000.0, static_cast<double> (power));
    word.remove_suffix (1);
  }
  double number = 0.0;
  constexpr double MOST = 9e18;
  if (!parseNumber (word, number) || !(number >= 0.0) || number * unit > MOST)
    return false;
  bytes = static_cast<std::size_t> (std::llround (number * unit));
  return true;
}

void
prepareHeap ([[maybe_unused]] bool in_huge_pages)
{
#ifdef __GLIBC__
  constexpr int THRESHOLD = 8 << 20, IN_HUGE_PAGES = 64 << 20;
  mallopt (M_MMAP_THRESHOLD, THRESHOLD);
  mallopt (M_TRIM_THRESHOLD, 4 * IN_HUGE_PAGES);
  if (in_huge_pages) {
    constexpr std::uintptr_t MOST = 2 * static_cast<std::uintptr_t> (IN_HUGE_PAGES);
    constexpr std::uintptr_t HUGE_PAGE = std::uintptr_t{1} << 21U;
    mallopt (M_TOP_PAD, IN_HUGE_PAGES);
    void* const begin = std::malloc (THRESHOLD / 2); // grows the heap
    const auto first = (reinterpret_cast<std::uintptr_t> (begin) / HUGE_PAGE + 1) * HUGE_PAGE;
    const auto last = reinterpret_cast<std::uintptr_t> (::sbrk (0));
    if (first < last && last - first < MOST) // else it is no heap of glibc
      ::madvise (reinterpret_cast<void*> (first), last - first, MADV_HUGEPAGE);
    std::free (begin);
  }
  mallopt (M_TOP_PAD, THRESHOLD / 2);
#endif
}

void
giveFreedBack ()
{
#ifdef __GLIBC__
  mallopt (M_MMAP_THRESHOLD, 1 << 20);
  malloc_trim (0);
#endif
}

} // namespace pcl::floater

// The other forms call these. Those for large alignments, which nothing here uses, stay as they are.
// Sanitizers have their own; Clang tells them by features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PCL_FLOATER_IS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PCL_FLOATER_IS_SANITIZED
#endif
#endif
#ifndef PCL_FLOATER_IS_SANITIZED
void*
operator new (std::size_t size)
{
  using namespace pcl::floater;
  void* const array = size >= LARGE_ARRAY && has_scratch
                          ? makeLargeArray (size)
                          : std::malloc (std::max<std::size_t> (size, 1));
  if (array == nullptr)
    throw std::bad_alloc ();
  return array;
}

void
operator delete (void* pointer) noexcept
{
  using namespace pcl::floater;
  constexpr std::uintptr_t PAGE = 4096; // or a multiple; where mappings begin
  if (!has_scratch || reinterpret_cast<std::uintptr_t> (pointer) % PAGE != 0)
    return std::free (pointer);
  ScratchArrays& all = scratchArrays ();
  decltype (all.sizes)::node_type node; // freed without the lock
  {
    const std::lock_guard<std::mutex> lock (all.mutex);
    node = all.sizes.extract (pointer);
    all.use.bytes -= node.empty () ? 0 : node.mapped ();
  }
  if (node.empty ())
    std::free (pointer);
  else
    ::munmap (pointer, node.mapped ());
}

void
operator delete (void* pointer, std::size_t /*size*/) noexcept
{
  operator delete (pointer);
}
#endif
