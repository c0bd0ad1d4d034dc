// SPDX-License-Identifier: GPL-3.0-or-later
// How good the geometry of a mesh is, measured independently of the library.
#pragma once

#include "samples.h"

#include <fstream>
#include <iomanip>

namespace pcl
{
namespace floater
{
namespace samples
{
/// Mean distance of each point to its six nearest, by looking at all. Equal points do not count.
inline std::vector<double>
spacingByBruteForce (const Positions& points)
{
  constexpr std::size_t NEAREST = 6;
  std::vector<double> spacing;
  for (const Eigen::Vector3d& p : points) {
    std::array<double, NEAREST> nearest;
    nearest.fill (std::numeric_limits<double>::infinity ());
    for (const Eigen::Vector3d& q : points) {
      double sqr_distance = (q - p).squaredNorm ();
      if (sqr_distance == 0.0 || sqr_distance >= nearest.back ())
        continue;
      for (double& kept : nearest)
        if (sqr_distance < kept)
          std::swap (sqr_distance, kept);
    }
    double sum = 0.0;
    for (const double sqr : nearest)
      sum += std::sqrt (sqr);
    spacing.push_back (sum / NEAREST);
  }
  return spacing;
}

/// Sizes of a mesh.
struct Geometry
{
  double area = 0.0;
  double mean_edge = 0.0;             ///< in spacings at its ends
  double longest_edge = 0.0;          ///< in spacings at its ends
  Eigen::Vector3d longest_at;         ///< middle of that edge
  std::vector<Eigen::Vector3d> folds; ///< middles of edges between triangles over 120 degrees apart
};

inline Geometry
geometryOf (const std::vector<Triangle>& triangles, const Positions& points)
{
  constexpr double FOLDED = -0.5; // cosine
  Geometry geometry;
  geometry.longest_at.setZero ();
  std::map<std::pair<Index, Index>, Eigen::Vector3d> normals; // by directed edge
  for (const Triangle& t : triangles) {
    const Eigen::Vector3d normal =
        (points[t[1]] - points[t[0]]).cross (points[t[2]] - points[t[0]]);
    geometry.area += 0.5 * normal.norm ();
    for (std::size_t i = 0; i < 3; ++i)
      normals[{t[i], t[(i + 1) % 3]}] = normal.normalized ();
  }
  const std::vector<double> spacing = spacingByBruteForce (points);
  std::size_t edges = 0;
  for (const auto& [edge, normal] : normals) {
    const auto& [a, b] = edge;
    const auto twin = normals.find ({b, a});
    if (twin != normals.end () && b < a)
      continue;
    const Eigen::Vector3d middle = 0.5 * (points[a] + points[b]);
    const double length = (points[a] - points[b]).norm () / (0.5 * (spacing[a] + spacing[b]));
    ++edges;
    geometry.mean_edge += length;
    if (length > geometry.longest_edge) {
      geometry.longest_edge = length;
      geometry.longest_at = middle;
    }
    if (twin != normals.end () && normal.dot (twin->second) < FOLDED)
      geometry.folds.push_back (middle);
  }
  geometry.mean_edge /= static_cast<double> (std::max<std::size_t> (edges, 1));
  return geometry;
}

/// For a look at what a test made: a PLY file in text.
inline void
savePly (const std::string& path, const Positions& points, const std::vector<Triangle>& triangles)
{
  std::ofstream file (path);
  file << "ply\nformat ascii 1.0\nelement vertex " << points.size ()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
       << triangles.size () << "\nproperty list uchar int vertex_indices\nend_header\n"
       << std::setprecision (9);
  for (const Eigen::Vector3d& p : points)
    file << p.x () << ' ' << p.y () << ' ' << p.z () << '\n';
  for (const Triangle& t : triangles)
    file << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
}

} // namespace samples
} // namespace floater
} // namespace pcl
