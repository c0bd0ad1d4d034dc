// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/surface/floater/vertex_normals.h>

#include "core/parallel.h"
#include "mesh/vertex_stars.h"

namespace pcl::floater {
namespace {
// Contribution of a triangle to the normal of one of its corners.
struct CornerTerm
{
  double angle; // 0: nothing
  Vector3d normal;
};

CornerTerm
cornerTerm (const Vector3d& corner, const Vector3d& next, const Vector3d& previous)
{
  // Products of unit vectors neither overflow nor underflow. Degenerate triangles give zero or NaN.
  const Vector3d u = (next - corner).stableNormalized ();
  const Vector3d v = (previous - corner).stableNormalized ();
  const Vector3d across = u.cross (v);
  const double sine = across.norm ();
  if (!(sine > 0.0))
    return {0.0, Vector3d::Zero ()};
  return {std::atan2 (sine, u.dot (v)), across / sine};
}

// Sums the terms in a canonical order: the result does not depend on the order of the triangles.
Vector3f
meanNormal (std::vector<CornerTerm>& terms)
{
  std::sort (terms.begin (), terms.end (), [] (const CornerTerm& a, const CornerTerm& b) {
    return a.angle != b.angle
               ? a.angle < b.angle
               : std::lexicographical_compare (a.normal.data (), a.normal.data () + 3,
                                               b.normal.data (), b.normal.data () + 3);
  });
  Vector3d sum = Vector3d::Zero (); // avoids negative zeros
  double angles = 0.0;
  for (const CornerTerm& term : terms) {
    sum += term.angle * term.normal;
    angles += term.angle;
  }
  // Each term and each sum is rounded by half an epsilon; smaller sums are 0.
  const double length = sum.norm ();
  const double rounding =
      static_cast<double> (terms.size ()) * angles * std::numeric_limits<double>::epsilon ();
  if (!(length > rounding))
    return Vector3f::Zero ();
  return (sum / length).cast<float> ();
}

} // namespace

Normals
vertexNormals (const Positions& positions,
               const std::vector<std::array<std::uint32_t, 3>>& triangles, int threads)
{
  for (const auto& triangle : triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= positions.size ())
        throw std::out_of_range ("a triangle names point " + std::to_string (corner) + " of " +
                                 std::to_string (positions.size ()));
  Normals normals (positions.size ());
  const RunContext run (std::max (threads, 0));
  const TriangleRanges ranges (triangles, positions.size (), run);
  parallelTasks (run, ranges.count (), [&] (std::size_t r) {
    const VertexStars stars (triangles, ranges, r);
    std::vector<CornerTerm> terms;
    for (std::size_t p = ranges.firstPoint (r); p < ranges.lastPoint (r); ++p) {
      terms.clear ();
      for (const Wedge& wedge : stars.of (p)) {
        const CornerTerm term =
            cornerTerm (positions[p], positions[wedge.next], positions[wedge.previous]);
        if (term.angle > 0.0)
          terms.push_back (term);
      }
      normals[p] = meanNormal (terms);
    }
  });
  return normals;
}

} // namespace pcl::floater
