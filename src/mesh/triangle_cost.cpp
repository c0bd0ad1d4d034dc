// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_cost.h"

namespace pcl::floater {
TriangleCost::Value
TriangleCost::operator() (Index a, Index b, Index c) const
{
  constexpr double LEAST_AREA = 1e-9; // doubled, over the sum of the squared edges: keeps the costs
                                      // of needles finite and comparable
  constexpr double LARGEST_AREA = 1e9;   // doubled, over the squared spacing, which may be 0: keeps
                                         // the costs of large triangles finite
  constexpr double TURNED_COST = 1000.0; // per unit of cosine below TURNED_COSINE
  // Of a shape; beyond, it costs as its logarithm: otherwise flips fold the surface to be rid of
  // needles, as between far lines. 50 and 200 gave the same verdicts but for one body of 120.
  constexpr double NEEDLE_COST = 100.0;
  constexpr double LARGE_AREA = 3.0;   // doubled, in squared spacings; above, a triangle is large
  constexpr double LARGE_COST = 100.0; // per squared spacing above LARGE_AREA
  // Starts with the smallest point, so that rounding does not depend on the order of the corners:
  // otherwise flips could cycle.
  if (b < a && b < c)
    return (*this) (b, c, a);
  if (c < a && c < b)
    return (*this) (c, a, b);
  const Vector3d ab = positions_[b] - positions_[a];
  const Vector3d ac = positions_[c] - positions_[a];
  const Vector3d bc = positions_[c] - positions_[b];
  const Vector3d area_vector = ab.cross (ac);
  const double double_area = area_vector.norm ();
  const double sqr_lengths = ab.squaredNorm () + ac.squaredNorm () + bc.squaredNorm ();
  // cot A + cot B + cot C = (a^2 + b^2 + c^2) / (4 area).
  // Squares of lengths below 1e-154 are 0: such triangles count as needles.
  const double cotangents =
      sqr_lengths > 0.0 ? sqr_lengths / (2.0 * std::max (double_area, LEAST_AREA * sqr_lengths))
                        : 0.5 / LEAST_AREA;
  const double turned =
      TURNED_COST * std::max (0.0, TURNED_COSINE - agreement (a, b, c, area_vector, double_area));
  const double shape = cotangents <= NEEDLE_COST
                           ? cotangents
                           : NEEDLE_COST * (1.0 + std::log (cotangents / NEEDLE_COST));
  Value result{area_vector, shape + turned};
  if (double_area > 0.0)
    result.unit_normal /= double_area;
  if (spacing_ != nullptr) {
    const double spacing = ((*spacing_)[a] + (*spacing_)[b] + (*spacing_)[c]) / 3.0;
    const double area = std::min (double_area / (spacing * spacing), LARGEST_AREA);
    result.cost += LARGE_COST * std::max (0.0, area - LARGE_AREA);
  }
  return result;
}

double
TriangleCost::agreement (Index a, Index b, Index c, const Vector3d& area_vector,
                         double double_area) const
{
  const Vector3f normal = normals_[a] + normals_[b] + normals_[c];
  const double length = normal.norm () * double_area;
  return length > 0.0 ? normal.cast<double> ().dot (area_vector) / length : 0.0;
}

bool
TriangleCost::isLong (const Triangle& corners) const
{
  if (spacing_ == nullptr)
    return false;
  double sqr_longest = 0.0, spacings = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index p = corners[i], q = corners[(i + 1) % 3];
    sqr_longest = std::max (sqr_longest, (positions_[q] - positions_[p]).squaredNorm ());
    spacings += static_cast<double> ((*spacing_)[p]);
  }
  const double longest = LONGEST_EDGE * spacings / 3.0;
  return sqr_longest > longest * longest;
}

bool
TriangleCost::isFlat (const Triangle& corners) const
{
  const Vector3d ab = positions_[corners[1]] - positions_[corners[0]],
                 ac = positions_[corners[2]] - positions_[corners[0]];
  constexpr double HEIGHT = std::numeric_limits<float>::epsilon ();
  return ab.cross (ac).norm () <= HEIGHT * std::max (ab.squaredNorm (), ac.squaredNorm ());
}

bool
TriangleCost::isTurned (const Triangle& corners) const
{
  const auto [a, b, c] = corners;
  const Vector3d area_vector = areaVector (positions_[a], positions_[b], positions_[c]);
  return agreement (a, b, c, area_vector, area_vector.norm ()) < TURNED_COSINE;
}

} // namespace pcl::floater
