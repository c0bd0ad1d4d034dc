// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/hilbert_curve.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace pcl::floater {
// The curve of Skilling (2004), "Programming the Hilbert curve": from the highest bit down, excess
// rotations are undone in all lower bits, and the rest is Gray-encoded. The transformation of the
// lower bits is a permutation and inversion of axes, and one more inversion of all: one of few
// states. So the octants of a cell are looked up, from the largest down.

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

// Goes into an octant: one bit of each coordinate. Returns a digit of the code, base 8.
std::uint8_t
goInto (std::uint8_t octant, Orientation& state)
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
  std::uint8_t digit = 0;
  for (const std::uint8_t bit : bits)
    digit = static_cast<std::uint8_t> (digit << 1 | (bit ^ state.parity));
  state.parity ^= bits[2];
  return digit;
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
      Orientation state = states[s];
      const std::uint8_t digit = goInto (octant, state);
      const auto known = std::find (states.begin (), states.end (), state);
      table[s][octant] = {digit, static_cast<std::uint8_t> (known - states.begin ())};
      if (known == states.end ())
        states.push_back (state);
    }
  }
  return table;
}

constexpr int HILBERT_BITS = 21; // of each coordinate

std::uint64_t
codeOf (const Eigen::Array3d& place)
{
  static const std::vector<std::array<Entry, 8>> table = makeTable ();
  const Eigen::Array<std::uint32_t, 3, 1> cell = place.cast<std::uint32_t> ();
  std::uint64_t code = 0;
  std::size_t state = 0;
  for (int bit = HILBERT_BITS - 1; bit >= 0; --bit) {
    const Entry entry = table[state][(cell[0] >> bit & 1U) << 2U | (cell[1] >> bit & 1U) << 1U |
                                     (cell[2] >> bit & 1U)];
    code = code << 3U | entry.digit;
    state = entry.next;
  }
  return code;
}

// A position in units of cells. All axes have the same cell size: the curve follows distance, not
// the shape of the box.
Eigen::Array3d
inCells (const Eigen::Vector3d& position)
{
  constexpr double CELLS = static_cast<double> (1U << HILBERT_BITS) - 1.0;
  return CELLS * (position.array () + 0.5);
}

} // namespace

std::uint64_t
hilbertCode (const Eigen::Vector3d& position)
{
  return codeOf (inCells (position));
}

std::uint64_t
hilbertCodeInCell (const Eigen::Vector3d& position)
{
  const Eigen::Array3d place = inCells (position);
  return codeOf (static_cast<double> (1U << HILBERT_BITS) * (place - place.floor ()));
}

} // namespace pcl::floater
