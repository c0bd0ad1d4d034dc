// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/single_blas_thread.h"

#include <dlfcn.h>
#include <sys/mman.h>

#include <cstddef>
#include <mutex>
#include <new>

namespace pcl::floater {
namespace {
struct OpenBlas
{
  using Get = int (*) ();
  using Set = void (*) (int);
  Get get = reinterpret_cast<Get> (dlsym (RTLD_DEFAULT, "openblas_get_num_threads"));
  Set set = reinterpret_cast<Set> (dlsym (RTLD_DEFAULT, "openblas_set_num_threads"));
  std::mutex mutex;
  int users = 0;
  int threads = 1; // before the first user
};

OpenBlas&
openBlas ()
{
  static OpenBlas instance;
  return instance;
}

// OpenBLAS maps a work buffer at its first use, and retries forever if memory is short.
bool
hasRoomForBuffer ()
{
  constexpr std::size_t BUFFER_BYTES = std::size_t{128} << 20; // of OpenBLAS 0.3 on x86-64
  void* const room = mmap (nullptr, BUFFER_BYTES, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  return room != MAP_FAILED && munmap (room, BUFFER_BYTES) == 0;
}

} // namespace

SingleBlasThread::SingleBlasThread ()
{
  OpenBlas& blas = openBlas ();
  if (blas.set != nullptr && !hasRoomForBuffer ())
    throw std::bad_alloc ();
  const std::lock_guard<std::mutex> lock (blas.mutex);
  if (blas.users++ > 0 || blas.get == nullptr || blas.set == nullptr)
    return;
  blas.threads = blas.get ();
  blas.set (1);
}

SingleBlasThread::~SingleBlasThread ()
{
  OpenBlas& blas = openBlas ();
  const std::lock_guard<std::mutex> lock (blas.mutex);
  if (--blas.users == 0 && blas.threads != 1)
    blas.set (blas.threads);
}

} // namespace pcl::floater
