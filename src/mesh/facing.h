// SPDX-License-Identifier: GPL-3.0-or-later
// Which side of a surface is its front.
#pragma once

#include "mesh/triangle_mesh.h"

namespace pcl
{
namespace floater
{
/// When an open component has an inside and an outside, and along which axis it faces if not.
struct FacingLimits
{
  double inside_share =
      0.3;                 ///< of the largest volume that an open component could enclose with its
                           ///< centroid (if all of it faced straight away from there); above, it
                           ///< has an inside. Measured on generated surfaces: a half sphere has
                           ///< 0.8, a round bowl half as deep 0.5, a volcano 0.25, terrain less
  double equal_axes = 0.9; ///< ratio of two components of the mean normal; above, they count as
                           ///< equal. Chosen, so that noise does not decide
};

/// Turns every component of a mesh so that it faces outwards. A closed component encloses a
/// positive volume. An open one, such as a bowl, a scanned face or half a statue, faces away from
/// its centroid. A component that has no inside, such as terrain or a flat sheet, faces up the axis
/// along which its mean normal is longest; of equal axes z comes before y before x. O(n).
///
/// Weakness: closed components are turned one by one, so the inner wall of a hollow body faces the
/// wrong way.
/// \return number of components turned round
std::size_t
faceOutwards (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const FacingLimits& limits, const RunContext& run);

} // namespace floater
} // namespace pcl
