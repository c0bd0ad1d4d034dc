// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Even but irregular points, and outlines in the plane that bound them.
#pragma once

#include "samples.h"
#include "surfaces.h"

#include <functional>
#include <unordered_map>

namespace pcl::floater::samples {
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
    for (std::size_t i = 0; i < outline.size (); ++i) {
      const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size ()];
      twice += a.x () * b.y () - a.y () * b.x ();
    }
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
    bool within = isInside (outlines.front (), p);
    for (std::size_t hole = 1; within && hole < outlines.size (); ++hole)
      within = !isInside (outlines[hole], p);
    if (within)
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
