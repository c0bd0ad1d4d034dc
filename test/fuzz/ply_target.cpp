// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: the bytes are a PLY file.
#include "fuzz_target.h"
#include "reader_target.h"

int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
  for (const bool all_digits : {false, true})
    pcl::floater::fuzz::readBytes (data, size, [all_digits] (const pcl::floater::FileBytes& file) {
      return pcl::floater::parsePly (file, all_digits);
    });
  return 0;
}
