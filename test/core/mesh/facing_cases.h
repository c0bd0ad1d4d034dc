// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Generated meshes of which it is known how they should face, for tests.
#pragma once

#include "mesh/facing.h"
#include "random_stream.h"

#include <string>
#include <vector>

namespace pcl::floater::facing_cases {
/// What a case is an example of.
enum class Family
{
  WINGED_BODY,      ///< thin parts and handles, 1 to 10 windows of 1 to 50 % of the area
  HOLLOW_SHELL,     ///< both walls of a hollow body, each with windows; the solid lies between
  NESTED_BODIES,    ///< closed bodies within each other
  BODY_IN_SHELL,    ///< a closed body in another one that has windows
  TUBE,             ///< open at both ends, lengths of 0.2 to 10 radii
  TORUS,            ///< with windows
  DEEP_CAP,         ///< of a sphere, 30 to 98 % of its area
  SHALLOW_CAP,      ///< a valley or dome, 1 to 20 % of the area of the sphere
  TERRAIN,          ///< heights of all slopes up to 45 degrees, pits, ridges, steps
  HALF_STATUE,      ///< what is seen of a body from one side
  CUT_STATUE,       ///< a body open at the bottom
  TORN_SHEET,       ///< terrain or a curtain in pieces beside each other
  TORN_BODY,        ///< a closed body in pieces
  SCAN_WITH_SENSOR, ///< any surface that was seen from a sensor, which is told
  COUNT
};

const char*
familyName (Family family);

/// A mesh that faces as it should. Where no direction is up, it is turned at random.
struct FacingCase
{
  std::vector<Eigen::Vector3d> positions;
  TriangleMesh mesh;
  FacingHints hints;
  double parameter = 0.0; ///< of a cap: share of its sphere
};

/// 500 to 20,000 triangles. The same for the same seed.
FacingCase
makeFacingCase (Family family, std::uint64_t seed);

/// A cap of a sphere that is open at the top, of 2 side^2 triangles.
FacingCase
makeBowl (double share_of_area, int side = 30);

/// The mesh with some components turned round at random.
TriangleMesh
turnAtRandom (const FacingCase& one, RandomStream& random);

/// Share of the area that does not face as in the case.
double
wrongShare (const FacingCase& one, const TriangleMesh& mesh);

} // namespace pcl::floater::facing_cases
