// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/hilbert_curve.h"

#include "core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
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

constexpr int HILBERT_BITS = 21;          // of each coordinate
constexpr std::size_t PART = 16384;       // points, as a mean: some 700 kB
constexpr std::size_t MOST_PARTS = 1024;  // each keeps one page in memory, where it ends so far
constexpr std::size_t SAMPLES = 32;       // per part, so that the largest is less than twice the
                                          // mean
constexpr std::uint16_t NO_PART = 0xffff; // for positions that are not finite

// A position in units of cells. All axes have the same cell size: the curve follows distance, not
// the shape of the box.
Eigen::Array3d
inCells (const Eigen::Vector3d& position)
{
  constexpr double CELLS = static_cast<double> (1U << HILBERT_BITS) - 1.0;
  return CELLS * (position.array () + 0.5);
}

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

// Position on a curve through a cell of the first curve, divided into 2^HILBERT_BITS cells a side.
std::uint64_t
codeInCell (const Eigen::Vector3d& position)
{
  const Eigen::Array3d place = inCells (position);
  return codeOf (static_cast<double> (1U << HILBERT_BITS) * (place - place.floor ()));
}

struct Record
{
  Record () = default;
  Record (const Eigen::Vector3d& at, Index index)
      : code (codeOf (inCells (at))), position (at), cloud_index (index)
  {
  }

  // Cells first: their codes are already computed, and ties are few.
  bool operator<(const Record& other) const
  {
    if (code != other.code)
      return code < other.code;
    if (position == other.position)
      return cloud_index < other.cloud_index;
    const std::uint64_t in_cell = codeInCell (position),
                        other_in_cell = codeInCell (other.position);
    if (in_cell != other_in_cell)
      return in_cell < other_in_cell;
    for (int axis = 0; axis < 3; ++axis)
      if (position[axis] != other.position[axis])
        return position[axis] < other.position[axis];
    return false;
  }

  std::uint64_t code = 0;
  Eigen::Vector3d position;
  Index cloud_index = 0;
};

// One row out of each `stride`, at irregular distances: rows of a cloud may be rows of a grid.
std::size_t
sampledRow (std::size_t sample, std::size_t stride)
{
  std::uint64_t bits = (sample + 1) * 0x9e3779b97f4a7c15ULL; // the golden ratio, as in splitmix64
  bits = (bits ^ bits >> 30U) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ bits >> 27U) * 0x94d049bb133111ebULL;
  return sample * stride + static_cast<std::size_t> (bits ^ bits >> 31U) % stride;
}

} // namespace

CurveOrder
sortAlongCurve (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Index>& cloud_index, const Eigen::Vector3d& centre, double scale,
                const RunContext& run)
{
  const std::size_t n = positions.size ();
  const auto scaled = [&] (std::size_t row) -> Eigen::Vector3d {
    return (positions[row] - centre) / scale;
  };

  // The first records of all parts but the first. Equal positions have equal codes, so no border
  // separates them.
  std::vector<Record> borders, samples;
  const std::size_t parts = std::clamp<std::size_t> (n / PART, 1, MOST_PARTS);
  for (std::size_t i = 0; parts > 1 && i < parts * SAMPLES; ++i)
    if (const std::size_t row = sampledRow (i, n / (parts * SAMPLES)); positions[row].allFinite ())
      samples.emplace_back (scaled (row), Index{0});
  std::sort (samples.begin (), samples.end ());
  for (std::size_t part = 1; part < parts && !samples.empty (); ++part) {
    const Record& border = samples[part * samples.size () / parts];
    if (borders.empty () || borders.back () < border)
      borders.push_back (border);
  }

  std::vector<std::uint16_t> part_of (n, NO_PART);
  parallelRanges (run, n, [&] (std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row)
      if (positions[row].allFinite ())
        part_of[row] = static_cast<std::uint16_t> (
            std::upper_bound (borders.begin (), borders.end (), Record (scaled (row), 0)) -
            borders.begin ());
  });

  // Moves each position to its part.
  std::vector<std::size_t> ends (borders.size () + 2, 0); // of each part, shifted by one until then
  for (const std::uint16_t part : part_of)
    if (part != NO_PART)
      ++ends[part + std::size_t{1}];
  for (std::size_t part = 1; part < ends.size (); ++part)
    ends[part] += ends[part - 1];
  CurveOrder order;
  order.positions.resize (ends.back ());
  order.cloud_index.resize (ends.back ());
  ProgressLoop progress (run, n);
  for (std::size_t row = 0; row < n; ++row) {
    progress.next ();
    if (part_of[row] == NO_PART)
      continue;
    const std::size_t place = ends[part_of[row]]++;
    order.positions[place] = scaled (row);
    order.cloud_index[place] = cloud_index[row];
  }

  parallelTasks (run, borders.size () + 1, [&] (std::size_t part) {
    const std::size_t first = part == 0 ? 0 : ends[part - 1];
    std::vector<Record> records;
    records.reserve (ends[part] - first);
    for (std::size_t i = first; i < ends[part]; ++i)
      records.emplace_back (order.positions[i], order.cloud_index[i]);
    std::sort (records.begin (), records.end ());
    for (std::size_t i = first; i < ends[part]; ++i) {
      order.positions[i] = records[i - first].position;
      order.cloud_index[i] = records[i - first].cloud_index;
    }
  });
  return order;
}

} // namespace pcl::floater
