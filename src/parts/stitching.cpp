// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/stitching.h"

#include "consensus/consensus.h"
#include "consensus/manifold_part.h"
#include "consensus/orientation_seam.h"
#include "core/disjoint_sets.h"
#include "parts/joined_points.h"
#include "parts/mesh_region.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// A triangle of a part, by its corners, which are places.
struct Origin
{
  Triangle corners; // ascending
  Triangle turning; // as they are in the part
  Index part, number, component;
};

Triangle
ascending (Triangle corners)
{
  std::sort (corners.begin (), corners.end ());
  return corners;
}

// The rims of all parts in one mesh, whose points are places in `points`.
struct JoinedRims
{
  JoinedPoints points;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals, smoothed;
  std::vector<float> spacing;
  std::vector<std::uint8_t> is_partial, has_room;
  CsrLists neighbors;
  TriangleMesh mesh;
  std::vector<Origin> origins; // by their corners
  std::vector<Candidate> open;
  std::vector<std::array<Index, 2>> same_side; // two points of one component of a part

  Triangle toPoints (Triangle places) const
  {
    for (Index& p : places)
      p = points.pointAt (p);
    return places;
  }

  // The triangle of a part with these corners, in whatever order; nullptr if there is none.
  const Origin* find (const Triangle& corners) const
  {
    const Triangle wanted = ascending (corners);
    const auto at =
        std::lower_bound (origins.begin (), origins.end (), wanted,
                          [] (const Origin& a, const Triangle& b) { return a.corners < b; });
    return at != origins.end () && at->corners == wanted ? &*at : nullptr;
  }
};

// Points of a rim come before those that are only neighbours in another part. The latter have
// triangles that are not seen: else they would have room, and be in the rim of their part.
void
joinPoints (const std::vector<PartRim>& rims, JoinedRims& joined)
{
  for (const PartRim& rim : rims)
    joined.points.add (rim.points);
  for (const PartRim& rim : rims)
    joined.points.add (rim.others);
  joined.points.sort ();
  const std::size_t count = joined.points.size ();
  joined.positions.resize (count);
  joined.normals.resize (count);
  joined.smoothed.assign (count, Eigen::Vector3f::Zero ());
  joined.spacing.assign (count, 0.0F);
  joined.is_partial.assign (count, 1);
  joined.has_room.assign (count, 0);
  std::vector<Row> rows (count, Row{nullptr, nullptr});
  for (const PartRim& rim : rims) {
    for (std::size_t i = 0; i < rim.others.size (); ++i) {
      const Index at = joined.points.placeOf (rim.others[i]);
      joined.positions[at] = rim.other_positions[i];
      joined.normals[at] = rim.other_normals[i];
    }
    for (std::size_t i = 0; i < rim.points.size (); ++i) {
      const Index at = joined.points.placeOf (rim.points[i]);
      joined.positions[at] = rim.positions[i];
      joined.normals[at] = rim.normals[i];
      joined.smoothed[at] = rim.smoothed[i];
      joined.spacing[at] = rim.spacing[i];
      joined.is_partial[at] = rim.is_partial[i];
      joined.has_room[at] = rim.has_room[i];
      rows[at] = rim.neighbors.row (i);
    }
  }
  joined.neighbors.offsets.push_back (0);
  for (const Row& row : rows) {
    for (const Index q : row)
      joined.neighbors.ids.push_back (joined.points.placeOf (q));
    joined.neighbors.offsets.push_back (static_cast<Index> (joined.neighbors.ids.size ()));
  }
}

