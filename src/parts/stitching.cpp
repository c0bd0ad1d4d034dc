// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/stitching.h"

#include "consensus/consensus.h"
#include "consensus/manifold_part.h"
#include "consensus/orientation.h"
#include "core/disjoint_sets.h"
#include "core/order_statistics.h"
#include "parts/near_triangles.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace pcl::floater {
namespace {
// Components of the whole mesh, by the components of the rims.
MeshComponents
joinComponents (const TriangleMesh& mesh, const JoinedRims& joined, const RunContext& run)
{
  MeshComponents components = findComponents (mesh, run);
  DisjointSets sets (components.count);
  std::map<std::pair<Index, Index>, Index> seen; // of each component of a part
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (const RimTriangle* origin = joined.find (mesh.triangles[t])) {
      const auto known =
          seen.emplace (std::make_pair (origin->part, origin->component), components.of_triangle[t])
              .first;
      sets.join (known->second, components.of_triangle[t]);
    }
  std::vector<Index> number (components.count, NONE);
  Index count = 0;
  for (Index c = 0; c < components.count; ++c)
    number[c] = sets.find (c) == c ? count++ : number[sets.find (c)];
  for (Index& c : components.of_triangle)
    c = number[c];
  components.count = count;
  return components;
}

// The boundary loops. The rims also end at partial points.
// \return nothing if one is too near to missing triangles to be judged
std::optional<std::vector<BoundaryLoop>>
findLoops (const TriangleMesh& mesh, const MeshComponents& components, const JoinedRims& joined,
           const RunContext& run)
{
  // Rings removed by widenHoles, then the neighbourhood of a loop in findEvidence, in edges.
  constexpr std::size_t EDGES = 6;
  std::vector<BoundaryLoop> loops;
  std::vector<Index> ends;
  for (BoundaryLoop& loop :
       findBoundaryLoops (mesh, components, joined.positions, joined.spacing, run)) {
    if (mesh.isPartial (loop.points.front ()))
      continue;
    ends.insert (ends.end (), loop.points.begin (), loop.points.end ());
    loops.push_back (std::move (loop));
  }
  const MeshRegion around = regionAround (mesh.triangles, mesh.triangle_of.size (), ends, EDGES);
  const bool are_seen = std::none_of (around.points.begin (), around.points.end (),
                                      [&mesh] (Index p) { return mesh.isPartial (p); }) &&
                        std::none_of (ends.begin (), ends.end (), [&joined] (Index p) {
                          return joined.neighbors.row (p).size () == 0;
                        });
  return are_seen ? std::move (loops) : std::optional<std::vector<BoundaryLoop>> ();
}

// Components of parts, as (part, component), with triangles outside the rim.
std::set<std::pair<Index, Index>>
findPartlySeen (const JoinedRims& joined)
{
  std::set<std::pair<Index, Index>> found;
  for (const RimTriangle& origin : joined.origins)
    if (std::any_of (origin.ascending.begin (), origin.ascending.end (),
                     [&joined] (Index p) { return joined.is_partial[p] != 0; }))
      found.emplace (origin.part, origin.component);
  return found;
}

// Classifies the triangles of the mesh: new ones, remaining ones of the parts, and flipped
// components.
// \param filled number of triangles at the end that fill holes, some equal to removed ones
// \return false if all triangles of a component in its rim are gone, but not all were in the rim
bool
findChanges (const TriangleMesh& mesh, std::size_t filled, const JoinedRims& joined,
             const Parts& parts, Stitching& stitching)
{
  std::vector<std::uint8_t> is_left (joined.origins.size (), 0);
  std::map<std::pair<Index, Index>, bool> is_turned; // of each component of a part
  stitching.parts.resize (parts.count ());
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    const Triangle& corners = mesh.triangles[t];
    const bool is_filling = t + filled >= mesh.triangles.size ();
    if (const RimTriangle* origin = is_filling ? nullptr : joined.find (corners)) {
      is_left[static_cast<std::size_t> (origin - joined.origins.data ())] = 1;
      is_turned[{origin->part, origin->component}] = corners != origin->corners;
      continue;
    }
    const Triangle points = joined.toPoints (corners);
    std::array<std::size_t, 3> of{};
    std::transform (points.begin (), points.end (), of.begin (),
                    [&parts] (Index p) { return parts.partOf (p); });
    if (of[0] == of[1] && of[0] == of[2]) {
      stitching.parts[of[0]].added.push_back (points);
      continue;
    }
    stitching.seam.push_back (points);
    for (const std::size_t part : std::set<std::size_t> (of.begin (), of.end ()))
      stitching.parts[part].seam.push_back (points);
  }
  for (std::size_t i = 0; i < is_left.size (); ++i)
    if (is_left[i] == 0)
      stitching.parts[joined.origins[i].part].dropped.push_back (joined.origins[i].number);
  for (PartChange& change : stitching.parts)
    std::sort (change.dropped.begin (), change.dropped.end ());
  for (const auto& [component, is] : is_turned)
    if (is)
      stitching.parts[component.first].turned.push_back (component.second);
  const std::set<std::pair<Index, Index>> partly_seen = findPartlySeen (joined);
  return std::all_of (partly_seen.begin (), partly_seen.end (),
                      [&] (const auto& component) { return is_turned.count (component) > 0; });
}

