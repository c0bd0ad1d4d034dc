// SPDX-License-Identifier: GPL-3.0-or-later
// Points on known surfaces, for samples, tests and benchmarks.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
enum class SurfaceKind
{
  HEIGHT_FIELD, ///< square component of rolling terrain, sampled evenly in plan view: a disc
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
  std::size_t points = 10000; ///< 10000: how many points, MIN_SURFACE_POINTS or more
  std::uint64_t seed = 1;     ///< 1: of irregularity, noise and order
  double density_ratio = 1.0; ///< 1: densest over sparsest, in points per area; grows exponentially
                              ///< across the surface (there and back along a torus)
  double noise = 0.0;         ///< 0: standard deviation of each coordinate, in mean spacings
  double length = 4.0;        ///< 4: length over radius of the finger's cylinder
  double gap = 4.0; ///< 4: distance between the flaps of the folded sheet, in mean spacings
  int holes = 3;    ///< 3: holes of the cut-out sheet
};

constexpr std::size_t MIN_SURFACE_POINTS = 50;

/// Name of a kind, as on the command line ("height-field").
const char*
surfaceName (SurfaceKind kind);

/// All kinds.
const std::vector<SurfaceKind>&
surfaceKinds ();

/// How many boundary loops the surface has: 0 closed, 1 a disc, more for the cut-out sheet.
int
boundaryLoops (const SurfaceSpec& spec);

/// Euler characteristic of the surface.
int
eulerCharacteristic (const SurfaceSpec& spec);

/// What is wrong with a specification, in one sentence; empty if nothing is.
std::string
surfaceSpecError (const SurfaceSpec& spec);

/// Exactly spec.points points in random order, irregular but even like a scan: before noise no two
/// are nearer than about a quarter of the local spacing and no gap is wider than about twice of it.
/// The same for the same specification. Linear in the number of points, up to 0.6 microseconds
/// each. \throw std::invalid_argument with surfaceSpecError() if that is not empty
std::vector<Eigen::Vector3d>
generateSurface (const SurfaceSpec& spec);

} // namespace floater
} // namespace pcl
