// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/seam_components.h"

#include "core/disjoint_sets.h"

#include <algorithm>
#include <utility>

namespace pcl::floater {
SeamComponents
joinComponents (const JoinedPoints& points, const TriangleMesh& mesh, std::size_t seam,
                const NearTriangles& near, const std::vector<InnerCheck>& checks)
{
  // Elements of the sets: the points, then the components of all parts.
  std::vector<Index> begins (1, static_cast<Index> (points.size ()));
  for (const InnerCheck& check : checks)
    begins.push_back (begins.back () + static_cast<Index> (check.components.size ()));
  DisjointSets sets (begins.back ());
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    const Triangle& corners = mesh.triangles[t];
    if (t < seam) {
      sets.join (corners[0], corners[1]);
      sets.join (corners[0], corners[2]);
      continue;
    }
    const Index component = near.component[t - seam];
    if (component == NONE)
      continue;
    for (const Index p : corners)
      if (!mesh.isPartial (p))
        sets.join (p, begins[near.part[t - seam]] + component);
  }
  const auto isUsed = [&mesh] (Index p) {
    return !mesh.isPartial (p) && mesh.triangle_of[p] != NONE;
  };

  // The smallest point of each set, by its representative.
  std::vector<Index> first (begins.back (), NONE);
  const auto note = [&] (Index element, Index point) {
    Index& smallest = first[sets.find (element)];
    smallest = std::min (smallest, point);
  };
  for (Index p = 0; p < points.size (); ++p)
    if (isUsed (p))
      note (p, points.pointAt (p));
  for (std::size_t part = 0; part < checks.size (); ++part)
    for (Index c = 0; c < checks[part].components.size (); ++c)
      note (begins[part] + c, checks[part].components[c].sum.sum.at);
  std::vector<std::pair<Index, Index>> roots; // by their smallest points
  for (Index element = 0; element < first.size (); ++element)
    if (first[element] != NONE)
      roots.emplace_back (first[element], element);
  std::sort (roots.begin (), roots.end ());

  SeamComponents components;
  std::vector<Index> number (begins.back (), NONE); // of each root
  for (const auto& [smallest, root] : roots) {
    number[root] = static_cast<Index> (components.first.size ());
    components.first.push_back (smallest);
  }
  components.points.assign (components.first.size (), 0);
  components.of_point.assign (points.size (), NONE);
  for (Index p = 0; p < points.size (); ++p)
    if (isUsed (p))
      ++components.points[components.of_point[p] = number[sets.find (p)]];
  for (std::size_t part = 0; part < checks.size (); ++part) {
    std::vector<Index>& of_part = components.of_inner.emplace_back ();
    for (Index c = 0; c < checks[part].components.size (); ++c) {
      of_part.push_back (number[sets.find (begins[part] + c)]);
      components.points[of_part.back ()] += checks[part].components[c].points;
    }
  }
  return components;
}

} // namespace pcl::floater
