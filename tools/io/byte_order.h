// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in the byte order of a file.
#pragma once

#include <algorithm>
#include <array>
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
  std::array<char, sizeof (T)> bytes{};
  std::memcpy (bytes.data (), from, sizeof (T));
  if (order != HOST_BYTE_ORDER)
    std::reverse (bytes.begin (), bytes.end ());
  std::memcpy (to, bytes.data (), sizeof (T));
}

template <typename T>
inline T
readNumber (const void* from, ByteOrder order)
{
  T number;
  copyNumber<T> (&number, from, order);
  return number;
}

} // namespace pcl::floater
