// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points on surfaces of known topology, for the tests of whole reconstructions.
//
// Unless it says otherwise the unit of length is the mean spacing, so that there is about one point
// for each unit of area. Points are irregular but even, as in a scan: those of generateSurface(), or darts
// thrown at random (see throwDarts). Borders and sharp edges have points of their own in steps of one
// spacing, so that the area of the true surface is that of a good mesh; "ragged" sheets have none.
#pragma once

#include "samples.h"
#include "surfaces.h"

namespace pcl::floater::samples {
/// Points and the surface that they lie on.
struct KnownSurface
{
  Positions points;
  Positions clean; ///< where noisy points lie without the noise; else empty
  std::size_t components = 1;
  std::size_t loops = 0;
  std::size_t handles = 0;   ///< of all components together
  double area = 0.0;         ///< of the true surface; 0: not known
  double sharp_length = 0.0; ///< length of edges where the true surface turns by over 120 degrees
  bool is_even = true;
  std::vector<Index> outliers; ///< points off the surface, ascending
};

inline KnownSurface
generated (const SurfaceSpec& spec)
{
  KnownSurface made;
  made.points = generateSurface (spec);
  const bool is_torus = spec.kind == SurfaceKind::TORUS;
  made.loops = spec.kind == SurfaceKind::CUT_OUT ? 1 + static_cast<std::size_t> (spec.holes)
               : is_torus || spec.kind == SurfaceKind::SPHERE ? 0
                                                              : 1;
  made.handles = is_torus ? 1 : 0;
  // Wavy sheets are larger, and where samples are sparse, the outermost are far from the rim.
  const bool is_known = spec.kind != SurfaceKind::CUT_OUT && spec.density_ratio == 1.0;
  made.area = is_known ? static_cast<double> (spec.points) : 0.0;
  return made;
}

/// With sharp edges of this length.
inline KnownSurface
sharp (KnownSurface surface, double length)
{
  surface.sharp_length = length;
  return surface;
}

// ---- sheets

using Lift = std::function<Eigen::Vector3d (const Eigen::Vector2d&)>;

/// A sheet in the plane (its outer border, then holes, as points), laid in space without stretching.
inline KnownSurface
sheet (const std::vector<Outline>& outlines, const Lift& lift, std::uint64_t seed,
       bool ragged = false)
{
  KnownSurface made;
  made.loops = outlines.size ();
  made.area = ragged ? 0.0 : areaOf (outlines);
  Positions border;
  for (const Outline& outline : outlines)
    for (const Eigen::Vector2d& p : outline)
      if (!ragged)
        border.push_back (lift (p));
  made.points = throwDarts (
      border, areaOf (outlines),
      [&] (RandomStream& random) { return lift (randomInside (outlines, random)); }, seed);
  return made;
}

/// Around a cylinder.
inline Lift
bent (double radius)
{
  return [radius] (const Eigen::Vector2d& p) {
    return Eigen::Vector3d (radius * std::sin (p.x () / radius), p.y (),
                            radius * (1.0 - std::cos (p.x () / radius)));
  };
}

/// An open sheet of flat pleats, with an angle between each and the next.
inline KnownSurface
pleats (int count, double width, double angle, std::uint64_t seed, bool ragged = false)
{
  constexpr double HEIGHT = 30.0;
  const Lift folded = [=] (const Eigen::Vector2d& p) {
    const double across = p.x () - 2.0 * width * std::round (0.5 * p.x () / width);
    return Eigen::Vector3d (std::abs (across) * std::cos (0.5 * angle), p.y (),
                            p.x () * std::sin (0.5 * angle));
  };
  const double start = count == 2 ? -width : 0.0;
  return sharp (sheet ({resample (rectangle (count * width, HEIGHT, {start, 0.0}), 1.0)}, folded,
                       seed, ragged),
                (count - 1) * HEIGHT);
}

/// An open sheet, folded to 30 degrees along its middle.
inline KnownSurface
foldedSheet (std::uint64_t seed, bool ragged = false)
{
  return pleats (2, 25.0, PI / 6.0, seed, ragged);
}

/// A round sheet of radius 20 folded over along a line beside its middle.
inline KnownSurface
taco (double gap, std::uint64_t seed)
{
  const double radius = 0.5 * gap, start = 1.0, turn = PI * radius;
  const Lift folded = [=] (const Eigen::Vector2d& p) -> Eigen::Vector3d {
    const double past = p.x () - start;
    if (past < 0.0)
      return {past, p.y (), 0.0};
    if (past > turn)
      return {turn - past, p.y (), gap};
    return {radius * std::sin (past / radius), p.y (), radius * (1.0 - std::cos (past / radius))};
  };
  return sheet ({circle (20.0, 1.0)}, folded, seed);
}

/// A comb of eight teeth, each 6 wide and 30 long, bent around a cylinder.
inline KnownSurface
comb (double gap, bool ragged, std::uint64_t seed)
{
  constexpr int TEETH = 8;
  constexpr double WIDTH = 6.0, LENGTH = 30.0, BACK = 8.0;
  const double pitch = WIDTH + gap;
  Outline corners{{0.0, 0.0}, {TEETH * pitch - gap, 0.0}};
  for (int tooth = TEETH - 1; tooth >= 0; --tooth) {
    const double left = tooth * pitch;
    corners.emplace_back (left + WIDTH, BACK + LENGTH);
    corners.emplace_back (left, BACK + LENGTH);
    if (tooth > 0) {
      corners.emplace_back (left, BACK);
      corners.emplace_back (left - gap, BACK);
    }
  }
  return sheet ({resample (corners, 1.0)}, bent (60.0), seed, ragged);
}

/// A bent square sheet of side x side cells with a round hole in each, of two radii in turns.
inline KnownSurface
sheetWithHoles (int side, double cell, double even_radius, double odd_radius, std::uint64_t seed)
{
  std::vector<Outline> outlines{resample (rectangle (side * cell, side * cell), 1.0)};
  for (int hole = 0; hole < side * side; ++hole) {
    const int row = hole / side, column = hole % side;
    outlines.push_back (circle ((row + column) % 2 == 0 ? even_radius : odd_radius, 1.0));
    for (Eigen::Vector2d& p : outlines.back ())
      p += cell * Eigen::Vector2d (column + 0.5, row + 0.5);
  }
  return sheet (outlines, bent (side * cell), seed);
}

/// A bent ring of radii 12 and 30.
inline KnownSurface
annulus (std::uint64_t seed)
{
  return sheet ({circle (30.0, 1.0), circle (12.0, 1.0)}, bent (60.0), seed);
}

/// One-sided, so no orientation is right: components and loops are those of the true surface.
inline KnownSurface
moebiusStrip (std::uint64_t seed)
{
  constexpr double RADIUS = 30.0, WIDTH = 12.0;
  const Lift twisted = [] (const Eigen::Vector2d& p) {
    const double angle = p.x () / RADIUS, across = p.y () - 0.5 * WIDTH;
    const double r = RADIUS + across * std::cos (0.5 * angle);
    return polar (r, angle, across * std::sin (0.5 * angle));
  };
  return sheet ({rectangle (2.0 * PI * RADIUS, WIDTH)}, twisted, seed, true);
}

/// A flat regular lattice of 45 by 45 points, in rows along x with a spacing of one.
/// \param up from a row to the next
inline KnownSurface
lattice (const Eigen::Vector2d& up)
{
  constexpr int SIDE = 45;
  KnownSurface made;
  made.loops = 1;
  for (int i = 0; i < SIDE; ++i)
    for (int j = 0; j < SIDE; ++j)
      made.points.emplace_back (j + i * up.x (), i * up.y (), 0.0);
  made.area = (SIDE - 1) * (SIDE - 1) * up.y ();
  return made;
}

/// A blade: two bent sides of 60 rows of points, a step apart, whose edges they share. Those of one side
/// lie nearly behind those of the other.
/// \param half  of the points of a row
/// \param thick in the middle
inline KnownSurface
bladeInRows (int half, double thick)
{
  constexpr int ROWS = 60;
  KnownSurface made;
  for (int x = -1; x <= ROWS; ++x)
    for (int y = -half; y <= half; ++y) {
      const bool is_edge = x < 0 || x == ROWS || std::abs (y) == half;
      const double up = is_edge ? 0.0 : 0.5 * thick * (1.0 - 1.0 * y * y / (half * half));
      made.points.emplace_back (x, y, up);
      if (!is_edge)
        made.points.emplace_back (x + 0.1, y, -up);
    }
  made.is_even = false;
  return sharp (made, 2.0 * (ROWS + 1 + 2 * half));
}

// ---- sheets that are sampled unevenly; of the smaller spacing is one

/// A bent sheet. Its rows are `apart` steps apart, points in a row about one step, and each row
/// begins anywhere.
inline KnownSurface
scanLines (double apart, double noise, std::uint64_t seed)
{
  constexpr int ROWS = 12;
  const double bend = 3.0 * apart;
  RandomStream random (seed);
  KnownSurface made;
  made.loops = 1;
  made.is_even = false;
  for (int row = 0; row < ROWS; ++row) {
    const double shift = random.uniform ();
    for (int i = 0; i < static_cast<int> (3.0 * apart) + 40; ++i) {
      const double x = i + shift + 0.2 * (random.uniform () - 0.5);
      const double y = apart * (row + noise * random.normal ());
      made.points.emplace_back (x, y,
                                bend * std::cos (y / (4.0 * apart)) + noise * random.normal ());
    }
  }
  return made;
}

/// A sheet with waves of a height, or 0: flat. Its rows are `apart` steps apart, and each begins anywhere. In a
/// row, steps differ from one by up to `spread`; or they are random with a mean of one, so that some points
/// nearly coincide.
inline KnownSurface
strewnLines (double apart, double height, std::uint64_t seed, double spread = 1.0)
{
  constexpr int ROWS = 20;
  constexpr double LENGTH = 200.0;
  RandomStream random (seed);
  KnownSurface made;
  made.loops = 1;
  made.is_even = false;
  const auto step = [&] {
    const double number = random.uniform ();
    return spread < 1.0 ? 1.0 + spread * (2.0 * number - 1.0) : -std::log1p (-number);
  };
  for (int row = 0; row < ROWS; ++row)
    for (double x = spread < 1.0 ? random.uniform () : step (); x < LENGTH; x += step ()) {
      const double y = row * apart;
      made.points.emplace_back (x, y, height * std::sin (x / 30.0) * std::cos (y / 35.0));
    }
  return made;
}

/// The same with a square window, as wide as so many rows.
inline KnownSurface
windowInLines (double apart, int rows)
{
  KnownSurface made = strewnLines (apart, 20.0, 1, 0.4);
  made.loops = 2;
  const Positions all = std::exchange (made.points, {});
  for (const Eigen::Vector3d& p : all)
    if (std::max (std::abs (p.x () - 100.0), std::abs (p.y () - 9.5 * apart)) > 0.5 * rows * apart)
      made.points.push_back (p);
  return made;
}

/// Two jittered grids side by side, their steps 1 and `ratio`.
inline KnownSurface
densityStep (int ratio, std::uint64_t seed)
{
  constexpr double JITTER = 0.2;
  RandomStream random (seed);
  KnownSurface made;
  made.loops = 1;
  made.is_even = false;
  made.points = placed (jitteredGrid (20, 8 * ratio + 1, 1.0, JITTER, random), {-20.1, -0.1, 0.0});
  made.points = joined (made.points, placed (jitteredGrid (9, 9, ratio, JITTER, random),
                                             {0.4 * ratio, -0.1 * ratio, 0.0}));
  return made;
}

// ---- solids

/// Upright walls over outlines in the plane (the outer border, then holes through the solid), a
/// floor and perhaps a lid. Sharp edges have points of their own. Short sides are those of a round
/// outline, between which there are none.
inline KnownSurface
prism (const std::vector<Outline>& outlines, double height, std::uint64_t seed,
       bool with_lid = true)
{
  constexpr double SHORT = 2.0;
  Positions edges;
  std::vector<std::array<Eigen::Vector2d, 2>> sides; // begins and steps
  double around = 0.0;
  for (const Outline& corners : outlines) {
    for (const Eigen::Vector2d& p : resample (corners, 1.0))
      for (const double z : {0.0, height})
        edges.emplace_back (p.x (), p.y (), z);
    for (std::size_t i = 0; i < corners.size (); ++i) {
      sides.push_back ({corners[i], corners[(i + 1) % corners.size ()] - corners[i]});
      around += sides.back ()[1].norm ();
      for (double z = 1.0; z < height - 0.5 && sides.back ()[1].norm () > SHORT; z += 1.0)
        edges.emplace_back (corners[i].x (), corners[i].y (), z);
    }
  }
  const double walls = around * height, floor = areaOf (outlines);
  KnownSurface made;
  made.loops = with_lid ? 0 : outlines.size ();
  made.handles = with_lid ? outlines.size () - 1 : 0;
  made.area = walls + (with_lid ? 2.0 : 1.0) * floor;
  const auto throwDart = [&] (RandomStream& random) -> Eigen::Vector3d {
    const double part = random.uniform () * made.area;
    if (part >= walls) {
      const Eigen::Vector2d p = randomInside (outlines, random);
      return {p.x (), p.y (), part < walls + floor ? 0.0 : height};
    }
    double along = part / height;
    std::size_t side = 0;
    for (; side + 1 < sides.size () && along > sides[side][1].norm (); ++side)
      along -= sides[side][1].norm ();
    const auto& [begin, step] = sides[side];
    const Eigen::Vector2d p = begin + std::min (along / step.norm (), 1.0) * step;
    return {p.x (), p.y (), height * random.uniform ()};
  };
  made.points = throwDarts (edges, made.area, throwDart, seed);
  return made;
}

/// A plate with four holes through it, which leave bars of a width between them and around. A corner of
/// a hole may be filled by a tetrahedron, which folds an edge by 125 degrees.
inline KnownSurface
frame (double bar, double window, double height, std::uint64_t seed)
{
  const double pitch = window + bar;
  std::vector<Outline> outlines{rectangle (2.0 * pitch + bar, 2.0 * pitch + bar)};
  for (const double x : {bar, bar + pitch})
    for (const double y : {bar, bar + pitch})
      outlines.push_back (rectangle (window, window, {x, y}));
  return sharp (prism (outlines, height, seed), 3.2);
}

// ---- additions and flaws

/// Adds another surface, scaled and moved.
inline KnownSurface
withComponent (KnownSurface surface, const KnownSurface& more, double scale,
               const Eigen::Vector3d& place)
{
  surface.points = joined (std::move (surface.points), placed (more.points, place, scale));
  surface.components += more.components;
  surface.loops += more.loops;
  surface.handles += more.handles;
  surface.area += scale * scale * more.area;
  return surface;
}

/// Two square sheets, one above the other.
inline KnownSurface
parallelSheets (double gap, std::uint64_t seed)
{
  const std::vector<Outline> square{resample (rectangle (36.0, 36.0), 1.0)};
  const Lift flat = [] (const Eigen::Vector2d& p) { return Eigen::Vector3d (p.x (), p.y (), 0.0); };
  return withComponent (sheet (square, flat, seed), sheet (square, flat, seed + 1), 1.0,
                        {0.3, 0.4, gap});
}

/// A sphere with spacing 1, a torus with spacing 3 and a sheet with spacing 2.
inline KnownSurface
components (std::uint64_t seed)
{
  return withComponent (withComponent (generated ({SurfaceKind::SPHERE, 1500, seed}),
                                       generated ({SurfaceKind::TORUS, 1200, seed + 1}), 3.0,
                                       {75.0, 0.0, 0.0}),
                        annulus (seed + 2), 2.0, {0.0, 110.0, 0.0});
}

/// Adds normal noise to every coordinate; `clean` are the points before that.
inline KnownSurface
withNoise (KnownSurface surface, double standard_deviation, std::uint64_t seed)
{
  surface.clean = surface.points;
  RandomStream random (seed);
  for (Eigen::Vector3d& p : surface.points)
    p += standard_deviation * normalVector (random);
  surface.area = 0.0;
  return surface;
}

/// Adds points in and around the bounding box, each at least a distance away from all others.
inline KnownSurface
withOutliers (KnownSurface surface, std::size_t count, double distance, std::uint64_t seed)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : surface.points)
    box.extend (p);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant (2.0 * distance);
  RandomStream random (seed);
  while (surface.outliers.size () < count) {
    const Eigen::Vector3d p =
        box.min () - margin + (box.sizes () + 2.0 * margin).cwiseProduct (uniformVector (random));
    if (std::any_of (surface.points.begin (), surface.points.end (),
                     [&] (const Eigen::Vector3d& q) { return (q - p).norm () < distance; }))
      continue;
    surface.outliers.push_back (static_cast<Index> (surface.points.size ()));
    surface.points.push_back (p);
  }
  return surface;
}

} // namespace pcl::floater::samples
