// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Even but irregular samples of a surface: darts that keep their distance from each other.
#pragma once

#include "samples.h"

#include <functional>
#include <unordered_map>

namespace pcl::floater::samples {
struct Dart
{
  Eigen::Vector3d position;
  double spacing = 1.0; ///< wanted around it
};

/// Least distance between two darts, in spacings. Darts thrown until none fits come out at about
/// one for each squared spacing.
constexpr double DART_DISTANCE = 0.8;

/// Darts thrown for each one that is expected to stay.
constexpr double DARTS_PER_POINT = 25.0;

/// The fixed darts, then of those thrown the ones that keep DART_DISTANCE from all before them.
/// \param area   of the surface, in units of the smallest spacing squared
/// \param throwDart a random dart on the surface; how evenly does not matter much
inline Positions
throwDarts (std::vector<Dart> darts, double area,
            const std::function<Dart (RandomStream&)>& throwDart, RandomStream& random)
{
  const std::size_t fixed = darts.size ();
  const std::size_t thrown = static_cast<std::size_t> (DARTS_PER_POINT * area);
  for (std::size_t i = 0; i < thrown; ++i)
    darts.push_back (throwDart (random));
  double cell = 0.0;
  for (const Dart& dart : darts)
    cell = std::max (cell, DART_DISTANCE * dart.spacing);

  // Cells that share a key by chance only cost time.
  const auto keyOf = [cell] (const Eigen::Vector3d& p) {
    const Eigen::Array3d at = (p / cell).array ().floor ();
    return static_cast<long> (at.x ()) + 10007 * static_cast<long> (at.y ()) +
           100140049 * static_cast<long> (at.z ());
  };
  const auto conflict = [] (const Dart& a, const Dart& b) {
    return (a.position - b.position).norm () < DART_DISTANCE * 0.5 * (a.spacing + b.spacing);
  };
  Positions kept;
  std::unordered_map<long, std::vector<Dart>> grid;
  for (std::size_t i = 0; i < darts.size (); ++i) {
    const Dart& dart = darts[i];
    bool fits = true;
    for (int corner = 13; i >= fixed && fits && corner < 13 + 27; ++corner) { // its own cell first
      const Eigen::Vector3d step (corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 % 3 - 1);
      const auto found = grid.find (keyOf (dart.position + cell * step));
      if (found == grid.end ())
        continue;
      for (const Dart& other : found->second)
        fits = fits && !conflict (dart, other);
    }
    if (!fits)
      continue;
    grid[keyOf (dart.position)].push_back (dart);
    kept.push_back (dart.position);
  }
  return kept;
}

inline double
areaOf (const Outline& outline)
{
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size (); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size ()];
    twice += a.x () * b.y () - a.y () * b.x ();
  }
  return 0.5 * std::abs (twice);
}

inline Outline
rectangle (double width, double height)
{
  return {{0, 0}, {width, 0}, {width, height}, {0, height}};
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

} // namespace pcl::floater::samples
