// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Components of a mesh that are oriented together, and what tells their front.
#pragma once

#include "mesh/facing.h"

namespace pcl::floater {
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
             const FacingHints& hints, const FacingLimits& limits, const RunContext& run);

/// How far each object bulges out of its boundary to its front: the volume between it and the
/// middle of its boundary, signed over unsigned, from -1 to 1: 1 for a dome that faces outwards,
/// about 0 for a wave, 0 for a flat one. O(n).
/// \param flatness see FacingLimits
std::vector<double>
bulgesOf (const TriangleMesh& mesh, const Positions& positions, const MeshComponents& components,
          const FacingObjects& objects, double flatness);

/// Whether a sheet with this mean normal is to be turned to face up.
bool
facesDown (const Vector3d& normal, const FacingLimits& limits);

/// No terrain: it stands.
bool
isUpright (const Vector3d& normal, const FacingLimits& limits);

/// Confidence in a decision with this ratio of evidence for and against it, 1 or more. A factor of
/// two gives 0.9.
double
certaintyOf (double factor);

/// Confidence that terrain or a sheet faces up: what lies has been seen from above, what stands from
/// either side, and few roofs are steeper than 45 degrees.
double
certaintyOfUp (const Vector3d& normal);

/// Of boxes with openings in their sides only, most are rooms: of a box that was seen from outside,
/// nothing tells what is within, or the bottom is missing. All of the floor lies below the ceiling,
/// as in no part of a machine.
bool
isRoom (const FacingSums& sums, const FacingLimits& limits);

} // namespace pcl::floater
