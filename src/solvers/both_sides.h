// SPDX-License-Identifier: GPL-3.0-or-later
// Work on both right-hand sides of a system.
#pragma once

#include "common/parallel.h"

#include <array>
#include <exception>
#include <system_error>
#include <thread>

namespace pcl
{
namespace floater
{
/// Calls body (0) and body (1), at the same time where threads allow. The first exception thrown is
/// rethrown here when both have ended.
template <typename Body>
void
bothSides (int threads, const Body& body)
{
  std::array<std::exception_ptr, 2> errors;
  const auto guarded = [&body, &errors] (std::size_t side) {
    try {
      body (side);
    }
    catch (...) {
      errors[side] = std::current_exception ();
    }
  };
  std::thread helper;
  if (resolveThreads (threads) > 1) {
    try {
      helper = std::thread (guarded, 1);
    }
    catch (const std::system_error&) {
      // No thread to be had: one after the other.
    }
  }
  guarded (0);
  if (helper.joinable ())
    helper.join ();
  else
    guarded (1);
  for (const std::exception_ptr& error : errors)
    if (error)
      std::rethrow_exception (error);
}

} // namespace floater
} // namespace pcl
