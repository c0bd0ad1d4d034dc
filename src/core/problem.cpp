// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/problem.h"

#include "core/csr_lists.h"
#include "core/run_context.h"

#include <new>

namespace pcl::floater {
Problem
problemOfException () noexcept
try {
  try {
    throw;
  }
  catch (const Cancelled&) {
    return {RunStatus::CANCELLED, "the run was cancelled by its caller"};
  }
  catch (const std::bad_alloc&) {
    return {RunStatus::OUT_OF_MEMORY,
            "not enough memory: use fewer points, or a machine with more"};
  }
  catch (const IndexLimitReached& limit) {
    return {RunStatus::OUT_OF_MEMORY, limit.what ()};
  }
  catch (const std::length_error&) {
    return {RunStatus::OUT_OF_MEMORY, "an array would be too long: use fewer points"};
  }
  catch (const std::exception& error) {
    return {RunStatus::INTERNAL_ERROR, std::string ("unexpected error: ") + error.what ()};
  }
  catch (...) {
    return {RunStatus::INTERNAL_ERROR, "unexpected error: a callback threw an unknown type"};
  }
}
catch (...) {
  return {RunStatus::OUT_OF_MEMORY, "out of memory"}; // so short that it allocates none
}

} // namespace pcl::floater
