// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parallel.h"
#include "texture/charts.h"

namespace pcl::floater {
Positions
areaVectors (const TriangleMesh& mesh, const Positions& positions, const RunContext& run)
{
  std::vector<Vector3d> vectors (mesh.triangles.size ());
  parallelPoints (run, vectors.size (),
                  [&] (Index t) { vectors[t] = areaVectorOf (mesh.triangles[t], positions); });
  return vectors;
}

MeshComponents
growFacets (const TriangleMesh& mesh, const Positions& positions,
            const std::vector<Vector3d>& area_vectors, const ChartLimits& limits,
            const RunContext& run)
{
  // Largest angle between a triangle and the mean normal of its facet, as 1 - cos: 25 degrees, below
  // the edges of machined parts (30 and more) and above the curvature of good samplings.
  constexpr double MOST_DEVIATION = 0.1;
  // Weight of a triangle's distance to the middle of a facet, in radii of the facet, against its
  // deviation: in flat regions, facets become round.
  constexpr double ROUNDNESS = 0.01;
  MeshComponents facets;
  facets.of_triangle.assign (mesh.triangles.size (), NONE);
  const std::size_t most =
      std::clamp<std::size_t> (mesh.triangles.size () / limits.facets, 1, limits.most_in_facet);
  std::vector<Index> facet_of_point (positions.size (), NONE); // the latest one of each point
  std::vector<Index> border; // triangles beside the facet; some may be taken already
  Vector3d sum, middle;
  double area = 0.0;
  const auto add = [&] (Index t) {
    facets.of_triangle[t] = facets.count;
    for (const Index p : mesh.triangles[t])
      facet_of_point[p] = facets.count;
    for (const Index other : mesh.neighbors[t])
      if (other != NONE && facets.of_triangle[other] == NONE)
        border.push_back (other);
    const double of_triangle = area_vectors[t].norm ();
    sum += area_vectors[t];
    middle += of_triangle * middleOf (mesh.triangles[t], positions);
    area += of_triangle;
  };
  // Whether a facet that is a disc stays one: its common border with the triangle is one path.
  const auto keepsDisc = [&] (Index t) {
    std::size_t points = 0, edges = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      points += facet_of_point[mesh.triangles[t][i]] == facets.count ? 1 : 0;
      const Index other = mesh.neighbors[t][i];
      edges += other != NONE && facets.of_triangle[other] == facets.count ? 1 : 0;
    }
    return points == edges + 1;
  };
  // The flattest and nearest triangle beside the facet, NONE if none is flat enough.
  const auto nextTriangle = [&] {
    border.erase (std::remove_if (border.begin (), border.end (),
                                  [&] (Index t) { return facets.of_triangle[t] != NONE; }),
                  border.end ());
    Index best = NONE;
    double least = std::numeric_limits<double>::infinity ();
    for (const Index t : border) {
      const double lengths = sum.norm () * area_vectors[t].norm ();
      const double deviation = lengths > 0.0 ? 1.0 - sum.dot (area_vectors[t]) / lengths : 0.0;
      if (deviation > MOST_DEVIATION)
        continue;
      const Vector3d own = middleOf (mesh.triangles[t], positions);
      const double distance = area > 0.0 ? (own - middle / area).squaredNorm () / area : 0.0;
      const double cost = deviation + ROUNDNESS * distance;
      if ((cost < least || (cost == least && t < best)) && keepsDisc (t)) {
        best = t;
        least = cost;
      }
    }
    return best;
  };
  ProgressLoop progress (run, mesh.triangles.size ());
  for (Index seed = 0; seed < mesh.triangles.size (); ++seed) {
    progress.next ();
    if (facets.of_triangle[seed] != NONE)
      continue;
    sum.setZero ();
    middle.setZero ();
    area = 0.0;
    border.clear ();
    add (seed);
    for (std::size_t size = 1; size < most; ++size) {
      const Index t = nextTriangle ();
      if (t == NONE)
        break;
      add (t);
    }
    ++facets.count;
  }
  return facets;
}

} // namespace pcl::floater
