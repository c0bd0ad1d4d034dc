// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Components of a mesh that are oriented together, and their sums.
#pragma once

#include "core/disjoint_sets.h"
#include "core/geometry.h"
#include "mesh/continuations.h"
#include "mesh/facing.h"

#include <algorithm>
#include <vector>

namespace pcl::floater {
/// Sums over the triangles of a component, or of the components of an object.
struct FacingSums
{
  Eigen::Vector3d area_vector = Eigen::Vector3d::Zero (); ///< doubled, as the area
  double area = 0.0;
  double volume = 0.0;               ///< six times the volume enclosed by a closed one
  double seen = 0.0, in_sight = 0.0; ///< from the sensor: signed and unsigned solid angle, doubled
  double from_above = 0.0;           ///< unsigned area seen along z; doubled
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

/// The sums of a component, or of some of its triangles. Volumes are relative to a near origin, for
/// precision.
struct ComponentSum
{
  FacingSums sum;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero (); ///< undefined without triangles

  void add (const ComponentSum& other)
  {
    if (other.sum.triangles == 0)
      return;
    if (sum.triangles == 0)
      origin = other.origin;
    sum.add (other.sum, 1.0);
    sum.volume += (other.origin - origin).dot (other.sum.area_vector);
  }
};

/// Objects and their components.
struct FacingObjects
{
  std::vector<Index> of_component;
  std::vector<std::uint8_t> is_opposite; ///< of each component: its front is the back of the object
  std::vector<FacingSums> sums;          ///< of each object

  double sign (Index component) const { return is_opposite[component] != 0 ? -1.0 : 1.0; }
};

inline Eigen::Vector3d
middleOf (const Triangle& t, const std::vector<Eigen::Vector3d>& positions)
{
  return (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3.0;
}

inline Eigen::Vector3d
areaVectorOf (const Triangle& t, const std::vector<Eigen::Vector3d>& positions)
{
  return areaVector (positions[t[0]], positions[t[1]], positions[t[2]]);
}

/// A boundary edge, with the surface on its left.
struct BoundarySegment
{
  Index component;
  Eigen::Vector3d from, to;
};

std::vector<BoundarySegment>
boundarySegments (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                  const MeshComponents& found);

/// Sums over the triangles of each component, by the sensor and the normals of the hints. O(n), on
/// all threads; the result does not depend on their number.
std::vector<ComponentSum>
sumTriangles (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const MeshComponents& found, const FacingHints& hints, const RunContext& run);

/// Sums of whole components; contradictory normals are moved to `contradictory`.
std::vector<FacingSums>
judgeNormals (const std::vector<ComponentSum>& components, const FacingLimits& limits);

/// The sums of each component of a mesh.
std::vector<FacingSums>
sumComponents (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const MeshComponents& found, const FacingHints& hints, const FacingLimits& limits,
               const RunContext& run);

/// Components to be oriented together, unless something contradicts.
std::vector<Continuation>
findTogether (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const MeshComponents& found, const std::vector<FacingSums>& sums,
              const FacingHints& hints, const FacingLimits& limits, const RunContext& run);

/// Joins components that continue each other, the strongest continuations first. Skips those that
/// contradict stronger ones or the input normals.
/// \param sums of the components
void
joinContinuations (std::vector<Continuation> continuations, const std::vector<FacingSums>& sums,
                   SignedSets& sets);

/// The objects in the order of their first components.
FacingObjects
makeObjects (const std::vector<FacingSums>& components, SignedSets sets);

/// How far each object bulges out of its boundary to its front: the volume between it and the
/// middle of its boundary, signed over unsigned, from -1 to 1: 1 for a dome that faces outwards,
/// about 0 for a wave, 0 for a flat one. O(n).
/// \param component of each triangle
/// \param flatness see FacingLimits
std::vector<double>
bulgesOf (const std::vector<Triangle>& triangles, const std::vector<Index>& component,
          const std::vector<Eigen::Vector3d>& positions,
          const std::vector<BoundarySegment>& boundary, const FacingObjects& objects,
          double flatness);

} // namespace pcl::floater
