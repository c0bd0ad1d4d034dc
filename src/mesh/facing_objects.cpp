// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/facing_objects.h"

#include <algorithm>
#include <utility>

namespace pcl
{
namespace floater
{
std::vector<FacingSums>
sumComponents (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const MeshComponents& found, const std::optional<Eigen::Vector3d>& sensor,
               const RunContext& run)
{
  std::vector<FacingSums> sums (found.count);
  std::vector<Index> origin (found.count, NONE); // volumes are measured from there, for precision
  ProgressLoop progress (run);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    progress.next ();
    const Triangle& corners = mesh.triangles[t];
    FacingSums& sum = sums[found.of_triangle[t]];
    if (sum.triangles++ == 0)
      origin[found.of_triangle[t]] = corners[0];
    const Eigen::Vector3d area_vector = areaVectorOf (corners, positions);
    const double area = area_vector.norm ();
    sum.area_vector += area_vector;
    sum.area += area;
    sum.volume +=
        (positions[corners[0]] - positions[origin[found.of_triangle[t]]]).dot (area_vector);
    for (std::size_t i = 0; i < 3; ++i) {
      sum.at = std::min (sum.at, corners[i]);
      sum.box.extend (positions[corners[i]]);
      sum.is_closed = sum.is_closed && mesh.neighbors[t][i] != NONE;
    }
    if (sensor) {
      const Eigen::Vector3d way = *sensor - middleOf (corners, positions);
      const double cube = way.squaredNorm () * way.norm ();
      const double solid_angle = cube > 0.0 ? way.dot (area_vector) / cube : 0.0;
      sum.seen += solid_angle;
      sum.in_sight += std::abs (solid_angle);
    }
  }
  return sums;
}

void
joinContinuations (std::vector<Continuation> continuations, SignedSets& sets)
{
  std::stable_sort (
      continuations.begin (), continuations.end (),
      [] (const Continuation& a, const Continuation& b) { return a.support > b.support; });
  for (const Continuation& one : continuations)
    sets.join (one.a, one.b, one.is_opposite);
}

FacingObjects
makeObjects (const std::vector<FacingSums>& components, SignedSets sets)
{
  FacingObjects objects;
  std::vector<Index> of_root (components.size (), NONE);
  for (Index c = 0; c < components.size (); ++c) {
    const SignedSets::Place place = sets.find (c);
    if (of_root[place.root] == NONE) {
      of_root[place.root] = static_cast<Index> (objects.sums.size ());
      objects.sums.emplace_back ();
    }
    objects.of_component.push_back (of_root[place.root]);
    objects.is_opposite.push_back (place.flipped ? 1 : 0);
    objects.sums[of_root[place.root]].add (components[c], objects.sign (c));
  }
  return objects;
}

} // namespace floater
} // namespace pcl
