// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/facing_objects.h"

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "points/kd_tree.h"

#include <map>

namespace pcl::floater {
namespace {
std::vector<FacingSums>
sumComponents (const TriangleMesh& mesh, const Positions& positions,
               const MeshComponents& components, const FacingHints& hints, const RunContext& run)
{
  // Area of a component whose input normals point to one side minus the other, as a share of its
  // area. Above, they decide; below, they are contradictory. Theory: midway between correct normals,
  // which have 1, and unoriented ones, which have 0: a quarter of the area has normals to the wrong
  // side.
  constexpr double NORMALS_SHARE = 0.5;
  const double room_sine = std::sin (20.0 * DEGREE); // of floors, ceilings and walls
  std::vector<FacingSums> sums (components.count);
  std::vector<Vector3d> origins (components.count); // near ones, for precision of the volumes
  ProgressLoop progress (run);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    progress.next ();
    const Triangle& corners = mesh.triangles[t];
    FacingSums& sum = sums[components.of_triangle[t]];
    Vector3d& origin = origins[components.of_triangle[t]];
    if (sum.triangles++ == 0)
      origin = positions[corners[0]];
    const Vector3d area_vector = areaVectorOf (corners, positions);
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
      sum.is_closed = sum.is_closed && mesh.neighbors[t][i] != NONE;
    }
    if (hints.normals != nullptr)
      for (const Index p : corners) {
        const double part = area_vector.dot ((*hints.normals)[p].cast<double> ()) / 3.0;
        sum.along += part;
        sum.told += std::abs (part);
      }
    if (hints.sensor) {
      const Vector3d way = *hints.sensor - middleOf (corners, positions);
      const double cube = way.squaredNorm () * way.norm ();
      const double solid_angle = cube > 0.0 ? way.dot (area_vector) / cube : 0.0;
      sum.seen += solid_angle;
      sum.in_sight += std::abs (solid_angle);
    }
  }
  for (FacingSums& sum : sums)
    if (std::abs (sum.along) < NORMALS_SHARE * sum.told) {
      sum.contradictory = sum.told;
      sum.along = sum.told = 0.0;
    }
  return sums;
}

struct OpenEdge
{
  Index component, from, to;
  double length;
  Vector3d along; // unit length, the surface on the left
  Vector3d ahead; // unit length, in the plane of the triangle, away from it
};

// Boundary edges; their directions are means with those of the edges before and after, since borders
// are ragged.
std::vector<OpenEdge>
findOpenEdges (const TriangleMesh& mesh, const Positions& positions,
               const MeshComponents& components)
{
  std::vector<OpenEdge> rough;
  std::vector<Index> leaving (positions.size (), NONE), arriving = leaving; // edges of each point
  for (const MeshEdge e : boundaryEdges (mesh)) {
    const Index from = mesh.from (e), to = mesh.to (e);
    const Vector3d step = positions[to] - positions[from], along = step.normalized ();
    const Vector3d normal = areaVectorOf (mesh.triangles[e.triangle], positions).normalized ();
    leaving[from] = arriving[to] = static_cast<Index> (rough.size ());
    rough.push_back (
        {components.of_triangle[e.triangle], from, to, step.norm (), along, along.cross (normal)});
  }
  std::vector<OpenEdge> edges = rough;
  for (OpenEdge& edge : edges) {
    for (const Index j : {arriving[edge.from], leaving[edge.to]}) {
      edge.along += rough[j].along;
      edge.ahead += rough[j].ahead;
    }
    edge.along.normalize ();
    edge.ahead.normalize ();
  }
  return edges;
}

// How well one edge continues another: positive if their fronts are on the same side.
double
agreement (const OpenEdge& one, const OpenEdge& other, const Vector3d& across, double cosine)
{
  const double ahead = across.dot (one.ahead), back = -across.dot (other.ahead);
  return ahead >= cosine && back >= cosine ? -one.along.dot (other.along) * ahead * back : 0.0;
}

