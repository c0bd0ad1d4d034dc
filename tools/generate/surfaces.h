// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points on known surfaces, for samples, tests and benchmarks.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Random numbers that are the same with every standard library, unlike its distributions.
class RandomStream
{
public:
  explicit RandomStream (std::uint64_t seed) : engine_ (seed) {}

  /// Uniformly distributed in [0, 1).
  double uniform () { return static_cast<double> (engine_ () >> 11) * 0x1.0p-53; }

  /// An integer, uniformly distributed in [0, n); n far below 2^53.
  std::size_t below (std::size_t n)
  {
    return static_cast<std::size_t> (uniform () * static_cast<double> (n));
  }

  /// Normally distributed with mean 0 and standard deviation 1 (Box and Muller).
  double normal ()
  {
    const double radius = std::sqrt (-2.0 * std::log1p (-uniform ()));
    return radius * std::cos (2.0 * 3.14159265358979323846 * uniform ());
  }

private:
  std::mt19937_64 engine_;
};

enum class SurfaceKind
{
  HEIGHT_FIELD, ///< square of rolling terrain, sampled evenly in plan view: a disc
  HEMISPHERE,   ///< half a sphere without its base: a disc
  FINGER,       ///< cylinder closed by a hemisphere at one end, open at the other: a disc
  FOLDED_SHEET, ///< two parallel flaps joined by a half turn: a disc
  CUT_OUT,      ///< wavy sheet with round holes, sampled evenly in plan view
  SPHERE,       ///< closed, genus 0
  TORUS         ///< closed, genus 1; radii 5 to 2
};

/// A surface and how it is sampled. Lengths are in units of the mean spacing of the samples: there
/// is one point per unit of area, so a surface of n points has the area n.
struct SurfaceSpec
{
  SurfaceKind kind = SurfaceKind::HEIGHT_FIELD;
  std::size_t points = 10000; ///< number of points, MIN_SURFACE_POINTS or more
  std::uint64_t seed = 1;     ///< of the random displacements, noise and order
  double density_ratio = 1.0; ///< largest over smallest density in points per area, 1 to 100; the
                              ///< density grows exponentially across the surface, and along a torus
                              ///< to its far side and back
  double noise = 0.0;  ///< standard deviation of each coordinate, in mean spacings, 0 or more
  double length = 4.0; ///< of the cylinder of the finger, over its radius, 0 or more
  double gap = 4.0;    ///< between the flaps of the folded sheet, in mean spacings, above 0
  int holes = 3;       ///< of the cut-out sheet, 0 to 10,000
};

/// Fewest points of a surface.
constexpr std::size_t MIN_SURFACE_POINTS = 50;

/// All kinds of surface, with their names on the command line.
constexpr std::array<std::pair<const char*, SurfaceKind>, 7> SURFACES{
    {{"height-field", SurfaceKind::HEIGHT_FIELD},
     {"hemisphere", SurfaceKind::HEMISPHERE},
     {"finger", SurfaceKind::FINGER},
     {"folded-sheet", SurfaceKind::FOLDED_SHEET},
     {"cut-out", SurfaceKind::CUT_OUT},
     {"sphere", SurfaceKind::SPHERE},
     {"torus", SurfaceKind::TORUS}}};

/// Makes exactly spec.points points in random order, irregular but evenly dense like a scan. Before
/// noise is added, two points are at least about a quarter of the local spacing apart, and no gap
/// is wider than about twice the local spacing. The same specification gives the same points. O(n),
/// up to 0.6 microseconds per point. \throw std::invalid_argument if something
/// is out of its range, or does not fit the number of points
std::vector<Eigen::Vector3d>
generateSurface (const SurfaceSpec& spec);

} // namespace pcl::floater
