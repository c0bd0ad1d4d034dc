// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "darts.h"
#include "surface_samples.h"

namespace pcl::floater::samples {
namespace {
using Lift = std::function<Eigen::Vector3d (const Eigen::Vector2d&)>;

Outline
moved (Outline outline, const Eigen::Vector2d& by)
{
  for (Eigen::Vector2d& p : outline)
    p += by;
  return outline;
}

// Around a cylinder, without stretching.
Lift
bent (double radius)
{
  return [radius] (const Eigen::Vector2d& p) {
    return Eigen::Vector3d (radius * std::sin (p.x () / radius), p.y (),
                            radius * (1.0 - std::cos (p.x () / radius)));
  };
}

// A sheet in the plane (its outer border, then holes, as points), laid in space without stretching.
KnownSurface
sheet (
    const std::vector<Outline>& outlines, const Lift& lift, bool ragged, std::uint64_t seed,
    const std::function<double (const Eigen::Vector2d&)>& spacing = [] (const Eigen::Vector2d&) {
      return 1.0;
    })
{
  KnownSurface made;
  made.loops = outlines.size ();
  made.area = areaOf (outlines.front ());
  std::vector<Dart> border;
  for (const Outline& outline : outlines) {
    made.area -= &outline == &outlines.front () ? 0.0 : areaOf (outline);
    for (const Eigen::Vector2d& p : outline)
      if (!ragged)
        border.push_back ({lift (p), spacing (p)});
  }
  RandomStream random (seed);
  made.points = throwDarts (
      std::move (border), made.area,
      [&] (RandomStream& stream) -> Dart {
        const Eigen::Vector2d p = randomInside (outlines, stream);
        return {lift (p), spacing (p)};
      },
      random);
  if (ragged)
    made.area = 0.0;
  return made;
}

// Places along a line from 0 to `length`, each about one local spacing after the one before it. The
// end itself is left out: it is the begin of the next side.
std::vector<double>
steps (double length, const std::function<double (double)>& spacing)
{
  std::vector<double> at{0.0};
  while (at.back () < length) {
    const double middle = at.back () + 0.5 * spacing (at.back ());
    at.push_back (at.back () + spacing (std::min (middle, length)));
  }
  const double stretch = length / at.back ();
  for (double& x : at)
    x *= stretch;
  at.pop_back ();
  return at;
}

} // namespace

KnownSurface
taco (double gap, std::uint64_t seed)
{
  const double radius = 0.5 * gap, start = 1.0, turn = PI * radius;
  return sheet (
      {circle (20.0, 1.0)},
      [=] (const Eigen::Vector2d& p) -> Eigen::Vector3d {
        const double past = p.x () - start;
        if (past < 0.0)
          return {past, p.y (), 0.0};
        if (past > turn)
          return {turn - past, p.y (), gap};
        return {radius * std::sin (past / radius), p.y (),
                radius * (1.0 - std::cos (past / radius))};
      },
      false, seed);
}

KnownSurface
comb (double gap, bool ragged, std::uint64_t seed)
{
  constexpr int TEETH = 8;
  constexpr double WIDTH = 6.0, LENGTH = 30.0, BACK = 8.0;
  Outline corners{{0.0, 0.0}};
  const double pitch = WIDTH + gap;
  corners.emplace_back (TEETH * pitch - gap, 0.0);
  for (int tooth = TEETH - 1; tooth >= 0; --tooth) {
    const double left = tooth * pitch;
    corners.emplace_back (left + WIDTH, BACK + LENGTH);
    corners.emplace_back (left, BACK + LENGTH);
    if (tooth > 0) {
      corners.emplace_back (left, BACK);
      corners.emplace_back (left - gap, BACK);
    }
  }
  return sheet ({resample (corners, 1.0)}, bent (60.0), ragged, seed);
}

KnownSurface
unevenSheet (double ratio, bool abrupt, std::uint64_t seed)
{
  constexpr double SIDE = 80.0;
  const auto along = [=] (double x) {
    const double share = abrupt ? (x < 0.3 * SIDE ? 0.0 : 1.0) : x / SIDE;
    return std::pow (ratio, 0.5 * share);
  };
  Outline outline;
  for (const double x : steps (SIDE, along))
    outline.emplace_back (x, 0.0);
  for (const double y : steps (SIDE, [&] (double) { return along (SIDE); }))
    outline.emplace_back (SIDE, y);
  for (const double x : steps (SIDE, [&] (double t) { return along (SIDE - t); }))
    outline.emplace_back (SIDE - x, SIDE);
  for (const double y : steps (SIDE, [&] (double) { return along (0.0); }))
    outline.emplace_back (0.0, SIDE - y);
  return sheet ({outline}, bent (SIDE), false, seed,
                [&] (const Eigen::Vector2d& p) { return along (p.x ()); });
}

KnownSurface
lattice (Lattice kind)
{
  constexpr int SIDE = 45;
  Eigen::Vector2d across (1.0, 0.0), up (0.0, 1.0);
  if (kind == Lattice::SHEARED)
    up = {std::cos (0.4 * PI), std::sin (0.4 * PI)};
  if (kind == Lattice::HEXAGONAL)
    up = {0.5, std::sqrt (0.75)};
  KnownSurface made;
  made.loops = 1;
  for (int i = 0; i < SIDE; ++i)
    for (int j = 0; j < SIDE; ++j) {
      // Hexagonal rows are shifted to and fro, those of the other lattices by the shear alone.
      const int back = kind == Lattice::HEXAGONAL ? i / 2 : 0;
      const Eigen::Vector2d p = (j - back) * across + i * up;
      made.points.emplace_back (p.x (), p.y (), 0.0);
    }
  made.area = (SIDE - 1) * (SIDE - 1) * up.y ();
  return made;
}

KnownSurface
sheetWithHoles (int holes, double hole_radius, bool ragged, std::uint64_t seed)
{
  const double cell = 2.0 * hole_radius + 5.0;
  const int columns = static_cast<int> (std::ceil (std::sqrt (static_cast<double> (holes))));
  const int rows = (holes + columns - 1) / columns;
  std::vector<Outline> outlines{resample (rectangle (columns * cell, rows * cell), 1.0)};
  for (int hole = 0; hole < holes; ++hole)
    outlines.push_back (moved (circle (hole_radius, 1.0),
                               {(hole % columns + 0.5) * cell,
                                (static_cast<double> (hole / columns) + 0.5) * cell})); // NOLINT
  return sheet (outlines, bent (columns * cell), ragged, seed);
}

KnownSurface
sheetWithHolesOfTwoSizes (std::uint64_t seed)
{
  std::vector<Outline> outlines{resample (rectangle (60.0, 60.0), 1.0)};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      outlines.push_back (moved (circle ((row + column) % 2 == 0 ? 6.0 : 2.0, 1.0),
                                 {20.0 * column + 10.0, 20.0 * row + 10.0}));
  return sheet (outlines, bent (60.0), false, seed);
}

KnownSurface
annulus (std::uint64_t seed)
{
  return sheet ({circle (30.0, 1.0), circle (12.0, 1.0)}, bent (60.0), false, seed);
}

KnownSurface
parallelSheets (double gap, std::uint64_t seed)
{
  const std::vector<Outline> square{resample (rectangle (36.0, 36.0), 1.0)};
  const Lift lift = [] (const Eigen::Vector2d& p) { return Eigen::Vector3d (p.x (), p.y (), 0.0); };
  return withComponent (sheet (square, lift, false, seed), sheet (square, lift, false, seed + 1),
                        1.0, {0.3, 0.4, gap});
}

} // namespace pcl::floater::samples
