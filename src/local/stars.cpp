// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/stars.h"

#include "core/parallel.h"
#include "local/planar_star.h"

namespace pcl::floater {
namespace {
enum class Tier
{
  EITHER_PLANE,
  BOTH_PLANES,
  ALL
};

// Makes the star of one point; scratch is reused from point to point.
struct StarMaker
{
  struct Star
  {
    std::vector<PlanarNeighbor> candidates; // input of the triangulation
    std::vector<PlanarNeighbor> neighbors;
  };

  const Positions& positions;
  const CsrLists& neighbors;
  const Normals& normals;
  const StarSettings& settings;
  const LocalPlanes* beyond;
  std::optional<StarReach> reach = // has added the far neighbours of the last star
      beyond != nullptr ? std::optional (StarReach{positions, *beyond}) : std::nullopt;
  Star star = {}; // the last one
  Star wider = {};
  PlanarStar planar_star = {};

  /// Makes the star of p; sets `normal` to the normal of its plane. Returns true if the star is
  /// open.
  bool make (Index p, Vector3f& normal)
  {
    bool open = makeOfNeighbors (p, normal);
    if (reach)
      open = reach->extend (p, TangentFrame (normal.cast<double> ()), open, star.candidates,
                            star.neighbors);
    return open;
  }

  /// Makes the star of p with known far neighbours.
  bool make (Index p, const std::vector<Index>& far, Vector3f& normal)
  {
    const bool open = makeOfNeighbors (p, normal);
    if (far.empty ())
      return open;
    const TangentFrame frame (normal.cast<double> ());
    for (const Index q : far)
      addCandidate (p, q, frame, star.candidates);
    star.neighbors = star.candidates;
    return planar_star.make (star.neighbors);
  }

private:
  bool makeOfNeighbors (Index p, Vector3f& normal)
  {
    normal = normals[p];
    const TangentFrame frame (normal.cast<double> ());
    if (!settings.filter_sheets)
      return select (p, frame, Tier::ALL, star);
    if (!select (p, frame, Tier::EITHER_PLANE, star))
      return false;
    const Vector3d mean = meanNormal (positions, neighbors, normals, p);
    if (!select (p, TangentFrame (mean), Tier::EITHER_PLANE, wider)) {
      std::swap (star, wider);
      normal = mean.cast<float> ();
      return false;
    }
    for (const Tier tier : {Tier::BOTH_PLANES, Tier::ALL})
      if (!select (p, frame, tier, wider)) {
        std::swap (star, wider);
        return false;
      }
    return true; // the star of tier 1, which has the fewest points of other sheets
  }

  bool leavesPlanes (const Vector3d& normal, Index q, const Vector3d& offset) const
  {
    const double limit = SheetLimits{}.plane_sine * offset.norm ();
    return std::abs (normal.dot (offset)) > limit &&
           std::abs (normals[q].cast<double> ().dot (offset)) > limit;
  }

  // Unrolled into the plane: the direction of the projection, the length in space.
  void addCandidate (Index p, Index q, const TangentFrame& frame,
                     std::vector<PlanarNeighbor>& candidates) const
  {
    constexpr double UPRIGHT = 1e-6;
    const Vector3d offset = positions[q] - positions[p];
    const Vector2d projected = frame.project (offset);
    const double planar_length = projected.norm (), length = offset.norm ();
    if (planar_length > UPRIGHT * length)
      candidates.push_back ({projected * (length / planar_length), q});
  }

