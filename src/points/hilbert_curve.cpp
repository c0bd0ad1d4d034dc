// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The curve of Skilling (2004), "Programming the Hilbert curve": from the highest bit down, excess
// rotations are undone in all lower bits, and the rest is Gray-encoded. The transformation of the
// lower bits is a permutation and inversion of axes, and one more inversion of all: one of few
// states. So the octants of a cell are looked up, from the largest down.
#include "points/hilbert_curve.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace pcl::floater {
namespace {
struct Orientation
{
  std::array<std::uint8_t, 3> axes{0, 1, 2};     // axis of the cell that has become axis i
  std::array<std::uint8_t, 3> inverted{0, 0, 0}; // 1: its bits are inverted
  std::uint8_t parity = 0;                       // 1: all bits of the code are inverted

  bool operator== (const Orientation& other) const
  {
    return axes == other.axes && inverted == other.inverted && parity == other.parity;
  }
};

struct Step
{
  std::uint8_t digit; // of the code, base 8
  Orientation next;
};

// One bit of each coordinate.
Step
stepOf (Orientation state, std::uint8_t octant)
{
  std::array<std::uint8_t, 3> bits{};
  for (std::size_t i = 0; i < 3; ++i)
    bits[i] = static_cast<std::uint8_t> ((octant >> (2 - state.axes[i]) & 1) ^ state.inverted[i]);
  for (std::size_t i = 0; i < 3; ++i) {
    if (bits[i] != 0) {
      state.inverted[0] ^= 1;
    }
    else {
      std::swap (state.axes[0], state.axes[i]);
      std::swap (state.inverted[0], state.inverted[i]);
    }
  }
  bits[1] ^= bits[0];
  bits[2] ^= bits[1];
  Step step{};
  for (const std::uint8_t bit : bits)
    step.digit = static_cast<std::uint8_t> (step.digit << 1 | (bit ^ state.parity));
  state.parity ^= bits[2];
  step.next = state;
  return step;
}

struct Entry
{
  std::uint8_t digit, next;
};

// For each state and octant.
std::vector<std::array<Entry, 8>>
makeTable ()
{
  std::vector<Orientation> states (1);
  std::vector<std::array<Entry, 8>> table;
  for (std::size_t s = 0; s < states.size (); ++s) {
    table.emplace_back ();
    for (std::uint8_t octant = 0; octant < 8; ++octant) {
      const Step step = stepOf (states[s], octant);
      std::size_t next = 0;
      while (next < states.size () && !(states[next] == step.next))
        ++next;
      if (next == states.size ())
        states.push_back (step.next);
      table[s][octant] = {step.digit, static_cast<std::uint8_t> (next)};
    }
  }
  return table;
}

// Two steps in one, for each state and two bits of each coordinate.
std::vector<std::array<Entry, 64>>
pairTable (const std::vector<std::array<Entry, 8>>& table)
{
  std::vector<std::array<Entry, 64>> pairs (table.size ());
  for (std::size_t s = 0; s < table.size (); ++s)
    for (std::size_t bits = 0; bits < pairs[s].size (); ++bits) {
      const Entry high = table[s][(bits >> 3U & 4U) | (bits >> 2U & 2U) | (bits >> 1U & 1U)];
      const Entry low = table[high.next][(bits >> 2U & 4U) | (bits >> 1U & 2U) | (bits & 1U)];
      pairs[s][bits] = {static_cast<std::uint8_t> (high.digit << 3 | low.digit), low.next};
    }
  return pairs;
}

} // namespace

std::uint64_t
hilbertCode (const std::array<std::uint32_t, 3>& cell)
{
  static const std::vector<std::array<Entry, 8>> table = makeTable ();
  static const std::vector<std::array<Entry, 64>> pairs = pairTable (table);
  static_assert (HILBERT_BITS % 2 == 1, "the first bit alone, and then two at once");
  constexpr int FIRST = HILBERT_BITS - 1;
  const Entry first = table[0][(cell[0] >> FIRST & 1U) << 2U | (cell[1] >> FIRST & 1U) << 1U |
                               (cell[2] >> FIRST & 1U)];
  std::uint64_t code = first.digit;
  std::size_t state = first.next;
  for (int bit = FIRST - 2; bit >= 0; bit -= 2) {
    const Entry entry = pairs[state][(cell[0] >> bit & 3U) << 4U | (cell[1] >> bit & 3U) << 2U |
                                     (cell[2] >> bit & 3U)];
    code = code << 6U | entry.digit;
    state = entry.next;
  }
  return code;
}

} // namespace pcl::floater
