// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/facets.h"

#include "core/geometry.h"
#include "core/parallel.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// Weight of a triangle's distance to the middle of a facet, in radii of the facet, against its
// deviation: in flat regions, facets become round.
constexpr double ROUNDNESS = 0.01;

class FacetGrower
{
public:
  FacetGrower (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const std::vector<Eigen::Vector3d>& area_vectors, const ChartLimits& limits,
               MeshParts& facets)
      : mesh_ (mesh), positions_ (positions), area_vectors_ (area_vectors), limits_ (limits),
        facets_ (facets), facet_of_point_ (positions.size (), NONE)
  {
  }

  void grow (Index seed, std::size_t most)
  {
    sum_ = Eigen::Vector3d::Zero ();
    middle_ = Eigen::Vector3d::Zero ();
    area_ = 0.0;
    size_ = 0;
    border_.clear ();
    add (seed);
    while (size_ < most) {
      const Index best = nextTriangle ();
      if (best == NONE)
        break;
      add (best);
    }
    ++facets_.count;
  }

private:
  Eigen::Vector3d middleOf (Index t) const
  {
    const Triangle& corners = mesh_.triangles[t];
    return (positions_[corners[0]] + positions_[corners[1]] + positions_[corners[2]]) / 3.0;
  }

  void add (Index t)
  {
    facets_.of_triangle[t] = facets_.count;
    for (const Index p : mesh_.triangles[t])
      facet_of_point_[p] = facets_.count;
    for (const Index other : mesh_.neighbors[t])
      if (other != NONE && facets_.of_triangle[other] == NONE)
        border_.push_back (other);
    const double area = area_vectors_[t].norm ();
    sum_ += area_vectors_[t];
    middle_ += area * middleOf (t);
    area_ += area;
    ++size_;
  }

  // Whether a facet that is a disc stays one: its common border with the triangle is one path.
  bool keepsDisc (Index t) const
  {
    std::size_t points = 0, edges = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      points += facet_of_point_[mesh_.triangles[t][i]] == facets_.count ? 1 : 0;
      const Index other = mesh_.neighbors[t][i];
      edges += other != NONE && facets_.of_triangle[other] == facets_.count ? 1 : 0;
    }
    return points == edges + 1;
  }

  // The flattest and nearest triangle beside the facet, NONE if none is flat enough.
  Index nextTriangle ()
  {
    Index best = NONE;
    double least = 0.0;
    const double length = sum_.norm ();
    for (std::size_t i = 0; i < border_.size ();) {
      const Index t = border_[i];
      if (facets_.of_triangle[t] != NONE) {
        border_[i] = border_.back ();
        border_.pop_back ();
        continue;
      }
      ++i;
      const double area = area_vectors_[t].norm ();
      const double lengths = length * area;
      const double deviation = lengths > 0.0 ? 1.0 - sum_.dot (area_vectors_[t]) / lengths : 0.0;
      if (deviation > limits_.facet_deviation)
        continue;
      const double distance =
          area_ > 0.0 ? (middleOf (t) - middle_ / area_).squaredNorm () / area_ : 0.0;
      const double cost = deviation + ROUNDNESS * distance;
      if ((best == NONE || cost < least || (cost == least && t < best)) && keepsDisc (t)) {
        best = t;
        least = cost;
      }
    }
    return best;
  }

  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Eigen::Vector3d>& area_vectors_;
  const ChartLimits& limits_;
  MeshParts& facets_;
  std::vector<Index> facet_of_point_; // the latest one of each point
  std::vector<Index> border_;         // triangles beside the facet; some may be taken already
  Eigen::Vector3d sum_, middle_;
  double area_ = 0.0;
  std::size_t size_ = 0;
};

} // namespace

std::vector<Eigen::Vector3d>
areaVectors (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const RunContext& run)
{
  std::vector<Eigen::Vector3d> vectors (mesh.triangles.size ());
  parallelRanges (run, vectors.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const Triangle& corners = mesh.triangles[t];
      vectors[t] = areaVector (positions[corners[0]], positions[corners[1]], positions[corners[2]]);
    }
  });
  return vectors;
}

MeshParts
growFacets (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            const std::vector<Eigen::Vector3d>& area_vectors, const ChartLimits& limits,
            const RunContext& run)
{
  MeshParts facets;
  facets.of_triangle.assign (mesh.triangles.size (), NONE);
  const std::size_t most =
      std::clamp<std::size_t> (mesh.triangles.size () / limits.facets, 1, limits.most_in_facet);
  FacetGrower grower (mesh, positions, area_vectors, limits, facets);
  ProgressLoop progress (run, mesh.triangles.size ());
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    if (facets.of_triangle[t] == NONE)
      grower.grow (static_cast<Index> (t), most);
    progress.next ();
  }
  return facets;
}

} // namespace pcl::floater
