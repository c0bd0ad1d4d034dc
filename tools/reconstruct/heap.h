// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the tools do with the C library and with OpenBLAS before they begin. Does nothing where it is
// another library.
#pragma once

#include <dlfcn.h>
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <cstdint>
#include <cstdlib>

namespace pcl::floater {
/// Arrays of a large cloud go back to the system as soon as they are freed; smaller ones stay, and
/// are used again without being cleared. By default glibc raises the threshold with the first array
/// that is freed, and gives what is free at the end of the heap back each time. The heap begins in
/// huge pages, where there are such: they come into memory much faster, and the processor finds
/// them faster. Measured: a tenth of the time of clouds of 30,000 to 130,000 points.
/// \param in_huge_pages false where the address space is limited: they take more of it
inline void
prepareHeap (bool in_huge_pages)
{
#ifdef __GLIBC__
  constexpr int THRESHOLD = 8 << 20, IN_HUGE_PAGES = 64 << 20;
  mallopt (M_MMAP_THRESHOLD, THRESHOLD);
  mallopt (M_TRIM_THRESHOLD, 4 * IN_HUGE_PAGES);
  if (in_huge_pages) {
    constexpr std::uintptr_t MOST = 2 * static_cast<std::uintptr_t> (IN_HUGE_PAGES);
    constexpr std::uintptr_t PAGE = std::uintptr_t{1} << 21U;
    mallopt (M_TOP_PAD, IN_HUGE_PAGES);
    void* const begin = std::malloc (THRESHOLD / 2); // grows the heap
    const auto first = (reinterpret_cast<std::uintptr_t> (begin) / PAGE + 1) * PAGE;
    const auto last = reinterpret_cast<std::uintptr_t> (::sbrk (0));
    if (first < last && last - first < MOST) // else it is no heap of glibc
      ::madvise (reinterpret_cast<void*> (first), last - first, MADV_HUGEPAGE);
    std::free (begin);
  }
  mallopt (M_TOP_PAD, THRESHOLD / 2);
#else
  (void)in_huge_pages;
#endif
}

/// Gives the system what the heap has of earlier stages, and from now on what smaller arrays leave.
inline void
giveFreedBack ()
{
#ifdef __GLIBC__
  mallopt (M_MMAP_THRESHOLD, 1 << 20);
  malloc_trim (0);
#endif
}

/// Ends the worker threads that OpenBLAS starts with the program. They wait busily for about a
/// tenth of a second, on the cores that the reconstruction needs; it uses none of them. OpenBLAS
/// would start them again if it were asked to use several threads. It is looked up at run time;
/// with any other BLAS this does nothing.
///
/// To be called before any other thread is started, and not where the address space is limited: a
/// worker that finds no memory never ends.
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
