// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A checksum that is as fast as memory: every byte of the work folder is checked each time it is
// read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pcl
{
namespace floater
{
/// A checksum of bytes, on machines of one byte order. Words of 8 bytes are mixed into four lanes
/// in turn. Each step maps the lane one to one for a given word, and the word one to one for a
/// given lane; so any damage within one word of each lane at most is seen for sure, and any other
/// but for one time in 2^64. It is no protection against intent. \param before that of the bytes
/// before these
inline std::uint64_t
checksumOf (const char* bytes, std::size_t count, std::uint64_t before = 0)
{
  constexpr std::size_t LANES = 4, WORD = sizeof (std::uint64_t), GROUP = LANES * WORD;
  // Odd, with about as many ones as zeros: 2^64 over the golden ratio.
  constexpr std::uint64_t FACTOR = 0x9e3779b97f4a7c15ULL;
  const auto mix = [] (std::uint64_t lane, std::uint64_t word) {
    lane = (lane ^ word) * FACTOR;
    return lane ^ (lane >> 32U);
  };
  std::array<std::uint64_t, LANES> lanes{1, 2, 3, 4};
  const auto mixGroup = [&] (const char* group) {
    std::array<std::uint64_t, LANES> words{};
    std::memcpy (words.data (), group, GROUP);
    for (std::size_t i = 0; i < LANES; ++i)
      lanes[i] = mix (lanes[i], words[i]);
  };
  const std::size_t whole = count / GROUP * GROUP;
  for (std::size_t at = 0; at < whole; at += GROUP)
    mixGroup (bytes + at);
  if (whole < count) {
    std::array<char, GROUP> rest{}; // the number of bytes tells zeros at the end from none
    std::memcpy (rest.data (), bytes + whole, count - whole);
    mixGroup (rest.data ());
  }
  std::uint64_t sum = mix (before, count);
  for (const std::uint64_t lane : lanes)
    sum = mix (sum, lane);
  return sum;
}

} // namespace floater
} // namespace pcl
