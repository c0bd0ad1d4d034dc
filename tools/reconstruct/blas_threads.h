// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <dlfcn.h>

namespace pcl::floater {
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
