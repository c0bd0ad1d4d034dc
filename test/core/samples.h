// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the core and of its first stages on a cloud, and what tests expect of them.
#pragma once

#include "clouds.h"
#include "local/local_geometry.h"
#include "mesh_oracle.h"
#include "points/kd_tree.h"
#include "points/neighbors.h"
#include "points/points.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <set>

namespace pcl::floater::samples {
/// Points and the geometry around each of them.
struct Neighborhoods
{
  Points points;
  LocalGeometry geometry;
};

inline Neighborhoods
makeNeighborhoods (const Positions& positions, bool filter_sheets = true)
{
  const StarSettings settings{filter_sheets};
  Neighborhoods made{makePoints (positions, indices (positions.size ()), 1), {}};
  LocalPlanes planes =
      beginPlanes (made.points, findNeighbors (made.points, {}, 1), {}, settings, 1);
  planes = fitLocalPlanes (made.points, std::move (planes), settings, 1);
  made.geometry = makeLocalGeometry (made.points, std::move (planes), settings, 1);
  return made;
}

/// The nearest of each point, so many.
inline CsrLists
nearestOf (const Positions& positions, int count)
{
  return findNearestNeighbors (positions, Rows::all (positions.size ()), count, 1);
}

/// Of some directions from a point, the largest angle between neighbours.
inline double
widestGap (std::vector<double> angles)
{
  std::sort (angles.begin (), angles.end ());
  double widest = angles.front () + 2.0 * PI - angles.back ();
  for (std::size_t i = 1; i < angles.size (); ++i)
    widest = std::max (widest, angles[i] - angles[i - 1]);
  return widest;
}

/// A cycle that begins at its smallest member and goes on to the smaller of the two next to it.
inline std::vector<Index>
canonicalCycle (std::vector<Index> cycle)
{
  if (cycle.size () < 3)
    return cycle;
  std::rotate (cycle.begin (), std::min_element (cycle.begin (), cycle.end ()), cycle.end ());
  if (cycle.back () < cycle[1])
    std::reverse (cycle.begin () + 1, cycle.end ());
  return cycle;
}

/// Triangles as a set that does not depend on their order and orientation.
inline std::set<Triangle>
unordered (const std::vector<Triangle>& triangles)
{
  std::set<Triangle> sorted;
  for (Triangle t : triangles) {
    std::sort (t.begin (), t.end ());
    sorted.insert (t);
  }
  return sorted;
}

/// Expects an oriented manifold of so many vertices, components and boundary loops.
inline MeshTopology
expectTopology (const std::vector<Triangle>& triangles, std::size_t vertices,
                std::size_t components, long euler, std::size_t loops)
{
  MeshTopology topology = topologyOf (triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, vertices);
  EXPECT_EQ (topology.components, components);
  EXPECT_EQ (topology.euler, euler);
  EXPECT_EQ (topology.loops.size (), loops);
  return topology;
}

inline double
areaOf (const Triangle& t, const Positions& positions)
{
  return 0.5 * areaVector (positions[t[0]], positions[t[1]], positions[t[2]]).norm ();
}

inline double
areaOf (const std::vector<Triangle>& triangles, const Positions& positions)
{
  double area = 0.0;
  for (const Triangle& t : triangles)
    area += areaOf (t, positions);
  return area;
}

/// Input of the core without indices.
inline Input
asInput (const Positions& positions, NeighborSearch* search = nullptr)
{
  return {positions, indices (positions.size ()), positions.size (), search};
}

/// The mesh of points; a run without success is a failure of the test.
inline Result
meshOf (const Positions& positions, const Options& options = {})
{
  Result result = reconstruct (asInput (positions), options);
  EXPECT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  return result;
}

/// The default options, but always with the method of TW 385; and a loop, if it is given.
inline Options
discOptions (const std::vector<Index>& loop = {})
{
  Options options;
  options.topology = floater::Topology::DISC;
  options.disc.boundary.loop = loop;
  return options;
}

inline bool
warns (const Report& report, const std::string& words)
{
  return std::any_of (
      report.warnings.begin (), report.warnings.end (),
      [&words] (const std::string& warning) { return warning.find (words) != std::string::npos; });
}

inline Points
workingPoints (const Positions& positions)
{
  return makePoints (positions, indices (positions.size ()), 1);
}

/// The k nearest points, nearest first, by trying all.
inline std::vector<Neighbor>
nearestByTryingAll (const Positions& points, const Eigen::Vector3d& query, std::size_t k)
{
  std::vector<Neighbor> all;
  for (Index p = 0; p < points.size (); ++p)
    all.push_back ({(points[p] - query).squaredNorm (), p});
  const std::size_t count = std::min (k, all.size ());
  std::partial_sort (all.begin (), all.begin () + static_cast<std::ptrdiff_t> (count), all.end ());
  all.resize (count);
  return all;
}

} // namespace pcl::floater::samples
