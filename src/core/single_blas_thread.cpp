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
using Get = int (*) ();
using Set = void (*) (int);

std::mutex blas_mutex; // guards the next two
int blas_users = 0;
int threads_before = 1; // before the first user

// Of OpenBLAS, if that is the BLAS of the process; else nullptr.
template <typename Function>
Function
blasFunction (const char* name)
{
  return reinterpret_cast<Function> (dlsym (RTLD_DEFAULT, name));
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
  const auto get = blasFunction<Get> ("openblas_get_num_threads");
  const auto set = blasFunction<Set> ("openblas_set_num_threads");
  if (set != nullptr && !hasRoomForBuffer ())
    throw std::bad_alloc ();
  const std::lock_guard<std::mutex> lock (blas_mutex);
  if (blas_users++ > 0 || get == nullptr || set == nullptr)
    return;
  threads_before = get ();
  set (1);
}

SingleBlasThread::~SingleBlasThread ()
{
  const std::lock_guard<std::mutex> lock (blas_mutex);
  if (--blas_users == 0 && threads_before != 1)
    blasFunction<Set> ("openblas_set_num_threads") (threads_before);
}

} // namespace pcl::floater
