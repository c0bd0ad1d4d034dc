// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The entry of a fuzz target, for libFuzzer and for the replay of a corpus.
#pragma once

#include <cstddef>
#include <cstdint>

/// Runs the target on some bytes.
/// \return 0. A fault ends the program.
extern "C" int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size);
