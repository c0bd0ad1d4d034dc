// SPDX-License-Identifier: GPL-3.0-or-later
#include "solvers/single_blas_thread.h"

#include <dlfcn.h>

#include <mutex>

namespace pcl
{
namespace floater
{
namespace
{
struct OpenBlas
{
  using Get = int (*) ();
  using Set = void (*) (int);
  Get get = reinterpret_cast<Get> (dlsym (RTLD_DEFAULT, "openblas_get_num_threads"));
  Set set = reinterpret_cast<Set> (dlsym (RTLD_DEFAULT, "openblas_set_num_threads"));
  std::mutex mutex;
  int users = 0;
  int threads = 1; // before the first user

  void change (int from, int to) const
  {
    if (set != nullptr && from != to)
      set (to);
  }
};

OpenBlas&
openBlas ()
{
  static OpenBlas instance;
  return instance;
}

} // namespace

SingleBlasThread::SingleBlasThread ()
{
  OpenBlas& blas = openBlas ();
  const std::lock_guard<std::mutex> lock (blas.mutex);
  if (blas.users++ > 0)
    return;
  blas.threads = blas.get != nullptr ? blas.get () : 1;
  blas.change (blas.threads, 1);
}

SingleBlasThread::~SingleBlasThread ()
{
  OpenBlas& blas = openBlas ();
  const std::lock_guard<std::mutex> lock (blas.mutex);
  if (--blas.users == 0)
    blas.change (1, blas.threads);
}

} // namespace floater
} // namespace pcl
