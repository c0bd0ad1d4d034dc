// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/seam_check.h"

#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/examination.h"
#include "mesh/facing_judge.h"
#include "mesh/flips.h"
#include "mesh/vertex_stars.h"
#include "parts/joined_rims.h"
#include "parts/seam_finish.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace pcl::floater {
namespace {
template <typename Value>
std::vector<Value>
valuesOf (const std::vector<Value>& values, const JoinedPoints& points)
{
  std::vector<Value> some;
  some.reserve (points.size ());
  for (Index place = 0; place < points.size (); ++place)
    some.push_back (values[points.pointAt (place)]);
  return some;
}

// The triangles of the seam zones, and the inner ones near them.
class SeamChecker
{
public:
  SeamChecker (FinishedSeam seam, NearTriangles near, const std::vector<InnerCheck>& checks,
               const Points& points, const PartsCheckSettings& settings, const RunContext& run)
      : checks_ (checks), cloud_ (points), settings_ (settings), run_ (run),
        zones_ (std::move (seam.zones)), near_ (std::move (near)),
        seam_count_ (seam.triangles.size ())
  {
    std::vector<Index> used;
    used.reserve (zones_.points.size () + near_.points.size ());
    std::set_union (zones_.points.begin (), zones_.points.end (), near_.points.begin (),
                    near_.points.end (), std::back_inserter (used));
    points_ = JoinedPoints (std::move (used));
    takeValues ();
    mesh_.is_partial.assign (points_.size (), 1);
    for (const Index p : zones_.points) {
      zone_places_.push_back (points_.placeOf (p));
      mesh_.is_partial[zone_places_.back ()] = 0;
    }
    mesh_.triangles.resize (seam_count_ + near_.triangles.size ());
    parallelRanges (run, mesh_.triangles.size (), [&] (std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t)
        for (std::size_t i = 0; i < 3; ++i)
          mesh_.triangles[t][i] = t < seam_count_
                                      ? zone_places_[seam.triangles[t][i]]
                                      : points_.placeOf (near_.triangles[t - seam_count_][i]);
    });
    if (!mesh_.connect (points_.size (), run))
      throw std::logic_error ("the finished parts do not fit");
  }

  // Removes self-intersections.
  void uncross ()
  {
    CrossingPairs pairs = findCrossing ();
    crossing_.found = pairs.size ();
    if (!pairs.empty () && pairs.untested.empty () && settings_.remove_self_intersections) {
      remove (pairs);
      if (crossing_.done.hasChanged ())
        pairs = findCrossing ();
    }
    crossing_.take (pairs, mesh_.triangles, [this] (Index p) { return points_.pointAt (p); });
  }

  CheckedParts check (PartWork& work, const Parts& parts)
  {
    CheckedParts checked;
    for (const InnerCheck& inner : checks_)
      checked.crossing.add (inner.crossing);
    checked.crossing.add (crossing_);
    ExaminedParts examined = examineAll ();
    const SeamComponents components = joinComponents (points_, mesh_, seam_count_, near_, checks_);
    examined.components = components.count ();
    examined.component_points = components.points;
    examined.component_first = components.first;
    checked.mesh.triangles = examined.triangles;
    const std::vector<std::uint8_t> is_turned = turn (components, parts, work, checked);
    for (BoundaryEdge& edge : examined.around.boundary)
      if (is_turned[components.of_point[edge.first]] != 0)
        std::swap (edge.first, edge.second);
    std::sort (examined.around.boundary.begin (), examined.around.boundary.end ());
    checked.found = makeExamination (
        std::move (examined), {checked.mesh.seam, positions_, spacing_},
        [this] (Index place) { return points_.pointAt (place); }, components.of_point, cloud_);
    takeCrossing (checked);
    return checked;
  }

private:
  // Fetches positions and spacing of all its points.
  void takeValues ()
  {
    positions_.reserve (points_.size ());
    spacing_.reserve (points_.size ());
    std::size_t of_zones = 0, of_near = 0;
    for (Index place = 0; place < points_.size (); ++place) {
      const Index p = points_.pointAt (place);
      const bool is_near = of_near < near_.points.size () && near_.points[of_near] == p;
      const bool is_in_zone = of_zones < zones_.points.size () && zones_.points[of_zones] == p;
      positions_.push_back (is_in_zone ? zones_.positions[of_zones]
                                       : near_.values.positions[of_near]);
      spacing_.push_back (is_in_zone ? zones_.spacing[of_zones] : near_.values.spacing[of_near]);
      of_zones += is_in_zone ? 1 : 0;
      of_near += is_near ? 1 : 0;
    }
  }