JoinedRims
joinRims (const std::vector<PartRim>& rims, const RunContext& run)
{
  JoinedRims joined;
  joinPoints (rims, joined);
  ProgressLoop progress (run);
  for (std::size_t part = 0; part < rims.size (); ++part) {
    const PartRim& rim = rims[part];
    std::vector<Index> last_of (rim.components, NONE); // a point of each component
    for (std::size_t t = 0; t < rim.triangles.size (); ++t) {
      progress.next ();
      Triangle corners = rim.triangles[t];
      for (Index& p : corners)
        p = joined.points.placeOf (rim.points[p]);
      const Index component = rim.component[t];
      joined.mesh.triangles.push_back (corners);
      joined.origins.push_back (
          {ascending (corners), corners, static_cast<Index> (part), rim.numbers[t], component});
      if (last_of[component] != NONE)
        joined.same_side.push_back ({last_of[component], corners[0]});
      last_of[component] = corners[0];
    }
    for (Candidate candidate : rim.open) {
      const auto hasRoom = [&] (Index& p) {
        p = joined.points.placeOf (p);
        return p != NONE && joined.has_room[p] != 0;
      };
      if (std::all_of (candidate.corners.begin (), candidate.corners.end (), hasRoom))
        joined.open.push_back (candidate);
    }
  }
  std::sort (joined.origins.begin (), joined.origins.end (),
             [] (const Origin& a, const Origin& b) { return a.corners < b.corners; });
  joined.mesh.is_partial = joined.is_partial;
  joined.mesh.connect (joined.points.size (), run);
  return joined;
}

// Components of the whole mesh, of those of what is seen of it.
MeshComponents
joinComponents (const TriangleMesh& mesh, const JoinedRims& joined, const RunContext& run)
{
  MeshComponents components = findComponents (mesh, run);
  DisjointSets sets (components.count);
  std::map<std::pair<Index, Index>, Index> seen; // of each component of a part
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (const Origin* origin = joined.find (mesh.triangles[t])) {
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

// The loops of the boundary. What is seen of the mesh ends elsewhere, too: at partial points.
// \return nothing if one is too near to where triangles are missing to be judged
std::optional<std::vector<BoundaryLoop>>
findLoops (const TriangleMesh& mesh, const MeshComponents& components, const JoinedRims& joined,
           const RunContext& run)
{
  constexpr std::size_t EDGES = 3; // how far findEvidence goes from a loop to look around a point
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

// Components of parts, as (part, component), of which not all triangles are seen.
std::set<std::pair<Index, Index>>
findPartlySeen (const JoinedRims& joined)
{
  std::set<std::pair<Index, Index>> found;
  for (const Origin& origin : joined.origins)
    if (std::any_of (origin.corners.begin (), origin.corners.end (),
                     [&joined] (Index p) { return joined.is_partial[p] != 0; }))
      found.emplace (origin.part, origin.component);
  return found;
}

// Sorts the triangles of the mesh out: which are new, which of the parts are left, and which of
// their components have been turned round.
// \param filled number of triangles at the end that fill holes, be it in the place of others
// \return false if all that was seen of a component has gone, but not all of it was seen
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
    if (const Origin* origin = is_filling ? nullptr : joined.find (corners)) {
      is_left[static_cast<std::size_t> (origin - joined.origins.data ())] = 1;
      is_turned[{origin->part, origin->component}] = corners != origin->turning;
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

} // namespace

std::optional<Stitching>
stitch (std::vector<PartRim> rims, const Parts& parts, double unit, const SurfaceSettings& settings,
        const RunContext& run)
{
  const SurfaceLimits& limits = settings.limits;
  JoinedRims joined = joinRims (rims, run);
  rims = {};
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
  stitching.holes =
      closeHoles (*mesh, std::move (*loops), components.count, joined.positions, joined.neighbors,
                  joined.normals, unit, settings.holes, limits.holeClosing (), run);
  for (JudgedLoop& judged : stitching.holes.doubtful)
    for (Index& p : judged.loop.points)
      p = joined.points.pointAt (p);
  if (!findChanges (*mesh, mesh->triangles.size () - unfilled, joined, parts, stitching))
    return {};
  return stitching;
}

} // namespace floater
} // namespace pcl
