// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in the byte order of a file.
#pragma once

#include <cstdint>
#include <cstring>

namespace pcl::floater {
enum class ByteOrder
{
  LITTLE,
  BIG
};

constexpr ByteOrder HOST_BYTE_ORDER =
    __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? ByteOrder::LITTLE : ByteOrder::BIG;

/// Copies a number from the byte order of a file to that of this machine, or the other way.
template <typename T>
inline void
copyNumber (void* to, const void* from, ByteOrder order)
{
  if (order == HOST_BYTE_ORDER || sizeof (T) == 1) {
    std::memcpy (to, from, sizeof (T));
    return;
  }
  if constexpr (sizeof (T) == 2) {
    std::uint16_t bits;
    std::memcpy (&bits, from, sizeof bits);
    bits = __builtin_bswap16 (bits);
    std::memcpy (to, &bits, sizeof bits);
  }
  else if constexpr (sizeof (T) == 4) {
    std::uint32_t bits;
    std::memcpy (&bits, from, sizeof bits);
    bits = __builtin_bswap32 (bits);
    std::memcpy (to, &bits, sizeof bits);
  }
  else if constexpr (sizeof (T) == 8) {
    std::uint64_t bits;
    std::memcpy (&bits, from, sizeof bits);
    bits = __builtin_bswap64 (bits);
    std::memcpy (to, &bits, sizeof bits);
  }
}

/// Reads a number in the byte order of a file.
template <typename T>
inline T
readNumber (const void* from, ByteOrder order)
{
  T number;
  copyNumber<T> (&number, from, order);
  return number;
}

} // namespace pcl::floater
