// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: the bytes are a LAS file.
#include "fuzz_target.h"
#include "reader_target.h"

int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
  pcl::floater::fuzz::readBytes (data, size, [] (const pcl::floater::FileBytes& file) {
    return pcl::floater::parseLas (file);
  });
  return 0;
}
