// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are hard on a reconstruction, decoded from bytes: by the fuzzer, and by tests that
// take random bytes.
#pragma once

#include "byte_source.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater::fuzz {
/// What a run is given.
struct Attack
{
  Input input;
  Options options;
};

/// Decodes a cloud of up to six parts: grids, lines, circles, points on a sphere, discs, random
/// points, coincident points, hubs of huge valence, sheets in contact, boxes, cones, one-sided
/// strips, coarse depth images, and coordinates straight from the bytes. Each has a scale, a place
/// and a jitter of its own; all together are scaled by 1e-300 to 1e300 now and then, spiked with
/// NaN, infinities, copies and outliers, and put in random order. Cloud indices may leave gaps.
/// \param most points at most, 16 or more
Attack
decodeAttack (ByteSource& bytes, std::size_t most);

/// Decodes options; most of them, but not all, are within their ranges.
/// \param points of the cloud that they are for
Options
decodeOptions (ByteSource& bytes, std::size_t points);

} // namespace pcl::floater::fuzz
