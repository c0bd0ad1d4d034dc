// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Generated meshes of which it is known how they should face, for tests.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater::facing_cases {
/// What a case is an example of. All are bent and turned at random.
enum class Family
{
  WINGED_BODY,   ///< a flat one with a handle and 1 to 10 windows
  HOLLOW_SHELL,  ///< both walls of a hollow body, each with windows; the solid lies between
  NESTED_BODIES, ///< closed bodies within each other, and one beside them
  BODY_IN_SHELL, ///< a closed body in another one that has windows
  TORN_BODY,     ///< in pieces
  COUNT
};

const char*
familyName (Family family);

/// A mesh that faces as it should.
struct FacingCase
{
  std::vector<Eigen::Vector3d> positions;
  TriangleMesh mesh;
};

/// Thousands of triangles. The same for the same seed.
FacingCase
makeFacingCase (Family family, std::uint64_t seed);

/// A cap around -z of the unit sphere, open at the top, of 2 side^2 triangles. The front is
/// outside.
FacingCase
makeBowl (double share_of_area, int side = 30);

} // namespace pcl::floater::facing_cases
