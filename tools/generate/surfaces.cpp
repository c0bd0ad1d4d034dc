// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaces.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace pcl::floater {
namespace {
constexpr double PI = 3.14159265358979323846;
constexpr double GOLDEN = 0.61803398874989484820;
constexpr double JITTER = 0.3;        // largest displacement of a sample, in local spacings
constexpr double RING_JITTER = 0.2;   // the same where the lattice is less even
constexpr double HOLE_RADIUS = 0.3;   // of the cut-out sheet, in widths of a cell
constexpr double MIN_HOLE = 4.0;      // smallest radius of a hole, in mean spacings
constexpr double TORUS_RADII = 2.5;   // great radius over small radius
constexpr double MAX_DENSITY = 100.0; // largest density ratio for which the lattice stays even

void
require (bool fits, const char* message)
{
  if (!fits)
    throw std::invalid_argument (message);
}

// A surface as an image of the unit square that preserves areas, up to a factor. Points slightly
// beyond the square are on the continuation of the surface.
struct Chart
{
  double area = 0.0;                                     // of the image of the square
  std::function<Eigen::Vector3d (double, double)> lift;  // (s, t) -> point
  std::function<double (double, double)> stretch;        // (s, t) -> |d point / dt|
  std::function<bool (double, double)> inside = nullptr; // (s, t) -> not in a hole; null: always
  bool ring = false;                                     // s = 1 continues at s = 0
};

Chart
heightField (double n)
{
  const double side = std::sqrt (n);
  auto lift = [side] (double s, double t) {
    const double height = 0.060 * std::sin (2.0 * PI * (1.1 * s + 0.4 * t)) +
                          0.040 * std::sin (2.0 * PI * (1.9 * t - 0.7 * s) + 1.0) +
                          0.012 * std::sin (2.0 * PI * (2.7 * s + 2.3 * t) + 2.0);
    return Eigen::Vector3d (side * s, side * t, side * height);
  };
  return {n, lift, [side] (double, double) { return side; }};
}

// On a sphere, zones of equal height have equal areas (Archimedes): z = radius * (1 - scale * s).
Chart
sphere (double n, bool half)
{
  const double scale = half ? 1.0 : 2.0;
  const double radius = std::sqrt (n / (2.0 * PI * scale));
  auto distance_to_axis = [radius, scale] (double s) {
    const double z = 1.0 - scale * std::abs (s);
    return radius * std::sqrt (std::max (0.0, 1.0 - z * z));
  };
  auto lift = [=] (double s, double t) {
    const double r = distance_to_axis (s);
    const double z = radius * std::max (-1.0, 1.0 - scale * std::abs (s));
    return Eigen::Vector3d (r * std::cos (2.0 * PI * t), r * std::sin (2.0 * PI * t), z);
  };
  return {n, lift, [=] (double s, double) { return 2.0 * PI * distance_to_axis (s); }};
}

// s runs from the tip downwards. Zones of equal height have equal areas, on the hemisphere as on
// the cylinder.
Chart
finger (double n, double length)
{
  require (length >= 0.0 && std::isfinite (length), "the length of the finger must be 0 or more");
  require (2.0 * PI * (1.0 + length) <= 0.25 * n,
           "the finger is too long for so few points: its radius is below 2 spacings");
  const double radius = std::sqrt (n / (2.0 * PI * (1.0 + length)));
  auto distance_to_axis = [=] (double s) {
    const double z = 1.0 - std::min (1.0, (1.0 + length) * std::abs (s)); // in the hemisphere
    return radius * std::sqrt (1.0 - z * z);
  };
  auto lift = [=] (double s, double t) {
    const double r = distance_to_axis (s), angle = 2.0 * PI * t;
    return Eigen::Vector3d (r * std::cos (angle), r * std::sin (angle),
                            radius * (length + 1.0) * (1.0 - std::abs (s)));
  };
  return {n, lift, [=] (double s, double) { return 2.0 * PI * distance_to_axis (s); }};
}

// A strip twice as long as wide, bent in the middle of its length around half a cylinder.
Chart
foldedSheet (double n, double gap)
{
  require (gap > 0.0 && 0.25 * PI * gap < 0.9 * std::sqrt (0.5 * n),
           "the gap of the folded sheet must be above 0, and so narrow that there are flaps");
  const double width = std::sqrt (0.5 * n), radius = 0.5 * gap;
  const double flap = width - 0.5 * PI * radius;
  auto lift = [=] (double s, double t) {
    const double along = 2.0 * width * s;
    if (along < flap)
      return Eigen::Vector3d (along, width * t, 0.0);
    const double angle = (along - flap) / radius;
    if (angle < PI)
      return Eigen::Vector3d (flap + radius * std::sin (angle), width * t,
                              radius * (1.0 - std::cos (angle)));
    return Eigen::Vector3d (flap - (along - flap - PI * radius), width * t, gap);
  };
  return {n, lift, [width] (double, double) { return width; }};
}

// The holes are in the middle of the cells of a grid. Their radius is in sides of the sheet.
Chart
cutOut (double n, int holes)
{
  require (holes >= 0 && holes <= 10000, "the number of holes must be from 0 to 10000");
  const int columns = std::max (static_cast<int> (std::ceil (std::sqrt (holes))), 1);
  const int rows = (holes + columns - 1) / columns;
  const double radius = HOLE_RADIUS / std::max (columns, rows);
  const double side = std::sqrt (n / (1.0 - holes * PI * radius * radius));
  require (holes == 0 || radius * side >= MIN_HOLE,
           "there are too many holes for so few points: their radius is below 4 spacings");
  auto lift = [side] (double s, double t) {
    return Eigen::Vector3d (side * s, side * t, 0.04 * side * std::sin (2.0 * PI * (s + 0.5 * t)));
  };
  Chart chart{side * side, lift, [side] (double, double) { return side; }};
  if (holes > 0)
    chart.inside = [=] (double s, double t) {
      const int column = std::clamp (static_cast<int> (s * columns), 0, columns - 1);
      const int row = std::clamp (static_cast<int> (t * rows), 0, rows - 1);
      return row * columns + column >= holes ||
             std::hypot (s - (column + 0.5) / columns, t - (row + 0.5) / rows) > radius;
    };
  return chart;
}

// s runs along the great circle, t around the tube. Equal steps of t have equal areas if the angle
// v around the tube satisfies v + sin (v) / TORUS_RADII = 2 pi t.
Chart
torus (double n)
{
  const double small = std::sqrt (n / (4.0 * PI * PI * TORUS_RADII));
  auto tube_angle = [] (double t) {
    const double target = 2.0 * PI * t;
    double v = target;
    for (int i = 0; i < 8; ++i) // Newton; converges from anywhere, since the slope is 0.6 to 1.4
      v -= (v + std::sin (v) / TORUS_RADII - target) / (1.0 + std::cos (v) / TORUS_RADII);
    return v;
  };
  auto lift = [=] (double s, double t) {
    const double u = 2.0 * PI * s, v = tube_angle (t);
    const double r = small * (TORUS_RADII + std::cos (v));
    return Eigen::Vector3d (r * std::cos (u), r * std::sin (u), small * std::sin (v));
  };
  auto stretch = [=] (double, double t) {
    return 2.0 * PI * small / (1.0 + std::cos (tube_angle (t)) / TORUS_RADII);
  };
  return {n, lift, stretch, nullptr, true};
}

// Density that falls exponentially along s, or there and back: s as a function of the fraction f of
// the points before it, with its derivative.
std::pair<double, double>
graded (double f, double log_ratio, bool there_and_back)
{
  if (!(log_ratio > 0.0))
    return {f, 1.0};
  if (there_and_back) {
    const double turn = std::floor (f), g = 2.0 * (f - turn) - 1.0;
    const auto [s, slope] = graded (std::abs (g), log_ratio, false);
    return {turn + 0.5 + 0.5 * std::copysign (s, g), slope};
  }
  const double share = -std::expm1 (-log_ratio); // density proportional to exp (-log_ratio * s)
  const double left = 1.0 - f * share;
  return {-std::log (left) / log_ratio, share / (left * log_ratio)};
}

// Fraction of the sampled points that are not in holes, from the midpoints of a fine grid.
double
shareInside (const Chart& chart, double log_ratio)
{
  if (!chart.inside)
    return 1.0;
  constexpr int cells = 1000;
  int inside = 0;
  for (int i = 0; i < cells; ++i) {
    const double s = graded ((i + 0.5) / cells, log_ratio, chart.ring).first;
    for (int j = 0; j < cells; ++j)
      inside += chart.inside (s, (j + 0.5) / cells) ? 1 : 0;
  }
  return static_cast<double> (inside) / (static_cast<double> (cells) * cells);
}

// Evenness of the lattice (k / n, k p / n mod 1): n times the smallest product of the coordinates
// of its vectors. Euclid's algorithm passes through these vectors. Stretching along the axes does
// not change the evenness. It is 0.38 for the golden lattice, and 0 if p and n have a common
// factor.
double
evenness (std::size_t p, std::size_t n)
{
  std::size_t previous = n, rest = p, previous_steps = 0, steps = 1;
  std::size_t smallest = n;
  while (rest > 0) {
    smallest = std::min (smallest, steps * rest);
    const std::size_t quotient = previous / rest;
    previous = std::exchange (rest, previous % rest);
    previous_steps = std::exchange (steps, previous_steps + quotient * steps);
  }
  return previous == 1 ? static_cast<double> (smallest) / static_cast<double> (n) : 0.0;
}

// p / n of the most even of these lattices with p near the golden section of n.
double
ringRotation (std::size_t n)
{
  constexpr std::size_t candidates = 1000;
  const auto middle = static_cast<std::size_t> (std::round (GOLDEN * static_cast<double> (n)));
  std::size_t best = middle;
  for (std::size_t p = middle - std::min (middle - 1, candidates / 2);
       p < std::min (n, middle + candidates / 2); ++p)
    if (evenness (p, n) > evenness (best, n))
      best = p;
  return static_cast<double> (best) / static_cast<double> (n);
}

} // namespace