  // All crossing pairs except those of two inner triangles of one part, which the part has
  // reported.
  CrossingPairs findCrossing () const
  {
    const std::vector<Index> order = orderByPoints (mesh_.triangles, points_.size ());
    std::vector<Triangle> sorted;
    sorted.reserve (order.size ());
    for (const Index t : order)
      sorted.push_back (mesh_.triangles[t]);
    CrossingPairs pairs =
        pairsInOrder (findSelfIntersectionsOf (sorted, 0, sorted.size (), positions_, run_), order);
    const auto isKnown = [this] (const CrossingPair& pair) {
      return pair.first >= seam_count_ &&
             near_.part[pair.first - seam_count_] == near_.part[pair.second - seam_count_];
    };
    pairs.erase (std::remove_if (pairs.begin (), pairs.end (), isKnown), pairs.end ());
    return pairs;
  }

  // Removes these crossings. Inner triangles stay.
  void remove (const std::vector<CrossingPair>& pairs)
  {
    std::vector<Eigen::Vector3f> normals (points_.size (), Eigen::Vector3f::Zero ());
    CsrLists neighbors;
    neighbors.offsets.assign (1, 0);
    std::size_t zone_point = 0;
    for (Index place = 0; place < points_.size (); ++place) {
      if (mesh_.is_partial[place] == 0) {
        normals[place] = zones_.normals[zone_point];
        for (const Index q : zones_.neighbors.row (zone_point))
          neighbors.ids.push_back (zone_places_[q]);
        ++zone_point;
      }
      neighbors.offsets.push_back (static_cast<Index> (neighbors.ids.size ()));
    }
    mesh_.is_fixed.assign (mesh_.triangles.size (), 1);
    std::fill_n (mesh_.is_fixed.begin (), seam_count_, std::uint8_t{0});
    orientNormals (mesh_, positions_, normals, run_);
    const TriangleCost cost (positions_, normals, &spacing_, settings_.cost);
    crossing_.done = removeSelfIntersections (mesh_, pairs, neighbors, cost, positions_,
                                              settings_.uncrossing, run_);
  }

  // The results around all points. The ends of boundary edges are indices.
  ExaminedParts examineAll () const
  {
    const ExaminedMesh examined{mesh_.triangles, positions_, spacing_, cloud_.diagonal,
                                &mesh_.is_partial};
    const TriangleRanges ranges (mesh_.triangles, points_.size (), run_);
    Surroundings own = lookAround (examined, ranges, settings_.check, nullptr, run_);
    for (Index* const p : {&own.broken_at, &own.degenerate_at, &own.fold_at})
      if (*p != NONE)
        *p = points_.pointAt (*p);
    const auto toPoints = [this] (std::pair<Index, Index>& edge) {
      edge = {points_.pointAt (edge.first), points_.pointAt (edge.second)};
    };
    if (points_.size () > 0)
      for (auto* const edge : {&own.longest_at, &own.longest_inside_at})
        toPoints (*edge);
    for (Index& p : own.unused)
      p = points_.pointAt (p);
    ExaminedParts all;
    all.triangles = seam_count_;
    for (const InnerCheck& check : checks_) {
      Surroundings around = check.around;
      all.around.append (std::move (around));
      all.triangles += check.triangles;
    }
    all.around.append (std::move (own));
    return all;
  }

  void takeCrossing (CheckedParts& checked) const
  {
    MeshExamination& found = checked.found;
    if (!found.isManifold ())
      return;
    found.check.self_intersections = checked.crossing.left;
    found.check.has_more_self_intersections = checked.crossing.untested > 0;
    found.crossing_at = checked.crossing.first_at;
    for (const auto& [at, other_at] : checked.crossing.places)
      found.check.self_intersections_at.push_back (
          {cloud_.cloud_index[at], cloud_.cloud_index[other_at]});
  }

