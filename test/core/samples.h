// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets with a known border, and other helpers for the tests of the stages.
#pragma once

#include "core/geometry.h"
#include "core/types.h"
#include "local/local_geometry.h"
#include "mesh_oracle.h"
#include "points/neighbors.h"
#include "surfaces.h"

#include <pcl/surface/floater/reconstruct.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace pcl::floater::samples {
using Positions = std::vector<Eigen::Vector3d>;
using Outline = std::vector<Eigen::Vector2d>;

using floater::PI;

inline std::vector<Index>
indices (std::size_t count)
{
  std::vector<Index> all (count);
  std::iota (all.begin (), all.end (), Index{0});
  return all;
}

/// A random order of 0 to count.
inline std::vector<Index>
permutation (std::size_t count, std::uint64_t seed)
{
  std::vector<Index> order = indices (count);
  RandomStream random (seed);
  for (std::size_t i = count; i > 1; --i)
    std::swap (order[i - 1], order[random.below (i)]);
  return order;
}

inline Positions
randomPoints (std::size_t count, std::uint64_t seed)
{
  RandomStream random (seed);
  Positions points (count);
  for (Eigen::Vector3d& p : points)
    p = {random.uniform (), random.uniform (), random.uniform ()};
  return points;
}

/// Points; the first ones are those of the outer border, in order.
struct Sheet
{
  Positions positions;
  std::size_t border = 0;
};

/// A closed polygon as points about `step` apart, its corners among them.
inline Outline
resample (const Outline& corners, double step)
{
  Outline outline;
  for (std::size_t i = 0; i < corners.size (); ++i) {
    const Eigen::Vector2d side = corners[(i + 1) % corners.size ()] - corners[i];
    const int steps = std::max (1, static_cast<int> (std::lround (side.norm () / step)));
    for (int s = 0; s < steps; ++s)
      outline.emplace_back (corners[i] + side * s / steps);
  }
  return outline;
}

inline Outline
circle (double radius, double step)
{
  const int count = static_cast<int> (std::lround (2.0 * PI * radius / step));
  Outline outline;
  for (int i = 0; i < count; ++i)
    outline.emplace_back (radius * std::cos (2.0 * PI * i / count),
                          radius * std::sin (2.0 * PI * i / count));
  return outline;
}

inline bool
isInside (const Outline& outline, const Eigen::Vector2d& p)
{
  bool inside = false;
  for (std::size_t i = 0; i < outline.size (); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size ()];
    if ((a.y () > p.y ()) != (b.y () > p.y ()) &&
        p.x () < a.x () + (p.y () - a.y ()) / (b.y () - a.y ()) * (b.x () - a.x ()))
      inside = !inside;
  }
  return inside;
}

/// A flat sheet in z = 0: the points of the outlines (the first is the outer border), and between
/// them a grid of cells of side `step` with one point in each, moved at random by up to `jitter` of
/// the side. No point of the grid is nearer to the border than 0.6 of the side.
inline Sheet
fillOutlines (const std::vector<Outline>& outlines, double step, double jitter, std::uint64_t seed)
{
  Sheet sheet;
  sheet.border = outlines.front ().size ();
  Eigen::AlignedBox2d box;
  Outline border;
  for (const Outline& outline : outlines)
    border.insert (border.end (), outline.begin (), outline.end ());
  for (const Eigen::Vector2d& p : border) {
    box.extend (p);
    sheet.positions.emplace_back (p.x (), p.y (), 0.0);
  }
  RandomStream random (seed);
  for (double y = box.min ().y (); y < box.max ().y (); y += step)
    for (double x = box.min ().x (); x < box.max ().x (); x += step) {
      const Eigen::Vector2d p (x + step * (0.5 + jitter * (2.0 * random.uniform () - 1.0)),
                               y + step * (0.5 + jitter * (2.0 * random.uniform () - 1.0)));
      bool within = isInside (outlines.front (), p);
      for (std::size_t hole = 1; hole < outlines.size (); ++hole)
        within = within && !isInside (outlines[hole], p);
      for (std::size_t i = 0; within && i < border.size (); ++i)
        within = (border[i] - p).squaredNorm () > 0.36 * step * step;
      if (within)
        sheet.positions.emplace_back (p.x (), p.y (), 0.0);
    }
  return sheet;
}

/// A round sheet of radius 1 with points about `step` apart.
inline Sheet
disc (double step, std::uint64_t seed)
{
  return fillOutlines ({circle (1.0, step)}, step, 0.35, seed);
}

/// Points and the geometry around each of them.
struct Neighborhoods
{
  Points points;
  LocalGeometry geometry;
};

inline Neighborhoods
makeNeighborhoods (const Positions& positions, bool filter_sheets = true, int threads = 1)
{
  Neighborhoods made;
  made.points = makePoints (positions, indices (positions.size ()), threads);
  const StarSettings settings{filter_sheets};
  made.geometry = makeLocalGeometry (
      made.points,
      fitLocalPlanes (made.points, findNeighbors (made.points, {}, threads), {}, settings, threads),
      settings, threads);
  return made;
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

/// Input of the core without indices.
inline Input
asInput (const Positions& positions, NeighborSearch* search = nullptr)
{
  return {positions, indices (positions.size ()), positions.size (), search};
}

/// The default options, but always with the method of TW 385.
inline Options
discOptions ()
{
  Options options;
  options.topology = floater::Topology::DISC;
  return options;
}

/// Evenly spread points of a unit sphere.
inline Positions
evenSphere (std::size_t count, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero ())
{
  Positions points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double> (i) + 1.0) / static_cast<double> (count);
    const double angle = PI * (3.0 - std::sqrt (5.0)) * static_cast<double> (i);
    const double radius = std::sqrt (1.0 - z * z);
    points.push_back (centre +
                      Eigen::Vector3d (radius * std::cos (angle), radius * std::sin (angle), z));
  }
  return points;
}

inline bool
warns (const Report& report, const std::string& words)
{
  return std::any_of (
      report.warnings.begin (), report.warnings.end (),
      [&words] (const std::string& warning) { return warning.find (words) != std::string::npos; });
}

/// A view from a place that is given.
inline Options
seenFrom (const Eigen::Vector3d& viewpoint)
{
  Options options;
  options.view.use = ViewUse::GIVEN;
  options.view.viewpoint = {viewpoint.x (), viewpoint.y (), viewpoint.z ()};
  return options;
}

} // namespace pcl::floater::samples