  bool select (Index p, const TangentFrame& frame, Tier tier, Star& made)
  {
    made.candidates.clear ();
    for (const Index q : neighbors.row (p)) {
      const Vector3d offset = positions[q] - positions[p];
      if (tier == Tier::ALL || (tier == Tier::EITHER_PLANE
                                    ? onSameSheet (frame.normal, normals[q].cast<double> (), offset)
                                    : !leavesPlanes (frame.normal, q, offset)))
        addCandidate (p, q, frame, made.candidates);
    }
    made.neighbors = made.candidates;
    return settings.with_all ? planar_star.order (made.neighbors)
                             : planar_star.make (made.neighbors);
  }
};

// Reach of a star in its plane to opposite sides: the maximum over its neighbours of the smaller
// of two lengths: to the neighbour, and from the centre backwards to the border of the star. It is
// the edge length on an even sampling, the line distance between scan lines, and the edge length
// on the side of the surface beside a hole. O(m^2) for m neighbours.
// \param open see PlanarStar::make
// \return 0 if the star has nothing opposite to any neighbour
double
reachOf (const std::vector<PlanarNeighbor>& star, bool open)
{
  double reach = 0.0;
  const std::size_t count = star.size ();
  const std::size_t sectors = open ? std::max<std::size_t> (1, count) - 1 : count;
  for (const PlanarNeighbor& neighbor : star) {
    const double length = neighbor.offset.norm ();
    const Vector2d back = -neighbor.offset / length;
    for (std::size_t i = 0; i < sectors && length > reach; ++i) {
      const Vector2d& a = star[i].offset;
      const Vector2d& b = star[i + 1 == count ? 0 : i + 1].offset;
      if (cross (a, back) < 0.0 || cross (back, b) < 0.0 || cross (a, b) <= 0.0)
        continue;
      reach = std::max (reach, std::min (length, cross (a, b) / cross (back, b - a)));
      break;
    }
  }
  return reach;
}

} // namespace

Vector3d
meanNormal (const Positions& positions, const CsrLists& neighbors, const Normals& normals, Index p)
{
  constexpr std::size_t FIRST_RING = 8; // neighbours in the mean: the first ring
  constexpr double PERPENDICULAR = 0.1; // cosine below which its sign is unreliable
  const Vector3d normal = normals[p].cast<double> ();
  Vector3d sum = normal;
  const Row row = neighbors.row (p);
  for (std::size_t i = 0; i < std::min (FIRST_RING, row.size ()); ++i) {
    const Vector3d other = normals[row[i]].cast<double> ();
    double same = normal.dot (other);
    if (std::abs (same) < PERPENDICULAR) {
      // Two faces at a right angle: either both bend towards the other's normal, or both away.
      const Vector3d step = positions[row[i]] - positions[p];
      same = -step.dot (normal) * step.dot (other);
    }
    sum += same < 0.0 ? Vector3d (-other) : other;
  }
  const double length = sum.norm ();
  return length > 0.0 ? Vector3d (sum / length) : normal;
}

Stars
makeStars (const Positions& positions, const CsrLists& neighbors, const Normals& normals,
           const Rows& rows, const StarSettings& settings, const RunContext& run,
           const LocalPlanes* beyond)
{
  const std::size_t n = positions.size ();
  Stars stars;
  stars.open.resize (n);
  stars.normals.resize (n);
  stars.reach.resize (beyond != nullptr ? n : 0);
  RangeRows made (rows.size (), n), far (rows.size (), n);
  RangeLists<Vector2d> offsets (rows.size ());
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    StarMaker maker{positions, neighbors, normals, settings, beyond};
    for (std::size_t row = first; row < last; ++row) {
      const Index p = rows[row];
      stars.open[p] = maker.make (p, stars.normals[p]) ? 1 : 0;
      for (const PlanarNeighbor& neighbor : maker.star.neighbors) {
        made.add (first, p, neighbor.point);
        if (settings.with_offsets)
          offsets.of (first).push_back (neighbor.offset);
      }
      if (beyond == nullptr)
        continue;
      stars.reach[p] =
          std::max (beyond->beside_reach[p],
                    static_cast<float> (reachOf (maker.star.neighbors, stars.open[p] != 0)));
      for (const Index q : maker.reach->added)
        far.add (first, p, q);
    }
  });
  stars.neighbors = made.join ();
  stars.far_neighbors = far.join ();
  stars.offsets_in_plane = offsets.join ();
  return stars;
}

void
finishStars (const Positions& positions, const LocalPlanes& planes, const StarSettings& settings,
             const RunContext& run, Stars& stars)
{
  // An edge longer than this, in the larger reach of its ends, crosses a hole. Measured on Delaunay
  // triangulations: 999 of 1000 edges are below 1.7 on jittered grids, Poisson disks, scan lines
  // and steps of density of 5 to 30; below 2.3 on uniformly random points.
  constexpr double GAP_RATIO = 1.8;
  const std::size_t n = positions.size ();
  // Maximum over the nearest neighbours as well: in a noisy row of points, some stars are narrow.
  constexpr std::size_t NEAREST = 6;
  const std::vector<float> own_reach = stars.reach;
  parallelPoints (run, n, [&] (Index p) {
    for (const Index q : planes.neighbors.first (p, NEAREST))
      stars.reach[p] = std::max (stars.reach[p], own_reach[q]);
  });
  if (stars.far_neighbors.ids.empty ())
    return;
  RangeRows made (n, n), far (n, n);
  parallelRanges (run, n, [&] (std::size_t first, std::size_t last) {
    StarMaker maker{positions, planes.neighbors, planes.normals, settings, nullptr};
    std::vector<Index> near; // of the far neighbours
    for (auto p = static_cast<Index> (first); p < last; ++p) {
      const Row all_far = stars.far_neighbors.row (p);
      near.clear ();
      std::copy_if (all_far.begin (), all_far.end (), std::back_inserter (near), [&] (Index q) {
        const auto reach = static_cast<double> (std::max (stars.reach[p], stars.reach[q]));
        return (positions[q] - positions[p]).norm () <= GAP_RATIO * reach;
      });
      for (const Index q : near)
        far.add (first, p, q);
      if (near.size () == all_far.size ()) {
        for (const Index q : stars.neighbors.row (p))
          made.add (first, p, q);
        continue;
      }
      stars.open[p] = maker.make (p, near, stars.normals[p]) ? 1 : 0;
      for (const PlanarNeighbor& neighbor : maker.star.neighbors)
        made.add (first, p, neighbor.point);
    }
  });
  stars.neighbors = {};
  stars.far_neighbors = {};
  stars.neighbors = made.join ();
  stars.far_neighbors = far.join ();
}

std::vector<float>
starAgreement (const Stars& stars, const RunContext& run)
{
  std::vector<float> agreement (stars.open.size (), 0.0F);
  parallelPoints (run, agreement.size (), [&] (Index p) {
    const Row row = stars.neighbors.row (p);
    std::size_t mutual = 0;
    for (const Index q : row) {
      const Row other = stars.neighbors.row (q);
      mutual += std::find (other.begin (), other.end (), p) != other.end () ? 1 : 0;
    }
    if (row.size () > 0)
      agreement[p] = static_cast<float> (mutual) / static_cast<float> (row.size ());
  });
  return agreement;
}

} // namespace pcl::floater