// Points of a part that are neighbours of points without a triangle in other parts, to be inserted
// beside them.
void
findBeside (const TriangleMesh& mesh, const JoinedRims& joined, const Parts& parts,
            Stitching& stitching)
{
  for (Index p = 0; p < mesh.triangle_of.size (); ++p) {
    if (mesh.triangle_of[p] != NONE || mesh.isPartial (p))
      continue;
    const std::size_t own = parts.partOf (joined.points.pointAt (p));
    for (const Index place : joined.neighbors.row (p)) {
      const Index q = joined.points.pointAt (place);
      if (const std::size_t part = parts.partOf (q); part != own)
        stitching.parts[part].beside.push_back (q);
    }
  }
  for (PartChange& change : stitching.parts)
    sortUnique (change.beside);
}

} // namespace

std::optional<Stitching>
stitch (JoinedRims joined, const Parts& parts, double unit, const SurfaceSettings& settings,
        const RunContext& run)
{
  const SurfaceLimits& limits = settings.limits;
  Consensus consensus = extendConsensus (joined.positions, std::move (joined.open), joined.mesh,
                                         joined.same_side, joined.smoothed, run);
  Stitching stitching;
  stitching.orientation_seam = findOrientationSeam (consensus.seam, limits.consensus.shortest_seam);
  for (Triangle& corners : stitching.orientation_seam)
    corners = joined.toPoints (corners);
  std::optional<TriangleMesh> mesh = manifoldPart (
      std::move (consensus), joined.points.size (),
      [&] (Index p) { return joined.neighbors.row (p); }, limits.consensus.smallest_island,
      joined.is_partial, run);
  if (!mesh)
    return {};
  run.beginStage (Stage::HOLES);
  const MeshComponents components = joinComponents (*mesh, joined, run);
  std::optional<std::vector<BoundaryLoop>> loops = findLoops (*mesh, components, joined, run);
  if (!loops)
    return {};
  for (std::size_t p = 0; p < joined.normals.size (); ++p)
    if (joined.normals[p].dot (joined.smoothed[p]) < 0.0F)
      joined.normals[p] = -joined.normals[p];
  const std::size_t unfilled = mesh->triangles.size ();
  stitching.holes = closeHoles (*mesh, std::move (*loops), components.count, joined.positions,
                                joined.spacing, joined.neighbors, joined.normals, unit,
                                settings.holes, limits.holeClosing (), run);
  for (JudgedLoop& judged : stitching.holes.doubtful)
    for (Index& p : judged.loop.points)
      p = joined.points.pointAt (p);
  if (!findChanges (*mesh, mesh->triangles.size () - unfilled, joined, parts, stitching))
    return {};
  findBeside (*mesh, joined, parts, stitching);
  return stitching;
}

} // namespace pcl::floater
