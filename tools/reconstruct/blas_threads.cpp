// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "blas_threads.h"

#include <dlfcn.h>

namespace pcl::floater {
void
endBlasThreads ()
{
  // What OpenBLAS itself calls before a fork.
  using Shutdown = int (*) ();
  const auto shutdown = reinterpret_cast<Shutdown> (dlsym (RTLD_DEFAULT, "blas_thread_shutdown_"));
  if (shutdown != nullptr)
    shutdown ();
}

} // namespace pcl::floater
