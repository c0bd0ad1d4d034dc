// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Orientation of components: which side is the front.
#pragma once

#include "mesh/triangle_mesh.h"

#include <pcl/surface/floater/report.h>

namespace pcl::floater {
/// Facts beyond the mesh.
struct FacingHints
{
  std::optional<Vector3d> sensor; ///< position of the sensor, if known
  bool is_one_view = false;  ///< all open components already have the same orientation: towards the
                             ///< unknown sensor, or away from it
  bool faces_sensor = false; ///< all open components face the sensor already
  Facing wanted = Facing::AUTO;
  const Normals* normals = nullptr; ///< of the points, to the front of the
                                    ///< surface, zero where unknown

  bool wantsASide () const { return wanted == Facing::OUTWARDS || wanted == Facing::INWARDS; }
};

/// Why the requested evidence did not decide.
enum class FacingMiss
{
  NOTHING,       ///< it decided
  CONTRADICTION, ///< the normals point to both sides
  NO_NORMALS,    ///< no point has a normal
  CLOSED,        ///< up or viewpoint do not apply to a closed component
  COUNT
};

/// A component, or several that continue each other.
struct FacingObject
{
  FacingRule rule = FacingRule::SHEET;
  double certainty = 1.0;    ///< confidence: 0.5 (a guess) to 1
  double front = 0.0;        ///< share of directions in which the outside is visible from the
                             ///< front; ...
  double back = 0.0;         ///< ... and from the back; both 0 if not computed
  double mean_normal = 0.0;  ///< its length: 1 for a plane, 0 for a closed surface
  std::size_t triangles = 0; ///< of all its components
  Index at = NONE;           ///< its smallest point
  FacingMiss miss = FacingMiss::NOTHING;
};

struct MeshFacing
{
  std::size_t turned = 0;            ///< components that were flipped
  std::vector<FacingObject> objects; ///< in the order of their first triangles
  bool lacks_viewpoint = false;      ///< the mesh should face the viewpoint, but it is unknown
};

/// Orients every component of a mesh so that its front is the visible side. Components that
/// continue each other form one object and are oriented together.
///
/// - If the normals of a component's points agree, they decide. It is then not joined to a
///   component whose normals contradict.
/// - A closed component encloses a positive volume. Within an odd number of other bodies it is the
///   wall of a hollow, and faces into it, unless it is visible through windows of those bodies.
/// - A component that was seen from the sensor faces the sensor.
/// - A room, which has a floor, a ceiling and walls with openings, faces the people in it.
/// - A body, such as a statue open at the bottom, a tube, a scanned face or half a sphere, faces
///   the side that is more visible from outside, by lines of sight in all directions (see
///   FacingLimits::BODY_RATIO). Within another body, that one hides it too: the inner wall of a
///   hollow with windows faces into the hollow.
/// - Terrain or a flat sheet, with equally visible sides, faces up along the axis of its longest
///   mean normal; for equal axes, z comes before y before x. One that stands and bulges faces the
///   side to which it bulges.
///
/// This is Facing::AUTO, and the fallback of the other choices. With OUTWARDS, a sheet faces its
/// more visible side, however small the difference; if it is within chance, the side to which it
/// bulges. INWARDS is the opposite of it. With UP and VIEWPOINT, every component is oriented by
/// itself. O(n log n), about 0.3 microseconds per point of a body.
MeshFacing
faceOutwards (TriangleMesh& mesh, const Positions& positions, const FacingHints& hints,
              const RunContext& run);

} // namespace pcl::floater
