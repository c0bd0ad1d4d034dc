// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Components of a mesh that are oriented together, and what tells their front.
#pragma once

#include "mesh/facing.h"

namespace pcl::floater {
/// Thresholds of the facing.
struct FacingLimits
{
  /// By how much more the front is visible from outside than the back, as a share of all
  /// directions, relative to the length of the mean normal. Above, the surface has an inside. A cap
  /// with a share f of the area of its sphere has f and 1 - f, so that a bowl becomes a valley at f
  /// = 1/4, where its rim is 60 degrees steep. Theory: an open pit with slopes of 45 degrees, which is
  /// terrain, has 0.31; a half sphere, which is half a body, has 1.
  static constexpr double BODY_RATIO = 1.0 / 3.0;

  /// Share of an object: area facing the sensor minus area facing away, by solid angle. Above, it
  /// was seen from there: one scan has 1 minus its noise; a whole body, half hidden, has 0.
  static constexpr double SEEN_SHARE = 0.8;

  /// Share of the directions from the sensor in which the inside of a closed component is visible:
  /// 1 within it, 0 outside. Midway.
  static constexpr double WITHIN_SHARE = 0.5;

  /// Mean height of a flat object, as a share of its size: rounding of 32-bit coordinates. Flatter
  /// objects have no bulge.
  static constexpr double FLATNESS = 1e-6;

  /// Bulge (see bulgesOf) above which a sheet that stands faces the side to which it bulges. Theory:
  /// a wave has about 0, a dome 1; midway between a wave and an even mixture of both.
  static constexpr double BULGE = 0.25;

  /// Ratio above which the lengths of the mean normal along two axes count as equal. Chosen by
  /// hand.
  static constexpr double EQUAL_AXES = 0.9;

  /// How much an inner object may protrude from an outer one, as a share of its box: windows may
  /// have cut off the outer one there. Chosen by hand.
  static constexpr double NESTING_MARGIN = 0.1;
  /// Lines whose majority decides whether an object is within another one.
  static constexpr std::size_t NESTING_LINES = 15;

  /// An open body within another one is separate, not the wall of a hollow, if its front has this
  /// many times as many free lines of sight as its back, beyond a few by chance. Walls of generated
  /// hollow bodies with windows have up to 3 times as many.
  static constexpr std::size_t OWN_BODY_RATIO = 8, CHANCE_LINES = 2;
};

/// Sums over the triangles of a component, or of the components of an object.
struct FacingSums
{
  Vector3d area_vector = Vector3d::Zero (); ///< doubled, as the area
  double area = 0.0;
  double volume = 0.0;               ///< six times the volume enclosed by a closed one
  double seen = 0.0, in_sight = 0.0; ///< from the sensor: signed and unsigned solid angle, doubled
  double from_above = 0.0;           ///< unsigned area seen along z; doubled
  double upright = 0.0, level = 0.0; ///< area of walls, and of floors and ceilings; doubled
  double along = 0.0, told = 0.0;    ///< area times cosine to the input normals, signed and
                                     ///< unsigned, of components with agreeing normals; doubled
  double contradictory = 0.0;        ///< unsigned, of components with contradictory normals
  std::size_t triangles = 0;
  Index at = NONE;
  bool is_closed = true;
  Eigen::AlignedBox3d box;

  void add (const FacingSums& other, double sign)
  {
    area_vector += sign * other.area_vector;
    area += other.area;
    volume += sign * other.volume;
    seen += sign * other.seen;
    in_sight += other.in_sight;
    from_above += other.from_above;
    upright += other.upright;
    level += other.level;
    along += sign * other.along;
    told += other.told;
    contradictory += other.contradictory;
    triangles += other.triangles;
    at = std::min (at, other.at);
    is_closed = is_closed && other.is_closed;
    box.extend (other.box);
  }

  double meanNormal () const { return area > 0.0 ? area_vector.norm () / area : 0.0; }
};

/// Objects and their components.
struct FacingObjects
{
  std::vector<Index> of_component;
  Flags is_opposite;            ///< of each component: its front is the back of the object
  std::vector<FacingSums> sums; ///< of each object

  double sign (Index component) const { return is_opposite[component] != 0 ? -1.0 : 1.0; }
};

/// Joins components that continue each other across a gap. For each boundary edge, finds the nearest one
/// ahead that faces it. If it belongs to another component, that one continues this one. If both edges
/// run in the same direction, the fronts are on opposite sides, whatever the angle between the
/// surfaces: shared edges have opposite directions. The strongest continuations come first; those that
/// contradict stronger ones or the input normals are skipped. O(n), and O(b log b) for b boundary edges
/// of several components.
/// \return the objects in the order of their first components. Contradictory normals are moved to
///     `contradictory`
FacingObjects
findObjects (const TriangleMesh& mesh, const Positions& positions, const MeshComponents& components,
             const FacingHints& hints, const RunContext& run);

/// How far each object bulges out of its boundary to its front: the volume between it and the
/// middle of its boundary, signed over unsigned, from -1 to 1: 1 for a dome that faces outwards,
/// about 0 for a wave, 0 for a flat one. O(n).
std::vector<double>
bulgesOf (const TriangleMesh& mesh, const Positions& positions, const MeshComponents& components,
          const FacingObjects& objects);

/// Of boxes with openings in their sides only, most are rooms: of a box that was seen from outside,
/// nothing tells what is within, or the bottom is missing. All of the floor lies below the ceiling,
/// as in no part of a machine.
bool
isRoom (const FacingSums& sums);

} // namespace pcl::floater
