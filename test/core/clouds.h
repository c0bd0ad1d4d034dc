// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds: outlines and sheets with a known border, spheres, cubes, random points.
#pragma once

#include "core/geometry.h"
#include "core/types.h"
#include "surfaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <unordered_map>
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

inline double
between (RandomStream& random, double low, double high)
{
  return low + (high - low) * random.uniform ();
}

/// Each coordinate from 0 to 1.
inline Eigen::Vector3d
uniformVector (RandomStream& random)
{
  const double x = random.uniform (), y = random.uniform ();
  return {x, y, random.uniform ()};
}

inline Positions
randomPoints (std::size_t count, std::uint64_t seed)
{
  RandomStream random (seed);
  Positions points (count);
  for (Eigen::Vector3d& p : points)
    p = uniformVector (random);
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

/// Around the z axis.
inline Eigen::Vector3d
polar (double radius, double angle, double z = 0.0)
{
  return {radius * std::cos (angle), radius * std::sin (angle), z};
}

inline Outline
circle (double radius, double step)
{
  const int count = static_cast<int> (std::lround (2.0 * PI * radius / step));
  Outline outline;
  for (int i = 0; i < count; ++i)
    outline.emplace_back (polar (radius, 2.0 * PI * i / count).head<2> ());
  return outline;
}

/// Inside the first outline and outside the others, which lie in it.
inline bool
isInside (const std::vector<Outline>& outlines, const Eigen::Vector2d& p)
{
  bool inside = false;
  for (const Outline& outline : outlines)
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
      bool within = isInside (outlines, p);
      for (std::size_t i = 0; within && i < border.size (); ++i)
        within = (border[i] - p).squaredNorm () > 0.36 * step * step;
      if (within)
        sheet.positions.emplace_back (p.x (), p.y (), 0.0);
    }
  return sheet;
}

/// What a sensor at the origin sees of a wavy wall, one side of which may stand behind the other.
inline Positions
wallInView (std::size_t side, double step = 0.0)
{
  Positions points;
  for (std::size_t i = 0; i < side * side; ++i) {
    const double x = static_cast<double> (i % side) / static_cast<double> (side) - 0.5;
    const double y = static_cast<double> (i / side) / static_cast<double> (side) - 0.5;
    const double depth = 2.0 + 0.3 * std::sin (9.0 * x + 5.0 * y) + (x > 0.2 ? step : 0.0);
    points.push_back (depth * Eigen::Vector3d (x, y, 1.0).normalized ());
  }
  return points;
}

/// A round sheet of radius 1 with points about `step` apart.
inline Sheet
disc (double step, std::uint64_t seed)
{
  return fillOutlines ({circle (1.0, step)}, step, 0.35, seed);
}

/// Evenly spread points of a unit sphere.
inline Positions
evenSphere (std::size_t count, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero ())
{
  Positions points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back (centre + spiralDirection (i, count));
  return points;
}

/// The points of a lattice on the faces of a cube from 0 to `last`.
inline Positions
latticeCube (int last)
{
  Positions points;
  for (int x = 0; x <= last; ++x)
    for (int y = 0; y <= last; ++y)
      for (int z = 0; z <= last; ++z)
        if (x % last == 0 || y % last == 0 || z % last == 0)
          points.emplace_back (x, y, z);
  return points;
}

const Eigen::Vector3d ON_A_MAP (5e5, 5.5e6, 300.0);

/// \param noise in spacings
inline Positions
surface (SurfaceKind kind, std::size_t points, double noise = 0.0, double density_ratio = 1.0)
{
  return generateSurface ({kind, points, 1, density_ratio, noise});
}

inline Positions
placed (Positions cloud, const Eigen::Vector3d& place, double scale = 1.0)
{
  for (Eigen::Vector3d& p : cloud)
    p = place + scale * p;
  return cloud;
}