// Two components, one continuing the other.
struct Continuation
{
  Index a, b;       // a < b
  bool is_opposite; // their fronts are on opposite sides
  double support; // length of the edges of both with this orientation, minus the contradicting ones
};

// In the order of (a, b).
std::vector<Continuation>
findContinuations (const TriangleMesh& mesh, const Positions& positions,
                   const MeshComponents& components, const RunContext& run)
{
  constexpr double REACH = 8.0; // largest gap, in mean boundary edges of the component
  // Of the angle between the direction across the gap and the direction in which either surface ends;
  // sheets above each other have 0.
  constexpr double COSINE = 0.5;
  // Of the edges that continue each other, by length: majority for one orientation over the other, as
  // a share of all.
  constexpr double AGREEMENT = 0.5;
  // Of Continuation::support, over the length of the shorter border. The walls of generated hollow
  // bodies, which do not continue each other, reach 0.08; halves of a square have 0.3.
  constexpr double SUPPORT = 0.1;
  if (components.count < 2)
    return {};
  const std::vector<OpenEdge> edges = findOpenEdges (mesh, positions, components);
  Positions middles;
  std::vector<double> length (components.count, 0.0), count = length;
  for (const OpenEdge& edge : edges) {
    middles.emplace_back (0.5 * (positions[edge.from] + positions[edge.to]));
    length[edge.component] += edge.length;
    count[edge.component] += 1.0;
  }
  if (std::count (count.begin (), count.end (), 0.0) + 1 >=
      static_cast<std::ptrdiff_t> (components.count))
    return {};
  struct Vote
  {
    Index other = NONE; // NONE: not continued by another component
    double weight = 0.0;
  };
  const KdTree tree (middles, run);
  std::vector<Vote> votes (edges.size ());
  using Neighbors = std::vector<Neighbor>;
  parallelPoints<Neighbors> (run, votes.size (), [&] (Index i, Neighbors& near) {
    const OpenEdge& edge = edges[i];
    const auto to = [&] (Index j, const Vector3d& middle) {
      return agreement (edge, edges[j], (middle - middles[i]).normalized (), COSINE);
    };
    const auto faces = [&] (const Neighbor& neighbor, const Vector3d& middle) {
      return std::abs (to (neighbor.point, middle)) > 0.0;
    };
    const double reach = REACH * (length[edge.component] / count[edge.component]);
    tree.nearestIf (middles[i], edge.ahead, reach, 1, faces, near);
    if (!near.empty () && edges[near.front ().point].component != edge.component) {
      const Index j = near.front ().point;
      votes[i] = {edges[j].component, edge.length * to (j, middles[j])};
    }
  });
  std::map<std::pair<Index, Index>, std::pair<double, double>> sums; // signed and unsigned weights
  for (std::size_t i = 0; i < votes.size (); ++i)
    if (votes[i].other != NONE) {
      auto& [sum, unsigned_sum] = sums[std::minmax (edges[i].component, votes[i].other)];
      sum += votes[i].weight;
      unsigned_sum += std::abs (votes[i].weight);
    }
  std::vector<Continuation> found;
  for (const auto& [pair, sum] : sums) {
    const auto [a, b] = pair;
    const double support = std::abs (sum.first);
    if (support >= AGREEMENT * sum.second && support >= SUPPORT * std::min (length[a], length[b]))
      found.push_back ({a, b, sum.first < 0.0, support});
  }
  return found;
}

// Components to be oriented together, unless something contradicts.
std::vector<Continuation>
findTogether (const TriangleMesh& mesh, const Positions& positions,
              const MeshComponents& components, const std::vector<FacingSums>& sums,
              const FacingHints& hints, const RunContext& run)
{
  if (hints.wanted == Facing::UP || hints.wanted == Facing::VIEWPOINT ||
      (hints.faces_sensor && !hints.wantsASide ()))
    return {};
  if (!hints.is_one_view && !hints.faces_sensor)
    return findContinuations (mesh, positions, components, run);
  std::vector<Continuation> all; // each open component with all others
  Index first = NONE;
  for (Index c = 0; c < components.count; ++c)
    if (!sums[c].is_closed && first == NONE)
      first = c;
    else if (!sums[c].is_closed)
      all.push_back ({first, c, false, 0.0});
  return all;
}

} // namespace

