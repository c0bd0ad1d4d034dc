// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/points.h"

#include "core/parallel.h"
#include "core/plane_fit.h"
#include "points/hilbert_curve.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
// Place of a position on the axes, in cells. One cell size for all: the curve is to follow
// distance, not the shape of the box.
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

std::uint64_t
curveCode (const Eigen::Vector3d& position)
{
  return codeOf (inCells (position));
}

// Position on a curve through the 2^HILBERT_BITS cells a side into which a cell of the curve is
// divided.
std::uint64_t
codeInCell (const Eigen::Vector3d& position)
{
  const Eigen::Array3d place = inCells (position);
  return codeOf (static_cast<double> (1U << HILBERT_BITS) * (place - place.floor ()));
}

struct Entry
{
  std::uint64_t code;
  Index row;
};

// Both halves at the same time.
template <typename Before>
void
sortInHalves (std::vector<Entry>& entries, const RunContext& run, const Before& before)
{
  const auto middle = entries.begin () + static_cast<std::ptrdiff_t> (entries.size () / 2);
  parallelTasks (run, 2, [&] (std::size_t half) {
    std::sort (half == 0 ? entries.begin () : middle, half == 0 ? middle : entries.end (), before);
  });
  std::inplace_merge (entries.begin (), middle, entries.end (), before);
}

// Equal points are neighbours in the order; the first of them, that of the smallest cloud index,
// stands for the others.
void
leaveDuplicatesOut (Points& points)
{
  std::size_t kept = 0;
  for (std::size_t p = 0; p < points.positions.size (); ++p) {
    if (kept > 0 && points.positions[kept - 1] == points.positions[p]) {
      points.duplicates.push_back ({points.cloud_index[p], points.cloud_index[kept - 1]});
      continue;
    }
    points.positions[kept] = points.positions[p];
    points.cloud_index[kept] = points.cloud_index[p];
    ++kept;
  }
  points.positions.resize (kept);
  points.cloud_index.resize (kept);
  std::sort (points.duplicates.begin (), points.duplicates.end ());
}

// Whether the directions from a point to nearly all others are those of one line. Small objects far
// apart are within rounding of a line, but this point sees that its own object is none. It is the
// one in the middle of the order, so that it is in the largest of two.
bool
isLineSeenFromWithin (const std::vector<Eigen::Vector3d>& positions)
{
  constexpr double STRAIGHT = 1e-4; // sine of an angle; near points are rounded more
  const Eigen::Vector3d& from = positions[positions.size () / 2];
  Eigen::Vector3d farthest = Eigen::Vector3d::Zero ();
  for (const Eigen::Vector3d& p : positions)
    if ((p - from).squaredNorm () > farthest.squaredNorm ())
      farthest = p - from;
  const Eigen::Vector3d direction = farthest.stableNormalized ();
  std::size_t beside = 0;
  for (const Eigen::Vector3d& p : positions)
    beside += direction.cross (p - from).norm () > STRAIGHT * (p - from).norm () ? 1 : 0;
  return 4 * beside < positions.size ();
}

} // namespace

Points
makePoints (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& cloud_index,
            const RunContext& run)
{
  Points points;
  std::vector<Entry> entries;
  entries.reserve (positions.size ());
  Eigen::AlignedBox3d box;
  for (std::size_t row = 0; row < positions.size (); ++row) {
    if (positions[row].allFinite ()) {
      box.extend (positions[row]);
      entries.push_back ({0, static_cast<Index> (row)});
    }
    else {
      points.non_finite.push_back (cloud_index[row]);
    }
  }
  std::sort (points.non_finite.begin (), points.non_finite.end ());
  if (entries.empty ())
    return points;

  points.centre = 0.5 * box.min () + 0.5 * box.max ();
  // Both sides: the centre of a box as small as its digits may be rounded to one of its ends.
  const Eigen::Vector3d half_size =
      (box.max () - points.centre).cwiseMax (points.centre - box.min ());
  const double diagonal = 2.0 * half_size.stableNorm ();
  points.scale = diagonal > 0.0 ? diagonal : 1.0;

  const auto scaled = [&] (Index row) -> Eigen::Vector3d {
    return (positions[row] - points.centre) / points.scale;
  };
  parallelRanges (run, entries.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e)
      entries[e].code = curveCode (scaled (entries[e].row));
  });

  // Ties by a curve within the cell: next to a part that is many times as large, a whole object may
  // lie in a few cells. Then by coordinates, so that the order does not depend on that of the
  // cloud.
  const auto before = [&] (const Entry& a, const Entry& b) {
    if (a.code != b.code)
      return a.code < b.code;
    const Eigen::Vector3d p = scaled (a.row);
    const Eigen::Vector3d q = scaled (b.row);
    const std::uint64_t p_code = codeInCell (p);
    const std::uint64_t q_code = codeInCell (q);
    if (p_code != q_code)
      return p_code < q_code;
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] != q[axis])
        return p[axis] < q[axis];
    return cloud_index[a.row] < cloud_index[b.row];
  };
  sortInHalves (entries, run, before);

  points.positions.resize (entries.size ());
  points.cloud_index.resize (entries.size ());
  parallelRanges (run, entries.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      points.positions[e] = scaled (entries[e].row);
      points.cloud_index[e] = cloud_index[entries[e].row];
    }
  });
  leaveDuplicatesOut (points);
  return points;
}

