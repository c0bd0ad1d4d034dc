// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/hilbert_curve.h"

#include "core/parallel.h"

#include <algorithm>
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

namespace {
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
codeOf (const Eigen::Array3d& cell)
{
  return hilbertCode ({static_cast<std::uint32_t> (cell.x ()),
                       static_cast<std::uint32_t> (cell.y ()),
                       static_cast<std::uint32_t> (cell.z ())});
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

class CurveSort
{
public:
  CurveSort (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& cloud_index,
             const Eigen::Vector3d& centre, double scale, const RunContext& run)
      : positions_ (positions), cloud_index_ (cloud_index), centre_ (centre), scale_ (scale),
        run_ (run)
  {
    chooseBorders ();
  }

  CurveOrder sorted ()
  {
    const std::vector<std::uint16_t> part_of = findParts ();
    std::vector<std::size_t> ends = scatter (part_of);
    sortParts (ends);
    return std::move (order_);
  }

private:
  Eigen::Vector3d scaled (std::size_t row) const { return (positions_[row] - centre_) / scale_; }

  // Equal positions have equal codes, so no border separates them.
  void chooseBorders ()
  {
    const std::size_t parts = std::clamp<std::size_t> (positions_.size () / PART, 1, MOST_PARTS);
    if (parts == 1)
      return;
    std::vector<Record> samples;
    const std::size_t stride = positions_.size () / (parts * SAMPLES);
    for (std::size_t i = 0; i < parts * SAMPLES; ++i)
      if (const std::size_t row = sampledRow (i, stride); positions_[row].allFinite ())
        samples.emplace_back (scaled (row), Index{0});
    std::sort (samples.begin (), samples.end ());
    for (std::size_t part = 1; part < parts && !samples.empty (); ++part) {
      const Record& border = samples[part * samples.size () / parts];
      if (borders_.empty () || borders_.back () < border)
        borders_.push_back (border);
    }
  }

  std::vector<std::uint16_t> findParts () const
  {
    std::vector<std::uint16_t> part_of (positions_.size (), NO_PART);
    parallelRanges (run_, positions_.size (), [&] (std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row)
        if (positions_[row].allFinite ())
          part_of[row] = static_cast<std::uint16_t> (
              std::upper_bound (borders_.begin (), borders_.end (), Record (scaled (row), 0)) -
              borders_.begin ());
    });
    return part_of;
  }

  // Moves each position to its part. Returns where each part ends.
  std::vector<std::size_t> scatter (const std::vector<std::uint16_t>& part_of)
  {
    std::vector<std::size_t> next (borders_.size () + 2, 0); // the first is 0, see below
    for (const std::uint16_t part : part_of)
      if (part != NO_PART)
        ++next[part + std::size_t{1}];
    for (std::size_t part = 1; part < next.size (); ++part)
      next[part] += next[part - 1];
    order_.positions.resize (next.back ());
    order_.cloud_index.resize (next.back ());
    ProgressLoop progress (run_, part_of.size ());
    for (std::size_t row = 0; row < part_of.size (); ++row) {
      progress.next ();
      if (part_of[row] == NO_PART)
        continue;
      const std::size_t place = next[part_of[row]]++;
      order_.positions[place] = scaled (row);
      order_.cloud_index[place] = cloud_index_[row];
    }
    next.pop_back ();
    return next;
  }

  void sortParts (const std::vector<std::size_t>& ends)
  {
    // Several parts in a task, which share an array.
    constexpr std::size_t MOST_TASKS = 256;
    const std::size_t in_task = (ends.size () + MOST_TASKS - 1) / MOST_TASKS;
    parallelTasks (run_, (ends.size () + in_task - 1) / in_task, [&] (std::size_t task) {
      std::vector<Record> records;
      for (std::size_t part = task * in_task; part < std::min ((task + 1) * in_task, ends.size ());
           ++part) {
        const std::size_t first = part == 0 ? 0 : ends[part - 1];
        records.clear ();
        records.reserve (ends[part] - first);
        for (std::size_t i = first; i < ends[part]; ++i)
          records.emplace_back (order_.positions[i], order_.cloud_index[i]);
        std::sort (records.begin (), records.end ());
        for (std::size_t i = first; i < ends[part]; ++i) {
          order_.positions[i] = records[i - first].position;
          order_.cloud_index[i] = records[i - first].cloud_index;
        }
      }
    });
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Index>& cloud_index_;
  const Eigen::Vector3d centre_;
  const double scale_;
  const RunContext run_;
  std::vector<Record> borders_; // first records of all parts except the first, ascending
  CurveOrder order_;
};

} // namespace

CurveOrder
sortAlongCurve (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Index>& cloud_index, const Eigen::Vector3d& centre, double scale,
                const RunContext& run)
{
  return CurveSort (positions, cloud_index, centre, scale, run).sorted ();
}

} // namespace pcl::floater
