// SPDX-License-Identifier: GPL-3.0-or-later
// One BLAS thread during a factorization.
#pragma once

namespace pcl
{
namespace floater
{
/// Makes OpenBLAS use one thread while any instance lives, and its former number afterwards. More
/// threads cost time on fronts as small as ours and change the last digits of the factors. OpenBLAS
/// is looked up at run time; with another BLAS behind libblas this does nothing.
///
/// The number is one for the whole process, so instances that live at the same time, in any
/// threads, share it: the first saves it, the last restores it.
///
/// Throws std::bad_alloc where OpenBLAS would find no room for its work buffer.
class SingleBlasThread
{
public:
  SingleBlasThread ();
  ~SingleBlasThread ();
  SingleBlasThread (const SingleBlasThread&) = delete;
  SingleBlasThread& operator= (const SingleBlasThread&) = delete;
};

} // namespace floater
} // namespace pcl
