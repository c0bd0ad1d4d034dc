// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Orientation of components: which side is the front.
#pragma once

#include "mesh/triangle_mesh.h"

#include <pcl/surface/floater/report.h>

namespace pcl::floater {
/// Thresholds for the continuation of a boundary edge.
struct ContinuationLimits
{
  double reach = 8.0;  ///< largest gap, in mean boundary edges of the component
  double cosine = 0.5; ///< of the angle between the direction across the gap and the direction in
                       ///< which either surface ends; sheets above each other have 0
  double agreement = 0.5; ///< of the edges that continue each other, by length: majority for one
                          ///< orientation over the other, as a share of all
  double support = 0.1;   ///< of Continuation::support, over the length of the shorter border. The
                          ///< walls of generated hollow bodies, which do not continue each other,
                          ///< reach 0.08; halves of a square have 0.3
};

/// Thresholds of the facing.
struct FacingLimits
{
  /// By how much more the front is visible from outside than the back, as a share of all
  /// directions, relative to the length of the mean normal. Above, the surface has an inside. A cap
  /// with a share f of the area of its sphere has f and 1 - f, so that a bowl becomes a valley at f
  /// = 1/4, where its rim is 60 degrees steep. Theory: an open pit with slopes of 45 degrees, which is
  /// terrain, has 0.31; a half sphere, which is half a body, has 1.
  double body_ratio = 1.0 / 3.0;

  std::size_t lines = 512; ///< most lines of sight through an object. The shares then have a
                           ///< standard deviation of 0.02
  std::size_t triangles_per_line = 8; ///< smaller objects get fewer lines, ...
  std::size_t fewest_lines = 64;      ///< ... but at least this number. Both limit the time

  /// Share of an object: area facing the sensor minus area facing away, by solid angle. Above, it
  /// was seen from there: one scan has 1 minus its noise; a whole body, half hidden, has 0.
  double seen_share = 0.8;

  /// Area of a component whose input normals point to one side minus the other, as a share of its
  /// area. Above, they decide; below, they are contradictory. Theory: midway between correct
  /// normals, which have 1, and unoriented ones, which have 0: a quarter of the area has normals to
  /// the wrong side.
  double normals_share = 0.5;

  /// Share of the directions from the sensor in which the inside of a closed component is visible:
  /// 1 within it, 0 outside. Midway.
  double within_share = 0.5;

  /// A room has at least this share of its area in floors, ceilings and walls, to so many degrees; at
  /// least a tenth of it in each kind, as much floor as ceiling, and openings in no more than this
  /// share of its area. A ball has a room_share of 0.4, a sheet no ceiling, a tube no floor, and what
  /// stands on the ground no bottom.
  double room_share = 0.7, room_part = 0.1, room_angle = 20.0, room_openings = 0.1;

  /// Mean height of a flat object, as a share of its size: rounding of 32-bit coordinates. Flatter
  /// objects have no bulge.
  double flatness = 1e-6;

  /// Bulge (see bulgesOf) above which a sheet that stands faces the side to which it bulges. Theory:
  /// a wave has about 0, a dome 1; midway between a wave and an even mixture of both.
  double bulge = 0.25;

  /// Ratio above which the lengths of the mean normal along two axes count as equal. Chosen by
  /// hand.
  double equal_axes = 0.9;

  /// How much an inner object may protrude from an outer one, as a share of its box: windows may
  /// have cut off the outer one there. Chosen by hand.
  double nesting_margin = 0.1;
  std::size_t nesting_lines = 15; ///< their majority decides whether an object is within another
                                  ///< one

  /// An open body within another one is separate, not the wall of a hollow, if its front has this
  /// many times as many free lines of sight as its back, beyond a few by chance. Walls of generated
  /// hollow bodies with windows have up to 3 times as many.
  std::size_t own_body_ratio = 8;
  std::size_t chance_lines = 2;

  ContinuationLimits continuations;
};

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
///   FacingLimits::body_ratio). Within another body, that one hides it too: the inner wall of a
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
              const FacingLimits& limits, const RunContext& run);

} // namespace pcl::floater
