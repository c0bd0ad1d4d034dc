// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/points.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"

namespace pcl::floater {
namespace {
constexpr int HILBERT_BITS = 21; // of each coordinate

// The curve of Skilling (2004), "Programming the Hilbert curve": from the highest bit down, excess
// rotations are undone in all lower bits, and the rest is Gray-encoded.
std::uint64_t
codeOf (const Eigen::Array3d& place)
{
  Eigen::Array<std::uint32_t, 3, 1> cell = place.cast<std::uint32_t> ();
  std::uint64_t code = 0;
  std::uint32_t parity = 0; // 1: all lower bits of the code are inverted
  for (int bit = HILBERT_BITS - 1; bit >= 0; --bit) {
    const std::uint32_t lower = (1U << bit) - 1U;
    std::uint32_t gray = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const std::uint32_t is_set = cell[i] >> bit & 1U;
      gray ^= is_set;
      code = code << 1U | (gray ^ parity);
      // Without a branch: inverts the lower bits of the first axis, or exchanges them.
      const std::uint32_t exchanged = (cell[0] ^ cell[i]) & lower & (is_set - 1U);
      cell[0] ^= exchanged | (lower & (0U - is_set));
      cell[i] ^= exchanged;
    }
    parity ^= gray;
  }
  return code;
}

// A position in units of cells. All axes have the same cell size: the curve follows distance, not
// the shape of the box.
Eigen::Array3d
inCells (const Vector3d& position)
{
  constexpr double CELLS = static_cast<double> (1U << HILBERT_BITS) - 1.0;
  return CELLS * (position.array () + 0.5);
}

// The code of a curve within the cell of a position: beside a piece many times as large, a whole object
// may lie in a few cells.
std::uint64_t
hilbertCodeInCell (const Vector3d& position)
{
  const Eigen::Array3d place = inCells (position);
  return codeOf (static_cast<double> (1U << HILBERT_BITS) * (place - place.floor ()));
}

// Points of a piece of the cloud, which stays in memory during random access, up to 100 MB: the
// others may be in a mapped file.
constexpr std::size_t PART = std::size_t{1} << 22U;

// Equal but for rounding, as where sines and cosines close a circle: in multiples of 2e-16, which is
// the precision of a coordinate of 1. Near the origin, numbers differ by less.
bool
areEqual (const Vector3d& a, const Vector3d& b)
{
  const auto rounded = [] (const Vector3d& p) {
    constexpr double UNIT = 1.5; // coordinates are below 1/2
    return Vector3d ((p.array () + UNIT) - UNIT);
  };
  return a == b || rounded (a) == rounded (b);
}

// Equal points are consecutive; that with the smallest cloud index represents the others.
void
leaveDuplicatesOut (Points& points)
{
  const std::size_t n = points.positions.size ();
  std::size_t kept = 0;
  for (std::size_t first = 0, last = 0; first < n; first = last) {
    std::size_t smallest = first;
    for (last = first + 1; last < n && areEqual (points.positions[first], points.positions[last]);
         ++last)
      if (points.cloud_index[last] < points.cloud_index[smallest])
        smallest = last;
    for (std::size_t p = first; p < last; ++p)
      if (p != smallest)
        points.duplicates.push_back ({points.cloud_index[p], points.cloud_index[smallest]});
    points.positions[kept] = points.positions[smallest];
    points.cloud_index[kept] = points.cloud_index[smallest];
    ++kept;
  }
  points.positions.resize (kept);
  points.cloud_index.resize (kept);
  std::sort (points.duplicates.begin (), points.duplicates.end ());
}

// Whether nearly all points, seen from one of them, lie in the directions of one line. Small
// objects far apart are on a line within rounding, but not as seen from a point of one. The point
// in the middle of the order is in the larger of two objects.
bool
isLineSeenFromWithin (const Positions& positions)
{
  constexpr double STRAIGHT = 1e-4; // sine of an angle; near points are rounded more
  const Vector3d& from = positions[positions.size () / 2];
  Vector3d farthest = Vector3d::Zero ();
  for (const Vector3d& p : positions)
    if ((p - from).squaredNorm () > farthest.squaredNorm ())
      farthest = p - from;
  const Vector3d direction = farthest.stableNormalized ();
  std::size_t beside = 0;
  for (const Vector3d& p : positions)
    beside += direction.cross (p - from).norm () > STRAIGHT * (p - from).norm () ? 1 : 0;
  return 4 * beside < positions.size ();
}

// A row of the input, and the place of its position along the curve.
struct Key
{
  std::uint64_t code;
  Index row;
};

// Takes the finite positions along the Hilbert curve in the frame of the points, then along the curve
// in each cell, then by coordinates; of equal positions, the smallest cloud index first.
void
takeAlongCurve (const Positions& positions, const std::vector<Index>& cloud_index,
                const RunContext& run, Points& points)
{
  const auto scaled = [&] (Index row) -> Vector3d {
    return (positions[row] - points.centre) / points.scale;
  };
  std::vector<Key> keys;
  keys.reserve (positions.size ());
  for (Index row = 0; row < positions.size (); ++row)
    if (positions[row].allFinite ())
      keys.push_back ({0, row});
  parallelPoints (run, keys.size (),
                  [&] (Index i) { keys[i].code = hilbertCode (scaled (keys[i].row)); });
  const auto isLess = [&] (const Key& one, const Key& other) {
    if (one.code != other.code)
      return one.code < other.code;
    const Vector3d a = scaled (one.row), b = scaled (other.row);
    if (a == b)
      return cloud_index[one.row] < cloud_index[other.row];
    const std::uint64_t code_of_a = hilbertCodeInCell (a), code_of_b = hilbertCodeInCell (b);
    if (code_of_a != code_of_b)
      return code_of_a < code_of_b;
    return std::lexicographical_compare (a.begin (), a.end (), b.begin (), b.end ());
  };
  sortInParallel (keys.begin (), keys.end (), isLess, run);
  points.positions.resize (keys.size ());
  points.cloud_index.resize (keys.size ());
  for (std::size_t first = 0; first < positions.size (); first += PART)
    for (std::size_t p = 0; p < keys.size (); ++p)
      if (const Index row = keys[p].row; row >= first && row - first < PART) {
        points.positions[p] = scaled (row);
        points.cloud_index[p] = cloud_index[row];
      }
}

// Removes the points that stand on removed ones, and renumbers the others.
void
removeStacked (StackedPoints& stacked, const std::vector<Index>& removed,
               std::vector<Index>& cloud_indices)
{
  std::vector<Index> gone;
  for (Index i = 0; i < stacked.of.size (); ++i) {
    const auto place = std::lower_bound (removed.begin (), removed.end (), stacked.of[i]);
    if (place != removed.end () && *place == stacked.of[i]) {
      gone.push_back (i);
      cloud_indices.push_back (stacked.cloud_index[i]);
    }
    stacked.of[i] -= static_cast<Index> (place - removed.begin ());
  }
  eraseRows (stacked.positions, gone);
  eraseRows (stacked.cloud_index, gone);
  eraseRows (stacked.of, gone);
}

} // namespace

