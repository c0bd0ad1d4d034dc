// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points on surfaces of known topology, for the tests of whole reconstructions.
//
// Unless it says otherwise the unit of length is the mean spacing, so that there is about one point
// for each unit of area. Points are irregular but even, as in a scan: those of generateSurface(),
// or darts thrown at random, each at least 0.8 spacings away from all before it. Borders and
// sharp edges have points of their own in steps of one spacing, so that the area of the true
// surface is that of a good mesh; "ragged" sheets have none.
#pragma once

#include "samples.h"

namespace pcl::floater::samples {
/// Points and the surface that they lie on.
struct KnownSurface
{
  Positions points;
  Positions clean; ///< where noisy points lie without the noise; else empty
  std::size_t components = 1;
  std::size_t loops = 0;
  std::size_t handles = 0;     ///< of all components together
  double area = 0.0;           ///< of the true surface; 0: not known
  double sharp_length = 0.0;   ///< length of edges where the true surface turns by over 120 degrees
  std::vector<Index> outliers; ///< points off the surface, ascending
  std::vector<Index> duplicates; ///< points equal to an earlier one, ascending
};

/// Euler characteristic that a mesh of all points has.
inline long
eulerOf (const KnownSurface& surface)
{
  return 2 * static_cast<long> (surface.components) - 2 * static_cast<long> (surface.handles) -
         static_cast<long> (surface.loops);
}

// ---- one disc

/// A tube with a round tip and an open base.
/// \param slenderness length of the tube over its radius
KnownSurface
finger (double slenderness, std::size_t points, std::uint64_t seed);

/// A round sheet of radius 20 folded over along a line beside its middle.
KnownSurface
taco (double gap, std::uint64_t seed);

/// A comb of eight teeth, each 6 wide and 30 long, bent around a cylinder.
KnownSurface
comb (double gap, bool ragged, std::uint64_t seed);

/// A bent square sheet sampled more densely at one side; unit of length is the smaller spacing.
/// \param ratio largest over smallest points per area
/// \param abrupt in two halves, or as an exponential from side to side
KnownSurface
unevenSheet (double ratio, bool abrupt, std::uint64_t seed);

enum class Lattice
{
  SQUARE,
  HEXAGONAL,
  SHEARED ///< parallelograms with an angle of 72 degrees
};

/// A flat component of a regular lattice of 45 by 45 points.
KnownSurface
lattice (Lattice kind);

// ---- holes

/// A bent sheet with round holes in rows, 5 apart.
KnownSurface
sheetWithHoles (int holes, double hole_radius, bool ragged, std::uint64_t seed);

/// A sheet with four holes of radius 2 and five of radius 6.
KnownSurface
sheetWithHolesOfTwoSizes (std::uint64_t seed);

/// A bent ring of radii 12 and 30.
KnownSurface
annulus (std::uint64_t seed);

// ---- closed, with handles, one-sided, several

KnownSurface
sphere (std::size_t points, std::uint64_t seed);

/// A sphere that lacks three caps, each of radius 5.
KnownSurface
sphereWithThreeHoles (std::uint64_t seed);

/// A torus whose radii are as 5 to 2.
KnownSurface
torus (std::size_t points, std::uint64_t seed);

/// A tube along a figure of eight, a quarter as thick as its holes are wide.
KnownSurface
doubleTorus (std::uint64_t seed);

/// One-sided, so no orientation is right: components and loops are those of the true surface.
KnownSurface
moebiusStrip (std::uint64_t seed);

/// Two square sheets, one above the other.
KnownSurface
parallelSheets (double gap, std::uint64_t seed);

/// A sphere with spacing 1, a torus with spacing 3 and a sheet with spacing 2.
KnownSurface
components (std::uint64_t seed);

// ---- flat faces and sharp edges

KnownSurface
box (bool with_lid, std::uint64_t seed);

KnownSurface
bracket (std::uint64_t seed);

KnownSurface
cylinder (std::uint64_t seed);

/// A prism over a triangle with angles of 30, 75 and 75 degrees. Points on both faces beside the
/// sharp edge keep their distance from each other, too.
KnownSurface
wedge (std::uint64_t seed);

// ---- additions and flaws

/// Adds another surface, scaled and moved.
KnownSurface
withComponent (KnownSurface surface, const KnownSurface& more, double scale,
               const Eigen::Vector3d& place);

/// Adds normal noise to every coordinate; `clean` are the points before that.
KnownSurface
withNoise (KnownSurface surface, double standard_deviation, std::uint64_t seed);

/// Adds points in and around the bounding box, each at least a distance away from all others.
KnownSurface
withOutliers (KnownSurface surface, std::size_t count, double distance, std::uint64_t seed);

/// Adds points that are equal to others.
KnownSurface
withDuplicates (KnownSurface surface, std::size_t count, std::uint64_t seed);

} // namespace pcl::floater::samples
