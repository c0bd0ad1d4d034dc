// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Components of a mesh that are turned together, and their sums.
#pragma once

#include "core/disjoint_sets.h"
#include "core/geometry.h"
#include "mesh/continuations.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace pcl
{
namespace floater
{
/// Sums over the triangles of a component, or of the components of an object.
struct FacingSums
{
  Eigen::Vector3d area_vector = Eigen::Vector3d::Zero (); ///< doubled, as the area
  double area = 0.0;
  double volume = 0.0;               ///< six times that which a closed one encloses
  double seen = 0.0, in_sight = 0.0; ///< from the sensor: signed and unsigned solid angle, doubled
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
    triangles += other.triangles;
    at = std::min (at, other.at);
    is_closed = is_closed && other.is_closed;
    box.extend (other.box);
  }

  double meanNormal () const { return area > 0.0 ? area_vector.norm () / area : 0.0; }
};

/// Components by the objects that they make up.
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

/// O(n).
std::vector<FacingSums>
sumComponents (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const MeshComponents& found, const std::optional<Eigen::Vector3d>& sensor,
               const RunContext& run);

/// Joins components that continue each other, the strongest continuations first. Those that
/// contradict them are left out.
void
joinContinuations (std::vector<Continuation> continuations, SignedSets& sets);

/// The objects in the order of their first components.
FacingObjects
makeObjects (const std::vector<FacingSums>& components, SignedSets sets);

} // namespace floater
} // namespace pcl
