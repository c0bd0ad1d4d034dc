// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One BLAS thread during a factorization.
#pragma once

namespace pcl::floater {
/// Makes OpenBLAS use one thread while any instance exists, and its former number afterwards. More
/// threads cost time on fronts as small as ours, and they change the last digits of the factors.
/// OpenBLAS is looked up at run time; with any other BLAS this does nothing.
///
/// There is one number for the whole process, so all instances share it, whatever their threads:
/// the first saves it, the last restores it.
class SingleBlasThread
{
public:
  /// \throws std::bad_alloc if OpenBLAS would find no room for its work buffer
  SingleBlasThread ();
  ~SingleBlasThread ();
  SingleBlasThread (const SingleBlasThread&) = delete;
  SingleBlasThread& operator= (const SingleBlasThread&) = delete;
};

} // namespace pcl::floater
