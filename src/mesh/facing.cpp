// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/facing.h"

#include "core/parallel.h"
#include "mesh/facing_judge.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace pcl::floater {
MeshFacing
faceOutwards (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const FacingHints& hints, const FacingLimits& limits, const RunContext& run)
{
  MeshFacing facing;
  FacingHints usable = hints;
  facing.lacks_viewpoint =
      hints.wanted == Facing::VIEWPOINT && !hints.sensor && !hints.faces_sensor;
  if (facing.lacks_viewpoint)
    usable.wanted = Facing::AUTO;
  const MeshComponents found = findComponents (mesh, run);
  const std::vector<FacingSums> sums = sumComponents (mesh, positions, found, usable, limits, run);
  const std::vector<std::uint8_t> is_turned =
      judgeFacing (mesh, positions, found, sums,
                   findTogether (mesh, positions, found, sums, usable, limits, run), usable, limits,
                   run, facing);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (is_turned[found.of_triangle[t]] != 0) {
      std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
      std::swap (mesh.neighbors[t][1], mesh.neighbors[t][2]);
    }
  return facing;
}

namespace {
// Triangles per task. Sums of tasks are added in order: the result does not depend on threads.
constexpr std::size_t SUMMED = 65536;

// The sums of each component over consecutive triangles.
class PartialSums
{
public:
  PartialSums () = default;
  PartialSums (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const MeshComponents& found, const FacingHints& hints, double room_sine,
               std::size_t first, std::size_t last)
  {
    std::unordered_map<Index, std::size_t> places; // of components in parts_
    Index current = NONE;                          // component
    std::size_t place = 0;
    for (std::size_t t = first; t < last; ++t) {
      const Triangle& corners = mesh.triangles[t];
      if (found.of_triangle[t] != current) {
        current = found.of_triangle[t];
        place = places.emplace (current, parts_.size ()).first->second;
        if (place == parts_.size ())
          parts_.push_back ({current, {{}, positions[corners[0]]}});
      }
      ComponentSum& part = parts_[place].second;
      add (mesh.neighbors[t], corners, positions, hints, room_sine, part.origin, part.sum);
    }
  }

  void addTo (std::vector<ComponentSum>& sums) &&
  {
    const auto parts = std::move (parts_); // frees their memory
    for (const auto& [component, part] : parts)
      sums[component].add (part);
  }

private:
  static void add (const std::array<Index, 3>& neighbors, const Triangle& corners,
                   const std::vector<Eigen::Vector3d>& positions, const FacingHints& hints,
                   double room_sine, const Eigen::Vector3d& origin, FacingSums& sum)
  {
    ++sum.triangles;
    const Eigen::Vector3d area_vector = areaVectorOf (corners, positions);
    const double area = area_vector.norm ();
    sum.area_vector += area_vector;
    sum.area += area;
    const double from_above = std::abs (area_vector.z ());
    sum.from_above += from_above;
    if (from_above <= room_sine * area)
      sum.upright += area;
    else if (area_vector.head<2> ().norm () <= room_sine * area)
      sum.level += area;
    sum.volume += (positions[corners[0]] - origin).dot (area_vector);
    for (std::size_t i = 0; i < 3; ++i) {
      sum.at = std::min (sum.at, corners[i]);
      sum.box.extend (positions[corners[i]]);
      sum.is_closed = sum.is_closed && neighbors[i] != NONE;
    }
    if (hints.normals != nullptr)
      for (const Index p : corners) {
        const double part = area_vector.dot ((*hints.normals)[p].cast<double> ()) / 3.0;
        sum.along += part;
        sum.told += std::abs (part);
      }
    if (hints.sensor) {
      const Eigen::Vector3d way = *hints.sensor - middleOf (corners, positions);
      const double cube = way.squaredNorm () * way.norm ();
      const double solid_angle = cube > 0.0 ? way.dot (area_vector) / cube : 0.0;
      sum.seen += solid_angle;
      sum.in_sight += std::abs (solid_angle);
    }
  }

  std::vector<std::pair<Index, ComponentSum>> parts_; // of each component
};

} // namespace

std::vector<BoundarySegment>
boundarySegments (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                  const MeshComponents& found)
{
  std::vector<BoundarySegment> segments;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE)
        segments.push_back ({found.of_triangle[t], positions[mesh.from ({t, side})],
                             positions[mesh.to ({t, side})]});
  return segments;
}

std::vector<FacingSums>
sumComponents (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const MeshComponents& found, const FacingHints& hints, const FacingLimits& limits,
               const RunContext& run)
{
  const std::size_t triangles = mesh.triangles.size ();
  const double room_sine = std::sin (limits.room_angle * DEGREE);
  std::vector<PartialSums> parts ((triangles + SUMMED - 1) / SUMMED);
  parallelTasks (run, parts.size (), [&] (std::size_t i) {
    parts[i] = PartialSums (mesh, positions, found, hints, room_sine, i * SUMMED,
                            std::min (triangles, (i + 1) * SUMMED));
  });
  std::vector<ComponentSum> components (found.count);
  for (PartialSums& part : parts)
    std::move (part).addTo (components);
  std::vector<FacingSums> sums;
  sums.reserve (components.size ());
  for (const ComponentSum& component : components) {
    FacingSums& sum = sums.emplace_back (component.sum);
    if (std::abs (sum.along) < limits.normals_share * sum.told) {
      sum.contradictory = sum.told;
      sum.along = sum.told = 0.0;
    }
  }
  return sums;
}

