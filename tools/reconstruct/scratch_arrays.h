// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays larger than memory. A program that links this has its operators new and delete replaced:
// they use malloc, but after keepLargeArraysIn () each large array is mapped to a scratch file, so
// that its pages can leave memory. Allocations of C libraries, such as the solvers, are not
// affected. With a sanitizer, which has operators of its own, all arrays stay in memory. And what the
// tools do with the C library and with OpenBLAS, which is nothing where it is another library.
#pragma once

#include <dlfcn.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace pcl::floater {
/// Bytes from which on an array is large. At some hundred pages, mapping it costs little compared
/// with filling it.
constexpr std::size_t LARGE_ARRAY = std::size_t{1} << 20U;

/// Makes every large array from now on a shared mapping of a file in this folder. The files have no
/// names, so that none is left however the program ends. Their space is reserved when they are
/// made: on a full disk, operator new throws std::bad_alloc. A thread takes their pages out of the
/// resident set when that comes near the limit; their contents stay in the files, and return to
/// memory when they are used. To be called once, before other threads run.
/// \param limit bytes; see leastMemory ()
/// \throws WriteError if no file can be made in the folder
void
keepLargeArraysIn (const std::filesystem::path& folder, std::size_t limit);

/// Takes the pages of all large arrays in files and of mapped input files out of the resident set.
void
dropPages ();

/// Use of the scratch folder, in bytes.
struct ScratchUse
{
  std::size_t bytes = 0; ///< size of the scratch files that exist now
  std::size_t peak = 0;  ///< largest size so far
};

ScratchUse
scratchUse ();

/// Why the last large array that could not be made had no room; empty if all could be made.
std::string
scratchFailure ();

/// Parses a size in bytes: a number, with K, M, G or T (or lower case) for powers of 1000.
/// \return false if the word is not a size or out of range
bool
parseSize (std::string_view word, std::size_t& bytes);

/// Formats a size for parseSize (), in millions of bytes, rounded up ("500M").
inline std::string
formatSize (std::size_t bytes)
{
  constexpr std::size_t MEGABYTE = 1'000'000;
  return std::to_string ((bytes + MEGABYTE - 1) / MEGABYTE) + "M";
}

/// Bytes of each point that have to stay in memory when a cloud is reconstructed by one process.
/// 250 MB for 10 million points. With less, most of the time goes into reading pages back.
constexpr double KEPT_PER_POINT = 25.0;

/// Pages are dropped above this fraction of the limit. The rest is filled while the thread that
/// drops them sleeps, waits for a processor, or works.
constexpr double MOST_RESIDENT = 0.7;

/// Least limit, in bytes, near which the memory for a cloud of so many points can be kept.
inline std::size_t
leastMemory (std::size_t points, double kept_per_point = KEPT_PER_POINT)
{
  constexpr double FIXED = 20e6; // the program with its libraries and stacks, and small arrays
  return static_cast<std::size_t> ((FIXED + kept_per_point * static_cast<double> (points)) /
                                   MOST_RESIDENT);
}

/// Arrays of a large cloud go back to the system as soon as they are freed; smaller ones stay, and
/// are used again without being cleared. By default glibc raises the threshold with the first array
/// that is freed, and gives what is free at the end of the heap back each time. The heap begins in
/// huge pages, where there are such: they come into memory much faster, and the processor finds
/// them faster. Measured: a tenth of the time of clouds of 30,000 to 130,000 points.
/// \param in_huge_pages false where the address space is limited: they take more of it
void
prepareHeap (bool in_huge_pages);

/// Gives the system what the heap has of earlier stages, and from now on what smaller arrays leave.
void
giveFreedBack ();

/// Ends the worker threads that OpenBLAS starts with the program. They wait busily for about a
/// tenth of a second, on the cores that the reconstruction needs; it uses none of them. It is looked up
/// at run time. To be called before any other thread is started, and not where the address space is
/// limited: a worker that finds no memory never ends.
inline void
endBlasThreads ()
{
  // What OpenBLAS itself calls before a fork.
  using Shutdown = int (*) ();
  const auto shutdown = reinterpret_cast<Shutdown> (dlsym (RTLD_DEFAULT, "blas_thread_shutdown_"));
  if (shutdown != nullptr)
    shutdown ();
}

} // namespace pcl::floater
