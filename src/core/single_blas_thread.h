// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One BLAS thread during a factorization.
#pragma once

namespace pcl::floater {
/// Makes OpenBLAS use one thread while any instance exists, and restores the former number
/// afterwards. More threads are slower on our small fronts, and change the last digits of the
/// factors. OpenBLAS is looked up at run time; with any other BLAS this does nothing. The number
/// belongs to the process, so all instances share it: the first saves it, the last restores it.
class SingleBlasThread
{
public:
  /// \throws std::bad_alloc if there is no memory for the work buffer of OpenBLAS
  SingleBlasThread ();
  ~SingleBlasThread ();
  SingleBlasThread (const SingleBlasThread&) = delete;
  SingleBlasThread& operator= (const SingleBlasThread&) = delete;
};

} // namespace pcl::floater
