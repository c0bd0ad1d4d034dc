// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighborhoods/working_set.h"

#include "common/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr int BITS = 21; // per axis, so that a code fits 64 bits

// Position on a Hilbert curve through the grid of 2^BITS cells a side. The coordinates are turned
// into the "transposed" code of Skilling (2004), "Programming the Hilbert curve": undo the excess
// rotations from the highest bit down, Gray-encode, and interleave.
std::uint64_t
hilbertCode (std::array<std::uint32_t, 3> x)
{
  for (std::uint32_t bit = 1U << (BITS - 1); bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& axis : x) {
      if (axis & bit) {
        x[0] ^= below;
      }
      else {
        const std::uint32_t swapped = (x[0] ^ axis) & below;
        x[0] ^= swapped;
        axis ^= swapped;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t parity = 0;
  for (std::uint32_t bit = 1U << (BITS - 1); bit > 1; bit >>= 1)
    if (x[2] & bit)
      parity ^= bit - 1;
  std::uint64_t code = 0;
  for (int b = BITS - 1; b >= 0; --b)
    for (std::uint32_t axis : x)
      code = (code << 1) | (((axis ^ parity) >> b) & 1U);
  return code;
}

struct Entry
{
  std::uint64_t code;
  Index row;
};

// Both halves at the same time.
template <typename Before>
void
sortInHalves (std::vector<Entry>& entries, int threads, const Before& before)
{
  const auto middle = entries.begin () + static_cast<std::ptrdiff_t> (entries.size () / 2);
  parallelTasks (2, threads, [&] (std::size_t half) {
    std::sort (half == 0 ? entries.begin () : middle, half == 0 ? middle : entries.end (), before);
  });
  std::inplace_merge (entries.begin (), middle, entries.end (), before);
}

// Equal points are neighbours in the order; the first of them, that of the smallest cloud index,
// stands for the others.
void
leaveDuplicatesOut (WorkingSet& set)
{
  std::size_t kept = 0;
  for (std::size_t p = 0; p < set.positions.size (); ++p) {
    if (kept > 0 && set.positions[kept - 1] == set.positions[p]) {
      set.duplicates.push_back ({set.cloud_index[p], set.cloud_index[kept - 1]});
      continue;
    }
    set.positions[kept] = set.positions[p];
    set.cloud_index[kept] = set.cloud_index[p];
    ++kept;
  }
  set.positions.resize (kept);
  set.cloud_index.resize (kept);
  std::sort (set.duplicates.begin (), set.duplicates.end ());
}

} // namespace

WorkingSet
makeWorkingSet (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Index>& cloud_index, int threads)
{
  WorkingSet set;
  std::vector<Entry> entries;
  entries.reserve (positions.size ());
  Eigen::AlignedBox3d box;
  for (std::size_t row = 0; row < positions.size (); ++row) {
    if (positions[row].allFinite ()) {
      box.extend (positions[row]);
      entries.push_back ({0, static_cast<Index> (row)});
    }
    else {
      set.non_finite.push_back (cloud_index[row]);
    }
  }
  std::sort (set.non_finite.begin (), set.non_finite.end ());
  if (entries.empty ())
    return set;

  set.centre = 0.5 * box.min () + 0.5 * box.max ();
  // Both sides: the centre of a box as small as its digits may be rounded to one of its ends.
  const Eigen::Vector3d half_size = (box.max () - set.centre).cwiseMax (set.centre - box.min ());
  const double diagonal = 2.0 * half_size.stableNorm ();
  set.scale = diagonal > 0.0 ? diagonal : 1.0;

  // One cell size for all axes: the curve is to follow distance, not the shape of the box.
  const double cells = static_cast<double> (1U << BITS) - 1.0;
  const auto scaled = [&] (Index row) -> Eigen::Vector3d {
    return (positions[row] - set.centre) / set.scale;
  };
  parallelRanges (entries.size (), threads, [&] (std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      std::array<std::uint32_t, 3> cell{};
      const Eigen::Vector3d position = scaled (entries[e].row);
      for (int axis = 0; axis < 3; ++axis)
        cell[static_cast<std::size_t> (axis)] =
            static_cast<std::uint32_t> (cells * (position[axis] + 0.5));
      entries[e].code = hilbertCode (cell);
    }
  });

  // Ties by coordinates, so that the order does not depend on that of the cloud.
  const auto before = [&] (const Entry& a, const Entry& b) {
    if (a.code != b.code)
      return a.code < b.code;
    const Eigen::Vector3d p = scaled (a.row);
    const Eigen::Vector3d q = scaled (b.row);
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] != q[axis])
        return p[axis] < q[axis];
    return cloud_index[a.row] < cloud_index[b.row];
  };
  sortInHalves (entries, threads, before);

  set.positions.resize (entries.size ());
  set.cloud_index.resize (entries.size ());
  parallelRanges (entries.size (), threads, [&] (std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      set.positions[e] = scaled (entries[e].row);
      set.cloud_index[e] = cloud_index[entries[e].row];
    }
  });
  leaveDuplicatesOut (set);
  return set;
}

} // namespace floater
} // namespace pcl