FacingObjects
findObjects (const TriangleMesh& mesh, const Positions& positions, const MeshComponents& components,
             const FacingHints& hints, const RunContext& run)
{
  const std::vector<FacingSums> sums = sumComponents (mesh, positions, components, hints, run);
  std::vector<Continuation> continuations =
      findTogether (mesh, positions, components, sums, hints, run);
  SignedSets sets (sums.size ());
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
  FacingObjects objects;
  std::vector<Index> of_root (sums.size (), NONE);
  for (Index c = 0; c < sums.size (); ++c) {
    const SignedSets::Place place = sets.find (c);
    if (of_root[place.root] == NONE) {
      of_root[place.root] = static_cast<Index> (objects.sums.size ());
      objects.sums.emplace_back ();
    }
    objects.of_component.push_back (of_root[place.root]);
    objects.is_opposite.push_back (place.flipped ? 1 : 0);
    objects.sums[of_root[place.root]].add (sums[c], objects.sign (c));
  }
  return objects;
}

std::vector<double>
bulgesOf (const TriangleMesh& mesh, const Positions& positions, const MeshComponents& components,
          const FacingObjects& objects)
{
  const std::size_t count = objects.sums.size ();
  std::vector<Vector3d> middle (count, Vector3d::Zero ()); // of the boundary
  std::vector<double> length (count, 0.0);
  for (const MeshEdge e : boundaryEdges (mesh)) {
    const Vector3d &from = positions[mesh.from (e)], &to = positions[mesh.to (e)];
    const Index o = objects.of_component[components.of_triangle[e.triangle]];
    middle[o] += 0.5 * (to - from).norm () * (from + to);
    length[o] += (to - from).norm ();
  }
  for (std::size_t o = 0; o < count; ++o)
    if (length[o] > 0.0)
      middle[o] /= length[o];
  std::vector<double> bulges (count, 0.0), volumes (count, 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    const Index component = components.of_triangle[t], o = objects.of_component[component];
    const double volume = (middleOf (mesh.triangles[t], positions) - middle[o])
                              .dot (areaVectorOf (mesh.triangles[t], positions));
    bulges[o] += objects.sign (component) * volume;
    volumes[o] += std::abs (volume);
  }
  for (std::size_t o = 0; o < count; ++o) {
    const FacingSums& sums = objects.sums[o];
    const bool is_flat = sums.box.isEmpty () || volumes[o] <= FacingLimits::FLATNESS * sums.area *
                                                                  sums.box.diagonal ().norm ();
    bulges[o] = is_flat ? 0.0 : bulges[o] / volumes[o];
  }
  return bulges;
}

bool
isRoom (const FacingSums& sums)
{
  // Of the area: at least in floors, ceilings and walls, and in each kind; at most in openings, with as
  // much floor as ceiling. A ball has a SHARE of 0.4, a sheet no ceiling, a tube no floor, and what
  // stands on the ground no bottom.
  constexpr double SHARE = 0.7, PART = 0.1, OPENINGS = 0.1;
  constexpr double FURNITURE = 0.3; // or walls within; generated rooms have 0.15, and fandisk, a
                                    // part of a machine with level and upright faces, 0.57
  // Six times the floor, which is a quarter of the doubled area, times the height.
  const double prism = 1.5 * sums.from_above * sums.box.sizes ().z ();
  return sums.upright + sums.level >= SHARE * sums.area &&
         std::min (sums.upright, sums.level) >= PART * sums.area &&
         std::abs (sums.area_vector.z ()) <= OPENINGS * sums.from_above &&
         sums.meanNormal () <= OPENINGS &&
         std::abs (std::abs (sums.volume) - prism) <= FURNITURE * prism;
}

} // namespace pcl::floater
