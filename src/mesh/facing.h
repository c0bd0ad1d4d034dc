// SPDX-License-Identifier: GPL-3.0-or-later
// Which side of a surface is its front.
#pragma once

#include "mesh/triangle_mesh.h"

namespace pcl
{
namespace floater
{
/// Turns every component of a mesh so that it faces outwards: a closed component encloses a
/// positive volume, and an open one, such as a bowl, a scanned face or half a statue, faces away
/// from its middle. A component that has no inside, such as terrain or a flat sheet, faces up the
/// axis along which its mean normal is longest, z before y before x where two are alike. O(n).
///
/// Weakness: of a closed component inside another one each faces away from itself, so that a hollow
/// body has its inner wall inside out.
/// \return number of components turned round
std::size_t
faceOutwards (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions);

} // namespace floater
} // namespace pcl