inline Positions
joined (Positions a, const Positions& b)
{
  a.insert (a.end (), b.begin (), b.end ());
  return a;
}

/// Points of a grid in z = 0, `spacing` apart, each moved by up to `jitter` spacings in x and y.
inline Positions
jitteredGrid (int columns, int rows, double spacing, double jitter, RandomStream& random)
{
  Positions points;
  for (int x = 0; x < columns; ++x)
    for (int y = 0; y < rows; ++y) {
      const double dx = jitter * random.uniform (), dy = jitter * random.uniform ();
      points.emplace_back (spacing * (x + dx), spacing * (y + dy), 0.0);
    }
  return points;
}

inline Eigen::Vector3d
normalVector (RandomStream& random)
{
  const double x = random.normal (), y = random.normal ();
  return {x, y, random.normal ()};
}

/// The fixed points, then of the darts thrown those at least 0.8 away from all before them.
/// If they are thrown until none fits, about one for each unit of area stays.
inline Positions
throwDarts (const Positions& fixed, double area,
            const std::function<Eigen::Vector3d (RandomStream&)>& throwDart, std::uint64_t seed)
{
  static constexpr double DISTANCE = 0.8, DARTS_PER_POINT = 25.0;
  Positions kept;
  std::unordered_map<long, Positions> cells; // some share a key by chance, which only costs time
  const auto keyOf = [] (const Eigen::Vector3d& p) {
    const Eigen::Array3d at = (p / DISTANCE).array ().floor ();
    return static_cast<long> (at.x ()) + 10007 * static_cast<long> (at.y ()) +
           100140049 * static_cast<long> (at.z ());
  };
  const auto keep = [&] (const Eigen::Vector3d& p) {
    kept.push_back (p);
    cells[keyOf (p)].push_back (p);
  };
  const auto isNear = [&] (const Eigen::Vector3d& p, const Eigen::Vector3d& in_cell) {
    const auto cell = cells.find (keyOf (in_cell));
    return cell != cells.end () &&
           std::any_of (cell->second.begin (), cell->second.end (),
                        [&p] (const Eigen::Vector3d& q) { return (p - q).norm () < DISTANCE; });
  };
  std::for_each (fixed.begin (), fixed.end (), keep);
  RandomStream random (seed);
  for (int dart = 0; dart < DARTS_PER_POINT * area; ++dart) {
    const Eigen::Vector3d p = throwDart (random);
    bool fits = true;
    for (int cell = 0; fits && cell < 27; ++cell)
      fits = !isNear (p, p + DISTANCE *
                                 Eigen::Vector3d (cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1));
    if (fits)
      keep (p);
  }
  return kept;
}

/// Area inside the first outline and outside the others.
inline double
areaOf (const std::vector<Outline>& outlines)
{
  double area = 0.0;
  for (const Outline& outline : outlines) {
    double twice = 0.0;
    for (std::size_t i = 0; i < outline.size (); ++i)
      twice += cross (outline[i], outline[(i + 1) % outline.size ()]);
    area += (&outline == &outlines.front () ? 0.5 : -0.5) * std::abs (twice);
  }
  return area;
}

/// A random point inside the first outline and outside the others.
inline Eigen::Vector2d
randomInside (const std::vector<Outline>& outlines, RandomStream& random)
{
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : outlines.front ())
    box.extend (p);
  for (;;) {
    const double x = random.uniform (), y = random.uniform ();
    const Eigen::Vector2d p = box.min () + box.sizes ().cwiseProduct (Eigen::Vector2d (x, y));
    if (isInside (outlines, p))
      return p;
  }
}

inline Outline
rectangle (double width, double height, const Eigen::Vector2d& corner = {0.0, 0.0})
{
  return {corner, corner + Eigen::Vector2d (width, 0.0), corner + Eigen::Vector2d (width, height),
          corner + Eigen::Vector2d (0.0, height)};
}

} // namespace pcl::floater::samples
