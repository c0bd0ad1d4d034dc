// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which side of a surface is its front.
#pragma once

#include "mesh/continuations.h"
#include "mesh/triangle_mesh.h"

#include <pcl/surface/floater/report.h>

#include <optional>
#include <vector>

namespace pcl::floater {
/// When a surface has an inside and an outside, and along which axis it faces if not.
struct FacingLimits
{
  /// How much more of the front than of the back is seen from outside, as a share of all
  /// directions, by the length of the mean normal. Above, the surface has an inside. Of a cap whose
  /// area is a share f of its sphere they are f and 1 - f, so that a bowl becomes a valley at
  /// f = 1/4, where its rim is 60 degrees steep. Theory: an open pit with slopes of 45 degrees,
  /// which is terrain, has 0.31; a half sphere, which is half a body, has 1.
  double body_ratio = 1.0 / 3.0;

  std::size_t lines = 512; ///< at most, through an object, to see which of its sides is hidden. The
                           ///< shares have a standard deviation of 0.02 then
  std::size_t triangles_per_line = 8; ///< there are fewer lines through smaller objects, ...
  std::size_t fewest_lines = 64;      ///< ... but so many. Both: a matter of time

  /// Share of the mesh that nothing hides from the sensor; and of an object, by how much more of it
  /// faces the sensor than looks away, by solid angle. If both are above, it was seen from there:
  /// one scan has 1 less its noise, while a whole body is hidden by half, and has 0.
  double seen_share = 0.8;

  /// By how much more of a component, as a share of its area, the normals of the input point to one
  /// side than to the other. Above, they decide; below, they contradict each other. Theory: midway
  /// between normals without a fault, which have 1, and those that were never oriented, which have
  /// 0: a quarter of the area has normals to the wrong side.
  double normals_share = 0.5;

  /// Share of its directions from which the place of a sensor sees the inside of a closed
  /// component: 1 within it, 0 outside. Midway.
  double within_share = 0.5;

  /// Mean height of a flat object, as a share of its size. Rounding of 32-bit coordinates; below,
  /// it bulges to no side.
  double flatness = 1e-6;

  /// Ratio of the lengths of the mean normal along two axes. Above, they count as equal. Chosen by
  /// hand.
  double equal_axes = 0.9;

  /// How much an object may stick out of another one, as a share of its box, and still lie in it:
  /// windows may have cut off where the outer one protruded. Chosen by hand.
  double nesting_margin = 0.1;
  std::size_t nesting_lines = 15; ///< by whose majority an object lies in another one or not

  /// An open body within another one is a body of its own, and not the wall of a hollow, if more
  /// lines are free of its front than of its back: so many times as many, beyond a few by chance.
  /// At the walls of generated hollow bodies with windows, up to 3 times as many are.
  std::size_t own_body_ratio = 8;
  std::size_t chance_lines = 2;

  ContinuationLimits continuations;
};

/// What is known beyond the mesh.
struct FacingHints
{
  std::optional<Eigen::Vector3d> sensor; ///< position of the sensor, if known
  bool is_one_view = false;  ///< all open components already have the same orientation: towards the
                             ///< unknown sensor, or away from it
  bool faces_sensor = false; ///< all open components face the sensor already
  Facing wanted = Facing::AUTO;
  const std::vector<Eigen::Vector3f>* normals = nullptr; ///< of the points, to the front of the
                                                         ///< surface, zero where there is none
};

/// Why the evidence that was to decide has not done so.
enum class FacingMiss
{
  NOTHING,       ///< it has
  CONTRADICTION, ///< the normals point to both sides
  NO_NORMALS,    ///< no point has a normal
  CLOSED,        ///< neither up nor the viewpoint is on one side of a closed component
  COUNT
};

/// Components that continue each other, or one alone.
struct FacingObject
{
  FacingRule rule = FacingRule::SHEET;
  double certainty = 1.0;    ///< 0.5: as good as guessed, to 1
  double front = 0.0;        ///< share of directions in which the front sees the outside; ...
  double back = 0.0;         ///< ... and the back; both 0 if they were not looked at
  double mean_normal = 0.0;  ///< its length: 1 of a plane, 0 of a closed surface
  std::size_t triangles = 0; ///< of all its components
  Index at = NONE;           ///< its smallest point
  FacingMiss miss = FacingMiss::NOTHING;
};

struct MeshFacing
{
  std::size_t turned = 0;            ///< components that were turned round
  std::vector<FacingObject> objects; ///< in the order of their first triangles
  bool lacks_viewpoint = false;      ///< the mesh was to face the viewpoint, and none is known
};

/// Turns every component of a mesh so that its front is where it can be seen. Components that
/// continue each other are turned together, as one object.
///
/// - If there are normals of the points, those of a component that agree decide. It is not turned
///   together with another one whose normals tell otherwise.
/// - A closed one encloses a positive volume. In an odd number of other bodies, it is the wall of a
///   hollow, and faces into it; but not if it is seen through windows of those bodies.
/// - One that was seen from the sensor faces the sensor.
/// - A body, such as a statue open at the bottom, a tube, a scanned face or half a sphere, faces
///   where more of it is seen from outside, by lines through it in all directions (see
///   FacingLimits::body_ratio). If it lies within another body, that one hides it, too: the inner
///   wall of a hollow with windows faces into the hollow.
/// - Terrain or a flat sheet, of which both sides are seen alike, faces up the axis along which its
///   mean normal is longest; of equal axes z comes before y before x.
///
/// This is Facing::AUTO, and what is done where another choice does not decide. With OUTWARDS, a
/// sheet faces where more of it is seen from outside, by however little; where that is chance, the
/// side to which it bulges out of its boundary. With UP and VIEWPOINT, every component is turned by
/// itself.
///
/// O(n log n), about 0.3 microseconds per point of a body.
MeshFacing
faceOutwards (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const FacingHints& hints, const FacingLimits& limits, const RunContext& run);

} // namespace pcl::floater