std::uint64_t
hilbertCode (const Vector3d& position)
{
  return codeOf (inCells (position));
}

Points
makePoints (const Positions& positions, const std::vector<Index>& cloud_index,
            const RunContext& run)
{
  Points points;
  Eigen::AlignedBox3d box;
  for (std::size_t row = 0; row < positions.size (); ++row)
    if (positions[row].allFinite ())
      box.extend (positions[row]);
    else
      points.non_finite.push_back (cloud_index[row]);
  std::sort (points.non_finite.begin (), points.non_finite.end ());
  if (box.isEmpty ())
    return points;

  points.centre = 0.5 * box.min () + 0.5 * box.max ();
  // Both sides: the centre of a tiny box may be rounded to one of its ends.
  const Vector3d half_size = (box.max () - points.centre).cwiseMax (points.centre - box.min ());
  const double diagonal = 2.0 * half_size.stableNorm ();
  points.scale = diagonal > 0.0 ? diagonal : 1.0;
  takeAlongCurve (positions, cloud_index, run, points);
  leaveDuplicatesOut (points);
  return points;
}

Normals
normalsOfPoints (const Normals& normals, const Points& points)
{
  Normals of_points (normals.empty () ? 0 : points.size ());
  for (std::size_t first = 0; first < normals.size (); first += PART)
    for (std::size_t p = 0; p < of_points.size (); ++p) {
      const Index cloud_index = points.cloud_index[p];
      if (cloud_index < first || cloud_index - first >= PART)
        continue;
      // In double precision, squares of floats neither overflow nor underflow.
      const Vector3d given = normals[cloud_index].cast<double> ();
      const double length = given.norm ();
      const bool is_normal = std::isfinite (length) && length > 0.0;
      of_points[p] =
          is_normal ? Vector3f ((given / length).cast<float> ()) : Vector3f (Vector3f::Zero ());
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
  for (const Vector3d& position : points.positions)
    fit.add (position - points.positions.front ());
  const Vector3d spread = fit.principalAxes ().spread;
  // Coordinates come in single precision: a line is straight only to 1e-7 of its length.
  if (spread[1] < 1e-6 * spread[2] && isLineSeenFromWithin (points.positions))
    return {RunStatus::DEGENERATE,
            "all points lie on one line; a surface needs points in two directions"};
  return {};
}

std::vector<Index>
removePoints (Points& points, const std::vector<Index>& removed)
{
  std::vector<Index> cloud_indices = valuesAt (points.cloud_index, removed);
  removeStacked (points.stacked, removed, cloud_indices);
  std::sort (cloud_indices.begin (), cloud_indices.end ());
  for (auto* positions : {&points.positions, &points.stacked.own})
    eraseRows (*positions, removed);
  for (auto* normals : {&points.normals, &points.facing_normals})
    eraseRows (*normals, removed);
  eraseRows (points.cloud_index, removed);
  Eigen::AlignedBox3d box;
  for (const Vector3d& position : points.positions)
    box.extend (position);

  // By a power of two, which is exact: distances compare as before.
  const double diagonal = box.isEmpty () ? 0.0 : box.diagonal ().norm ();
  if (diagonal > 0.0) {
    int exponent = 0;
    std::frexp (diagonal, &exponent);
    const double factor =
        std::ldexp (1.0, -std::min (exponent, 0)); // diagonals of 1 stay as they are
    for (auto* positions : {&points.positions, &points.stacked.positions, &points.stacked.own})
      for (Vector3d& position : *positions)
        position *= factor;
    points.diagonal = factor * diagonal;
    points.scale /= factor;
  }
  return cloud_indices;
}

void
setAside (Points& points, const std::vector<Index>& kept, const RunContext& run)
{
  std::vector<Index> aside = indicesBelow (points.size ());
  eraseRows (aside, kept);
  StackedPoints stacked;
  stacked.positions = valuesAt (points.positions, aside);
  stacked.cloud_index = valuesAt (points.cloud_index, aside);
  const double scale = points.scale;
  removePoints (points, aside);
  for (Vector3d& position : stacked.positions)
    position *= scale / points.scale; // a power of two
  stacked.of.resize (aside.size ());
  const KdTree tree (points.positions, run, PointOrder::ALONG_CURVE);
  parallelPoints<std::vector<Neighbor>> (run, aside.size (), [&] (Index i, auto& found) {
    tree.nearest (stacked.positions[i], 1, found);
    stacked.of[i] = found.front ().point;
  });
  stacked.own = points.positions;
  std::vector<double> count (points.size (), 1.0);
  for (std::size_t i = 0; i < aside.size (); ++i) {
    points.positions[stacked.of[i]] += stacked.positions[i];
    count[stacked.of[i]] += 1.0;
  }
  for (Index p = 0; p < points.size (); ++p)
    if (count[p] > 1.0)
      points.positions[p] /= count[p];
  points.stacked = std::move (stacked);
}

Points
withStacked (const Points& points)
{
  Points all = points;
  const StackedPoints stacked = std::move (all.stacked);
  all.stacked = {};
  all.projected.clear ();
  all.positions = stacked.own;
  all.positions.insert (all.positions.end (), stacked.positions.begin (), stacked.positions.end ());
  all.cloud_index.insert (all.cloud_index.end (), stacked.cloud_index.begin (),
                          stacked.cloud_index.end ());
  for (Normals* normals : {&all.normals, &all.facing_normals})
    if (!normals->empty ())
      for (const Index p : stacked.of)
        normals->push_back ((*normals)[p]);
  return all;
}

} // namespace pcl::floater
