// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/inner_check.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl::floater {
namespace {
// Connects inner triangles. Points with missing triangles have several fans.
void
connectInner (TriangleMesh& mesh, std::size_t points, const RunContext& run)
{
  if (!mesh.connect (points, run))
    throw std::logic_error ("the inner triangles of a part are no manifold");
}

// Converts points of a part to points of the cloud.
void
countFrom (Index first, Surroundings& around)
{
  for (Index* const p : {&around.broken_at, &around.degenerate_at, &around.fold_at})
    if (*p != NONE)
      *p += first;
  for (auto* const edge : {&around.longest_at, &around.longest_inside_at})
    *edge = {edge->first + first, edge->second + first};
}

std::vector<InnerComponent>
sumUp (const TriangleMesh& mesh, const MeshComponents& found, const PartPoints& points,
       const InnerCheckSettings& settings, const RunContext& run)
{
  FacingHints hints;
  hints.sensor = settings.sensor;
  if (!points.facing_normals.empty ())
    hints.normals = &points.facing_normals;
  std::vector<InnerComponent> components;
  for (const ComponentSum& sum : sumTriangles (mesh, points.positions, found, hints, run)) {
    components.push_back ({sum, 0});
    components.back ().sum.sum.is_closed = true;
    components.back ().sum.sum.at += points.first;
  }
  for (std::size_t p = 0; p < points.size (); ++p)
    if (const Index t = mesh.triangle_of[p]; t != NONE && mesh.is_partial[p] == 0)
      ++components[found.of_triangle[t]].points;
  return components;
}

} // namespace

void
CrossingSum::add (const CrossingSum& next)
{
  found += next.found;
  left += next.left;
  untested += next.untested;
  done.flips += next.done.flips;
  done.moves += next.done.moves;
  done.rebuilds += next.done.rebuilds;
  done.pairs_left += next.done.pairs_left;
  const std::size_t more = std::min (PLACES - places.size (), next.places.size ());
  places.insert (places.end (), next.places.begin (),
                 next.places.begin () + static_cast<std::ptrdiff_t> (more));
  first_at = std::min (first_at, next.first_at);
}

InnerCheck
checkInner (const PartPoints& points, const std::vector<Triangle>& triangles,
            std::vector<std::uint8_t> is_in_zone, const InnerCheckSettings& settings,
            const RunContext& run)
{
  InnerCheck check;
  check.triangles = triangles.size ();
  TriangleMesh mesh;
  mesh.triangles = triangles;
  {
    const ExaminedMesh examined{triangles, points.positions, points.spacing, settings.diagonal,
                                &is_in_zone};
    const TriangleRanges ranges (triangles, points.size (), run);
    check.around = lookAround (examined, ranges, settings.limits, nullptr, run);
    if (!check.around.unused.empty () || !check.around.boundary.empty ())
      throw std::logic_error ("the mesh of a part ends outside of its zone");
    countFrom (points.first, check.around);
  }
  mesh.is_partial = std::move (is_in_zone);
  connectInner (mesh, points.size (), run);
  const MeshComponents found = findComponents (mesh, run);
  check.components = sumUp (mesh, found, points, settings, run);
  for (Index t = 0; t < triangles.size (); ++t) {
    const Triangle& corners = triangles[t];
    check.box.extend (boxOf (corners, points.positions));
    if (std::any_of (corners.begin (), corners.end (),
                     [&mesh] (Index p) { return mesh.is_partial[p] != 0; })) {
      check.rim.push_back (t);
      check.rim_component.push_back (found.of_triangle[t]);
    }
  }
  return check;
}

std::vector<Eigen::AlignedBox3d>
makeTriangleBuckets (const std::vector<Triangle>& triangles,
                     const std::vector<Eigen::Vector3d>& positions)
{
  std::vector<Eigen::AlignedBox3d> buckets ((triangles.size () + InnerCheck::BUCKET - 1) /
                                            InnerCheck::BUCKET);
  for (std::size_t t = 0; t < triangles.size (); ++t)
    buckets[t / InnerCheck::BUCKET].extend (boxOf (triangles[t], positions));
  return buckets;
}

std::vector<Index>
innerComponents (std::vector<Triangle> triangles, Index first, std::size_t points,
                 const RunContext& run)
{
  TriangleMesh mesh;
  mesh.triangles = std::move (triangles);
  for (Triangle& corners : mesh.triangles)
    for (Index& p : corners)
      p -= first;
  mesh.is_partial.assign (points, 1); // several fans are allowed everywhere
  connectInner (mesh, points, run);
  return findComponents (mesh, run).of_triangle;
}

void
turnInner (std::vector<Triangle>& triangles, const std::vector<std::uint8_t>& is_turned,
           Index first, std::size_t points, const RunContext& run)
{
  const auto isOne = [] (std::uint8_t one) { return one != 0; };
  if (std::none_of (is_turned.begin (), is_turned.end (), isOne))
    return;
  std::vector<Index> components;
  if (!std::all_of (is_turned.begin (), is_turned.end (), isOne))
    components = innerComponents (triangles, first, points, run);
  for (std::size_t t = 0; t < triangles.size (); ++t)
    if (components.empty () || is_turned.at (components[t]) != 0)
      std::swap (triangles[t][1], triangles[t][2]);
}

} // namespace pcl::floater
