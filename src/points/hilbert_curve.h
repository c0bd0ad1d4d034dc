// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A space-filling curve along which near points are near.
#pragma once

#include <array>
#include <cstdint>

namespace pcl::floater {
constexpr int HILBERT_BITS = 21; ///< of each coordinate

/// Position of a cell along a Hilbert curve through a grid of 2^HILBERT_BITS cells a side.
/// \param cell coordinates, of HILBERT_BITS bits
std::uint64_t
hilbertCode (const std::array<std::uint32_t, 3>& cell);

} // namespace pcl::floater