std::vector<Continuation>
findTogether (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const MeshComponents& found, const std::vector<FacingSums>& sums,
              const FacingHints& hints, const FacingLimits& limits, const RunContext& run)
{
  if (hints.wanted == Facing::UP || hints.wanted == Facing::VIEWPOINT)
    return {};
  if (hints.faces_sensor && !hints.wantsASide ())
    return {};
  if (!hints.is_one_view && !hints.faces_sensor)
    return findContinuations (mesh, found, positions, limits.continuations, run);
  std::vector<Continuation> all; // each open component with all others
  Index first = NONE;
  for (Index c = 0; c < found.count; ++c)
    if (!sums[c].is_closed && first == NONE)
      first = c;
    else if (!sums[c].is_closed)
      all.push_back ({first, c, false, 0.0});
  return all;
}

void
joinContinuations (std::vector<Continuation> continuations, const std::vector<FacingSums>& sums,
                   SignedSets& sets)
{
  std::stable_sort (
      continuations.begin (), continuations.end (),
      [] (const Continuation& a, const Continuation& b) { return a.support > b.support; });
  // Of each representative: 1 or -1 by the normals of its set, 0 without normals.
  std::vector<int> told;
  told.reserve (sums.size ());
  for (const FacingSums& sum : sums)
    told.push_back (sum.along > 0.0 ? 1 : sum.along < 0.0 ? -1 : 0);
  for (const Continuation& one : continuations) {
    const SignedSets::Place a = sets.find (one.a), b = sets.find (one.b);
    const int sign = ((a.flipped != b.flipped) != one.is_opposite) ? -1 : 1;
    if (a.root == b.root || sign * told[a.root] * told[b.root] < 0)
      continue;
    sets.join (one.a, one.b, one.is_opposite);
    const Index root = sets.find (a.root).root, other = root == a.root ? b.root : a.root;
    if (told[root] == 0)
      told[root] = sign * told[other];
  }
}

FacingObjects
makeObjects (const std::vector<FacingSums>& components, SignedSets sets)
{
  FacingObjects objects;
  std::vector<Index> of_root (components.size (), NONE);
  for (Index c = 0; c < components.size (); ++c) {
    const SignedSets::Place place = sets.find (c);
    if (of_root[place.root] == NONE) {
      of_root[place.root] = static_cast<Index> (objects.sums.size ());
      objects.sums.emplace_back ();
    }
    objects.of_component.push_back (of_root[place.root]);
    objects.is_opposite.push_back (place.flipped ? 1 : 0);
    objects.sums[of_root[place.root]].add (components[c], objects.sign (c));
  }
  return objects;
}

std::vector<double>
bulgesOf (const std::vector<Triangle>& triangles, const std::vector<Index>& component,
          const std::vector<Eigen::Vector3d>& positions,
          const std::vector<BoundarySegment>& boundary, const FacingObjects& objects,
          double flatness)
{
  const std::size_t count = objects.sums.size ();
  std::vector<Eigen::Vector3d> middle (count, Eigen::Vector3d::Zero ()); // of the boundary
  std::vector<double> length (count, 0.0);
  for (const auto& [of, from, to] : boundary) {
    const Index o = objects.of_component[of];
    middle[o] += 0.5 * (to - from).norm () * (from + to);
    length[o] += (to - from).norm ();
  }
  for (std::size_t o = 0; o < count; ++o)
    if (length[o] > 0.0)
      middle[o] /= length[o];
  std::vector<double> bulges (count, 0.0), volumes (count, 0.0);
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    const Index o = objects.of_component[component[t]];
    const double volume = (middleOf (triangles[t], positions) - middle[o])
                              .dot (areaVectorOf (triangles[t], positions));
    bulges[o] += objects.sign (component[t]) * volume;
    volumes[o] += std::abs (volume);
  }
  for (std::size_t o = 0; o < count; ++o) {
    const FacingSums& sums = objects.sums[o];
    const bool is_flat =
        sums.box.isEmpty () || volumes[o] <= flatness * sums.area * sums.box.diagonal ().norm ();
    bulges[o] = is_flat ? 0.0 : bulges[o] / volumes[o];
  }
  return bulges;
}

bool
facesDown (const Eigen::Vector3d& normal, const FacingLimits& limits)
{
  const double longest = normal.cwiseAbs ().maxCoeff ();
  for (const int axis : {2, 1})
    if (std::abs (normal[axis]) >= limits.equal_axes * longest)
      return normal[axis] < 0.0;
  return normal.x () < 0.0;
}

bool
isUpright (const Eigen::Vector3d& normal, const FacingLimits& limits)
{
  return std::abs (normal.z ()) < limits.equal_axes * normal.cwiseAbs ().maxCoeff ();
}

double
certaintyOf (double factor)
{
  const double cube = factor * factor * factor;
  return cube / (1.0 + cube);
}

double
certaintyOfUp (const Eigen::Vector3d& normal)
{
  const double squared_length = normal.squaredNorm ();
  const double square = squared_length > 0.0 ? normal.z () * normal.z () / squared_length : 0.0;
  return 0.5 + 0.5 * square * square;
}

bool
isRoom (const FacingSums& sums, const FacingLimits& limits)
{
  constexpr double FURNITURE = 0.3; // or walls within; generated rooms have 0.15, and fandisk, a
                                    // part of a machine with level and upright faces, 0.57
  // Six times the floor, which is a quarter of the doubled area, times the height.
  const double prism = 1.5 * sums.from_above * sums.box.sizes ().z ();
  return sums.upright + sums.level >= limits.room_share * sums.area &&
         std::min (sums.upright, sums.level) >= limits.room_part * sums.area &&
         std::abs (sums.area_vector.z ()) <= limits.room_openings * sums.from_above &&
         sums.meanNormal () <= limits.room_openings &&
         std::abs (std::abs (sums.volume) - prism) <= FURNITURE * prism;
}

} // namespace pcl::floater