// The samples are the golden lattice (k / n, k * golden ratio mod 1), randomly displaced. It stays
// even if it is stretched along its axes by any factors, and so is even on the surface as well,
// whatever the density along s. On a ring, the rotation is rounded to a multiple of 1 / n, so that
// the end fits the beginning.
std::vector<Eigen::Vector3d>
generateSurface (const SurfaceSpec& spec)
{
  require (spec.points >= MIN_SURFACE_POINTS, "a surface needs 50 points or more");
  require (spec.density_ratio >= 1.0 && spec.density_ratio <= MAX_DENSITY,
           "the density ratio must be from 1 to 100");
  require (spec.noise >= 0.0 && std::isfinite (spec.noise), "the noise must be 0 or more");
  const auto n = static_cast<double> (spec.points);
  const Chart chart = spec.kind == SurfaceKind::HEIGHT_FIELD   ? heightField (n)
                      : spec.kind == SurfaceKind::HEMISPHERE   ? sphere (n, true)
                      : spec.kind == SurfaceKind::FINGER       ? finger (n, spec.length)
                      : spec.kind == SurfaceKind::FOLDED_SHEET ? foldedSheet (n, spec.gap)
                      : spec.kind == SurfaceKind::CUT_OUT      ? cutOut (n, spec.holes)
                      : spec.kind == SurfaceKind::SPHERE       ? sphere (n, false)
                                                               : torus (n);
  const double log_ratio = std::log (spec.density_ratio);
  const double lattice = n / shareInside (chart, log_ratio);
  const double rotation = chart.ring ? ringRotation (spec.points) : GOLDEN;
  const double jitter = chart.ring ? RING_JITTER : JITTER;

  RandomStream random (spec.seed);
  std::vector<Eigen::Vector3d> points;
  points.reserve (spec.points);
  for (double k = 0.5; points.size () < spec.points; k += 1.0) { // beyond n if there are holes
    double f = k / lattice, t = std::fmod (k * rotation, 1.0);
    const auto [s, slope] = graded (f, log_ratio, chart.ring);
    const double along_t = chart.stretch (s, t), along_f = chart.area * slope / along_t;
    const double spacing = std::sqrt (slope * chart.area / lattice);
    const double reach = jitter * spacing * std::sqrt (random.uniform ());
    const double direction = 2.0 * PI * random.uniform ();
    f += reach * std::cos (direction) / along_f;
    t += reach * std::sin (direction) / along_t;
    const double moved_s = graded (f, log_ratio, chart.ring).first;
    if (!chart.inside || chart.inside (moved_s, t))
      points.push_back (chart.lift (moved_s, t));
  }

  if (spec.noise > 0.0)
    for (Eigen::Vector3d& p : points)
      for (int axis = 0; axis < 3; ++axis)
        p[axis] += spec.noise * random.normal ();
  for (std::size_t i = points.size (); i > 1; --i)
    std::swap (points[i - 1], points[random.below (i)]);
  return points;
}

} // namespace pcl::floater