std::vector<Eigen::Vector3f>
normalsOfPoints (const std::vector<Eigen::Vector3f>& normals, const Points& points)
{
  std::vector<Eigen::Vector3f> of_points;
  if (normals.empty ())
    return of_points;
  of_points.reserve (points.size ());
  for (const Index cloud_index : points.cloud_index) {
    // In double precision, where squares of floats neither overflow nor vanish.
    const Eigen::Vector3d given = normals[cloud_index].cast<double> ();
    const double length = given.norm ();
    const bool is_normal = std::isfinite (length) && length > 0.0;
    of_points.push_back (is_normal ? Eigen::Vector3f ((given / length).cast<float> ())
                                   : Eigen::Vector3f (Eigen::Vector3f::Zero ()));
  }
  return of_points;
}

Problem
checkPoints (const Points& points)
{
  constexpr std::size_t FEWEST = 4;
  const std::size_t n = points.positions.size ();
  if (n < FEWEST)
    return {RunStatus::TOO_FEW_POINTS, "only " + std::to_string (n) +
                                           " distinct finite points; at least " +
                                           std::to_string (FEWEST) + " are needed"};
  PlaneFit fit;
  for (const Eigen::Vector3d& position : points.positions)
    fit.add (position - points.positions.front ());
  const Eigen::Vector3d spread = fit.principalAxes ().spread;
  // Coordinates come in single precision: a line is straight only to 1e-7 of its length.
  if (spread[1] < 1e-6 * spread[2] && isLineSeenFromWithin (points.positions))
    return {RunStatus::DEGENERATE,
            "all points lie on one line; a surface needs points in two directions"};
  return {};
}

std::vector<Index>
removePoints (Points& points, const std::vector<Index>& removed)
{
  std::vector<Index> cloud_indices;
  Eigen::AlignedBox3d box;
  std::size_t kept = 0;
  for (Index p = 0; p < points.size (); ++p) {
    if (cloud_indices.size () < removed.size () && removed[cloud_indices.size ()] == p) {
      cloud_indices.push_back (points.cloud_index[p]);
      continue;
    }
    box.extend (points.positions[p]);
    points.positions[kept] = points.positions[p];
    points.cloud_index[kept] = points.cloud_index[p];
    for (std::vector<Eigen::Vector3f>* normals : {&points.normals, &points.facing_normals})
      if (!normals->empty ())
        (*normals)[kept] = (*normals)[p];
    ++kept;
  }
  points.positions.resize (kept);
  points.cloud_index.resize (kept);
  for (std::vector<Eigen::Vector3f>* normals : {&points.normals, &points.facing_normals})
    if (!normals->empty ())
      normals->resize (kept);
  std::sort (cloud_indices.begin (), cloud_indices.end ());

  // By a power of two, which is exact: distances compare as before.
  const double diagonal = kept > 0 ? box.diagonal ().norm () : 0.0;
  if (diagonal > 0.0) {
    int exponent = 0;
    std::frexp (diagonal, &exponent);
    exponent = std::min (exponent, 0); // a box of diagonal 1 stays as it is
    if (exponent != 0)
      for (Eigen::Vector3d& position : points.positions)
        position = Eigen::Vector3d (std::ldexp (position.x (), -exponent),
                                    std::ldexp (position.y (), -exponent),
                                    std::ldexp (position.z (), -exponent));
    points.diagonal = std::ldexp (diagonal, -exponent);
    points.scale = std::ldexp (points.scale, exponent);
  }
  return cloud_indices;
}

} // namespace floater
} // namespace pcl