  // Orients the components outwards.
  // \return of each component: 1 if it was flipped
  std::vector<std::uint8_t> turn (const SeamComponents& components, const Parts& parts,
                                  PartWork& work, CheckedParts& checked)
  {
    FacingHints hints = usableHints (settings_.facing, checked.facing);
    const std::vector<Eigen::Vector3f> normals = hints.normals != nullptr
                                                     ? valuesOf (*hints.normals, points_)
                                                     : std::vector<Eigen::Vector3f> ();
    if (hints.normals != nullptr)
      hints.normals = &normals;
    TriangleMesh seam = std::move (mesh_); // near triangles remain as neighbours only
    seam.triangles.resize (seam_count_);
    seam.neighbors.resize (seam_count_);
    MeshComponents of_seam;
    of_seam.count = static_cast<Index> (components.count ());
    for (const Triangle& corners : seam.triangles)
      of_seam.of_triangle.push_back (components.of_point[corners[0]]);
    const std::vector<FacingSums> sums =
        judgeNormals (sumUp (components, seam, of_seam, hints), settings_.facing_limits);
    AssembledMesh whole (*this, components, seam, of_seam, parts, work);
    const std::vector<std::uint8_t> is_turned = judgeFacing (
        whole, sums,
        findTogether (seam, positions_, of_seam, sums, hints, settings_.facing_limits, run_), hints,
        settings_.facing_limits, run_, checked.facing);
    for (const std::vector<Index>& of_part : components.of_inner) {
      std::vector<std::uint8_t>& of_part_turned = checked.mesh.is_turned.emplace_back ();
      for (const Index c : of_part)
        of_part_turned.push_back (is_turned[c]);
    }
    for (std::size_t t = 0; t < seam.triangles.size (); ++t) {
      if (is_turned[of_seam.of_triangle[t]] != 0)
        std::swap (seam.triangles[t][1], seam.triangles[t][2]);
      for (Index& p : seam.triangles[t])
        p = points_.pointAt (p);
    }
    checked.mesh.seam = std::move (seam.triangles);
    return is_turned;
  }

  // Sums of each component over all parts.
  std::vector<ComponentSum> sumUp (const SeamComponents& components, const TriangleMesh& seam,
                                   const MeshComponents& of_seam, const FacingHints& hints) const
  {
    std::vector<ComponentSum> sums (components.count ());
    for (std::size_t part = 0; part < checks_.size (); ++part)
      for (std::size_t c = 0; c < checks_[part].components.size (); ++c)
        sums[components.of_inner[part][c]].add (checks_[part].components[c].sum);
    std::vector<ComponentSum> own = sumTriangles (seam, positions_, of_seam, hints, run_);
    for (std::size_t c = 0; c < own.size (); ++c) {
      if (own[c].sum.at != NONE)
        own[c].sum.at = points_.pointAt (own[c].sum.at);
      sums[c].add (own[c]);
    }
    return sums;
  }

  // The whole mesh, assembled on demand.
  class AssembledMesh : public FacedMesh
  {
  public:
    AssembledMesh (const SeamChecker& checker, const SeamComponents& components,
                   const TriangleMesh& seam, const MeshComponents& of_seam, const Parts& parts,
                   PartWork& work)
        : checker_ (checker), components_ (components), seam_ (seam), of_seam_ (of_seam),
          parts_ (parts), work_ (work)
    {
    }

    const std::vector<Triangle>& triangles () override { return assembled ().triangles; }
    const std::vector<Index>& components () override { return assembled ().components; }
    const std::vector<Eigen::Vector3d>& positions () override { return checker_.cloud_.positions; }
    std::vector<BoundarySegment> boundary () override
    {
      return boundarySegments (seam_, checker_.positions_, of_seam_);
    }

  private:
    struct Assembled
    {
      std::vector<Triangle> triangles;
      std::vector<Index> components; // of each triangle
    };

    const Assembled& assembled ()
    {
      if (!assembled_)
        assembled_.emplace (assemble ());
      return *assembled_;
    }

