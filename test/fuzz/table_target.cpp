// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: the bytes are text with a point in each line.
#include "fuzz_target.h"
#include "reader_target.h"

int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
  for (const bool is_intensity_first : {false, true})
    pcl::floater::fuzz::readBytes (data, size,
                                   [is_intensity_first] (const pcl::floater::FileBytes& file) {
                                     return pcl::floater::parseTable (file, is_intensity_first);
                                   });
  return 0;
}
