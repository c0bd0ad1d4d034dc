// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds decoded from random bytes.
#pragma once

#include "cloud_recipe.h"

#include <array>
#include <cstdint>
#include <random>

namespace pcl::floater::fuzz {
/// The cloud and options of a seed.
/// \param most points at most
inline Attack
randomAttack (std::uint64_t seed, std::size_t most)
{
  constexpr std::size_t ENOUGH = 4096; // more bytes than a recipe takes, but for raw points
  std::mt19937_64 engine (seed);
  std::array<std::uint8_t, ENOUGH> bytes{};
  for (std::uint8_t& byte : bytes)
    byte = static_cast<std::uint8_t> (engine ());
  ByteSource source (bytes.data (), bytes.size ());
  return decodeAttack (source, most);
}

} // namespace pcl::floater::fuzz