    Assembled assemble () const
    {
      const std::vector<InnerCheck>& checks = checker_.checks_;
      std::vector<std::size_t> begins (1, 0);
      for (const InnerCheck& check : checks)
        begins.push_back (begins.back () + check.triangles);
      Assembled all;
      all.triangles.resize (begins.back () + seam_.triangles.size ());
      all.components.resize (all.triangles.size ());
      parallelTasks (checker_.run_, checks.size (), [&] (std::size_t part) {
        std::vector<Triangle> triangles = work_.triangles (part, {{0, checks[part].triangles}});
        std::copy (triangles.begin (), triangles.end (),
                   all.triangles.begin () + static_cast<std::ptrdiff_t> (begins[part]));
        const std::vector<Index> found = innerComponents (
            std::move (triangles), parts_.first (part), parts_.last (part) - parts_.first (part),
            checker_.run_.withThreads (1));
        for (std::size_t t = 0; t < found.size (); ++t)
          all.components[begins[part] + t] = components_.of_inner[part][found[t]];
      });
      for (std::size_t t = 0; t < seam_.triangles.size (); ++t) {
        const auto& [a, b, c] = seam_.triangles[t];
        all.triangles[begins.back () + t] = {checker_.points_.pointAt (a),
                                             checker_.points_.pointAt (b),
                                             checker_.points_.pointAt (c)};
        all.components[begins.back () + t] = of_seam_.of_triangle[t];
      }
      return all;
    }

    const SeamChecker& checker_;
    const SeamComponents& components_;
    const TriangleMesh& seam_;
    const MeshComponents& of_seam_;
    const Parts& parts_;
    PartWork& work_;
    std::optional<Assembled> assembled_;
  };

  const std::vector<InnerCheck>& checks_;
  const Points& cloud_;
  const PartsCheckSettings& settings_;
  const RunContext& run_;
  JoinedZones zones_;
  NearTriangles near_;
  std::size_t seam_count_;
  JoinedPoints points_;            // of zones and of near triangles
  std::vector<Index> zone_places_; // of each point of the zones
  std::vector<Eigen::Vector3d> positions_;
  std::vector<float> spacing_;
  TriangleMesh mesh_; // zone triangles, then near ones; other points are partial
  CrossingSum crossing_;
};

} // namespace

CheckedParts
checkParts (FinishedSeam seam, const std::vector<InnerCheck>& checks, const Parts& parts,
            PartWork& work, const Points& points, const PartsCheckSettings& settings,
            const RunContext& run)
{
  std::vector<Triangle> sorted;
  sorted.reserve (seam.triangles.size ());
  for (const Index t : orderByPoints (seam.triangles, seam.zones.points.size ()))
    sorted.push_back (seam.triangles[t]);
  seam.triangles = std::move (sorted);
  NearTriangles near = findNearTriangles (seam.triangles, seam.zones.positions, checks, work, run);
  SeamChecker checker (std::move (seam), std::move (near), checks, points, settings, run);
  checker.uncross ();
  return checker.check (work, parts);
}

std::vector<Triangle>
assembleTriangles (const MeshOfParts& mesh, const std::vector<InnerCheck>& checks,
                   const Parts& parts, PartWork& work, const RunContext& run)
{
  std::vector<std::size_t> begins (1, 0);
  for (const InnerCheck& check : checks)
    begins.push_back (begins.back () + check.triangles);
  std::vector<Triangle> all (mesh.triangles);
  parallelTasks (run, checks.size (), [&] (std::size_t part) {
    std::vector<Triangle> triangles = work.triangles (part, {{0, checks[part].triangles}});
    turnInner (triangles, mesh.is_turned[part], parts.first (part),
               parts.last (part) - parts.first (part), run.withThreads (1));
    std::copy (triangles.begin (), triangles.end (),
               all.begin () + static_cast<std::ptrdiff_t> (begins[part]));
  });
  std::copy (mesh.seam.begin (), mesh.seam.end (),
             all.begin () + static_cast<std::ptrdiff_t> (begins.back ()));
  return all;
}

} // namespace pcl::floater
