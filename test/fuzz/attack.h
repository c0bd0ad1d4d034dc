// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are hard on a reconstruction, decoded from bytes: by the fuzzer, and by tests that
// take random bytes. And what every result must be, whatever the cloud and the options were.
#pragma once

#include <pcl/surface/floater/reconstruct.h>

#include <cstdlib>
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
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof bits; ++i)
      bits = bits << 8U | byte ();
    double number;
    std::memcpy (&number, &bits, sizeof number);
    return number;
  }

private:
  const std::uint8_t* at_;
  std::size_t left_;
};

/// A number that the environment asks for, or the usual one.
inline std::size_t
wantedBy (const char* variable, std::size_t usual)
{
  const char* const wanted = std::getenv (variable);
  return wanted == nullptr ? usual : std::strtoull (wanted, nullptr, 10);
}

/// What a run is given.
struct Attack
{
  Input input;
  Options options; ///< most of them, but not all, are within their ranges
};

/// Decodes a cloud of up to six parts: hard shapes, and coordinates straight from the bytes. Each
/// has a scale, a place and a jitter of its own; all together are scaled by 1e-300 to 1e300 now and
/// then, spiked with NaN, infinities, copies and outliers, and put in random order. Cloud indices
/// may leave gaps. The bytes of the corpus rely on how they are decoded.
/// \param most points at most, 16 or more
Attack
decodeAttack (ByteSource& bytes, std::size_t most);

/// Compares a result with what the headers promise, without any code of the library: no status that
/// blames the library; without a mesh a message; else triangles of selected points that form an
/// oriented manifold with the figures of the report, and every selected point accounted for exactly
/// once: in the mesh, or as unused, outlier, not finite, or equal to another point.
/// \param input as it was given to reconstruct ()
/// \return the first fault in a sentence; empty if there is none
std::string
findFault (const Input& input, const Result& result);

} // namespace pcl::floater::fuzz
