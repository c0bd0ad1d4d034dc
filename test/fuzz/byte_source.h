// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Choices that are decoded from bytes, so that a fuzzer can make them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pcl::floater::fuzz {
/// Takes numbers from the front of some bytes; zeros after their end.
class ByteSource
{
public:
  /// \param bytes must outlive the source
  ByteSource (const std::uint8_t* bytes, std::size_t size) : at_ (bytes), left_ (size) {}

  bool isEmpty () const { return left_ == 0; }

  std::uint8_t byte ()
  {
    if (left_ == 0)
      return 0;
    --left_;
    return *at_++;
  }

  std::uint64_t word ()
  {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof bits; ++i)
      bits = bits << 8U | byte ();
    return bits;
  }

  /// An integer in [0, n); n from 1 to 65536.
  std::size_t below (std::size_t n)
  {
    const std::size_t high = n > 256 ? byte () : 0;
    return (high << 8U | byte ()) % n;
  }

  /// Whether something that is rare, one in n, is to be done; not after the end.
  bool isOneIn (std::size_t n) { return below (n) == n - 1; }

  /// Any bit pattern: also infinite, NaN and denormal numbers.
  double anyDouble ()
  {
    const std::uint64_t bits = word ();
    double number;
    std::memcpy (&number, &bits, sizeof number);
    return number;
  }

private:
  const std::uint8_t* at_;
  std::size_t left_;
};

} // namespace pcl::floater::fuzz
