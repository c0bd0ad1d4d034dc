// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/near_triangles.h"

#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/box_tree.h"

#include <algorithm>
#include <utility>

namespace pcl::floater {
// Each ring is a pass over all triangles, since a point may have several fans.
MeshRegion
regionAround (const std::vector<Triangle>& triangles, std::size_t points,
              const std::vector<Index>& seeds, std::size_t rings,
              const std::vector<std::uint8_t>& besides)
{
  std::vector<std::uint8_t> is_in = besides;
  is_in.resize (triangles.size (), 0);
  std::vector<Index> ring_of (points, NONE);
  for (const Index p : seeds)
    ring_of[p] = 0;
  bool has_grown = true;
  for (Index ring = 0; ring < rings && has_grown; ++ring) {
    has_grown = false;
    for (std::size_t t = 0; t < triangles.size (); ++t) {
      const Triangle& corners = triangles[t];
      if (std::none_of (corners.begin (), corners.end (),
                        [&] (Index p) { return ring_of[p] <= ring; }))
        continue;
      is_in[t] = 1;
      for (const Index p : corners)
        if (ring_of[p] == NONE) {
          ring_of[p] = ring + 1;
          has_grown = true;
        }
    }
  }
  constexpr std::uint8_t CORNER = 1, PARTIAL = 2;
  std::vector<std::uint8_t> marks (points, 0);
  for (const Index p : seeds)
    marks[p] = CORNER;
  MeshRegion region;
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    if (is_in[t] != 0)
      region.triangles.push_back (static_cast<Index> (t));
    for (const Index p : triangles[t])
      marks[p] = static_cast<std::uint8_t> (marks[p] | (is_in[t] != 0 ? CORNER : PARTIAL));
  }
  for (Index p = 0; p < points; ++p)
    if ((marks[p] & CORNER) != 0) {
      region.points.push_back (p);
      region.is_partial.push_back ((marks[p] & PARTIAL) != 0 ? 1 : 0);
    }
  return region;
}

namespace {
// A bucket in the box of another part.
struct SharedBucket
{
  Index part;
  Index number;
  Eigen::AlignedBox3d box;
};

// Buckets of one part that are needed, and that may be.
struct PartBuckets
{
  std::vector<Index> needed;
  std::vector<SharedBucket> shared;
};

// The corners of triangles of one part, numbered ascending. O(points of the part): faster than
// sorting, as they are near each other.
class PartCorners
{
public:
  explicit PartCorners (const std::vector<Triangle>& triangles)
  {
    Index last = 0;
    for (const Triangle& corners : triangles)
      for (const Index p : corners) {
        first_ = std::min (first_, p);
        last = std::max (last, p);
      }
    if (triangles.empty ())
      return;
    places_.assign (std::size_t{last} - first_ + 1, NONE);
    for (const Triangle& corners : triangles)
      for (const Index p : corners)
        places_[p - first_] = 0;
    for (std::size_t i = 0; i < places_.size (); ++i)
      if (places_[i] != NONE) {
        places_[i] = static_cast<Index> (points_.size ());
        points_.push_back (first_ + static_cast<Index> (i));
      }
  }

  const std::vector<Index>& points () const { return points_; }
  Index placeOf (Index corner) const { return places_[corner - first_]; }

private:
  Index first_ = NONE;
  std::vector<Index> places_, points_;
};

class NearFinder
{
public:
  NearFinder (const std::vector<Triangle>& seam, const std::vector<Eigen::Vector3d>& seam_positions,
              const std::vector<InnerCheck>& checks, PartWork& work, const RunContext& run)
      : checks_ (checks), work_ (work), run_ (run),
        seam_ (
            seam.size (), [&] (std::size_t t) { return boxOf (seam[t], seam_positions); }, run),
        parts_ (
            checks.size (), [&] (std::size_t p) { return checks[p].box; }, run),
        needed_ (checks.size ()), crossed_ (checks.size ())
  {
  }

  NearTriangles find ()
  {
    chooseBuckets ();
    std::vector<NearTriangles> found (checks_.size ());
    parallelTasks (run_, found.size (),
                   [&] (std::size_t part) { found[part] = read (static_cast<Index> (part)); });
    std::size_t triangles = 0, points = 0;
    for (const NearTriangles& one : found) {
      triangles += one.triangles.size ();
      points += one.points.size ();
    }
    NearTriangles all;
    all.reserve (triangles, points);
    for (NearTriangles& one : found)
      all.add (std::exchange (one, {}));
    return all;
  }

private:
  void chooseBuckets ()
  {
    std::vector<PartBuckets> looked_at (checks_.size ());
    parallelTasks (run_, checks_.size (), [&] (std::size_t part) {
      looked_at[part] = lookAt (static_cast<Index> (part));
    });
    std::vector<SharedBucket> shared;
    for (std::size_t part = 0; part < looked_at.size (); ++part) {
      needed_[part] = std::move (looked_at[part].needed);
      shared.insert (shared.end (), looked_at[part].shared.begin (), looked_at[part].shared.end ());
    }
    const BoxTree tree (
        shared.size (), [&] (std::size_t i) { return shared[i].box; }, run_);
    tree.forOverlaps (0, tree.leaves (), [&] (std::size_t i, std::size_t j) {
      if (shared[i].part == shared[j].part)
        return;
      for (const std::size_t k : {i, j}) {
        needed_[shared[k].part].push_back (shared[k].number);
        crossed_[shared[k].part].push_back (shared[k].number);
      }
    });
    for (auto* const list : {&needed_, &crossed_})
      for (std::vector<Index>& numbers : *list)
        sortUnique (numbers);
  }

  bool isBesideSeam (const Eigen::AlignedBox3d& box) const
  {
    bool is_beside = false;
    seam_.forOverlaps (box, [&is_beside] (std::size_t) { is_beside = true; });
    return is_beside;
  }

  PartBuckets lookAt (Index part)
  {
    PartBuckets found;
    for (const Index t : checks_[part].rim)
      if (const auto bucket = static_cast<Index> (t / InnerCheck::BUCKET);
          found.needed.empty () || found.needed.back () != bucket)
        found.needed.push_back (bucket);
    const std::vector<Eigen::AlignedBox3d> buckets = work_.buckets (part);
    for (Index b = 0; b < buckets.size (); ++b) {
      if (isBesideSeam (buckets[b]))
        found.needed.push_back (b);
      bool is_shared = false;
      parts_.forOverlaps (buckets[b], [&] (std::size_t p) { is_shared = is_shared || p != part; });
      if (is_shared)
        found.shared.push_back ({part, b, buckets[b]});
    }
    return found;
  }

  // Reads the needed buckets, and selects triangles.
  NearTriangles read (Index part)
  {
    PartWork::Ranges ranges;
    const std::vector<Index>& numbers = needed_[part];
    const std::size_t count = checks_[part].triangles;
    for (std::size_t begin = 0, end = 0; begin < numbers.size (); begin = end) {
      for (end = begin + 1; end < numbers.size () && numbers[end] == numbers[end - 1] + 1;)
        ++end;
      ranges.emplace_back (
          numbers[begin] * InnerCheck::BUCKET,
          std::min (count, (numbers[end - 1] + std::size_t{1}) * InnerCheck::BUCKET));
    }
    return ranges.empty () ? NearTriangles{}
                           : choose (part, ranges, work_.triangles (part, ranges));
  }

  NearTriangles choose (Index part, const PartWork::Ranges& ranges,
                        const std::vector<Triangle>& triangles)
  {
    const PartCorners corners_of_all (triangles);
    const PointValues values = work_.valuesOf (corners_of_all.points ());
    const auto boxAround = [&] (const Triangle& corners) {
      Eigen::AlignedBox3d box;
      for (const Index p : corners)
        box.extend (values.positions[corners_of_all.placeOf (p)]);
      return box;
    };
    const InnerCheck& check = checks_[part];
    NearTriangles found;
    auto triangle = triangles.begin ();
    auto rim = check.rim.begin ();
    for (const auto& [first, last] : ranges)
      for (std::size_t t = first; t < last; ++t, ++triangle) {
        while (rim != check.rim.end () && *rim < t)
          ++rim;
        const bool is_at_zone = rim != check.rim.end () && *rim == t;
        if (!is_at_zone &&
            !std::binary_search (crossed_[part].begin (), crossed_[part].end (),
                                 t / InnerCheck::BUCKET) &&
            !isBesideSeam (boxAround (*triangle)))
          continue;
        found.triangles.push_back (*triangle);
        found.component.push_back (
            is_at_zone ? check.rim_component[static_cast<std::size_t> (rim - check.rim.begin ())]
                       : NONE);
      }
    found.part.assign (found.triangles.size (), part);
    found.points = PartCorners (found.triangles).points ();
    for (const Index p : found.points) {
      found.values.positions.push_back (values.positions[corners_of_all.placeOf (p)]);
      found.values.spacing.push_back (values.spacing[corners_of_all.placeOf (p)]);
    }
    return found;
  }

  const std::vector<InnerCheck>& checks_;
  PartWork& work_;
  const RunContext& run_;
  BoxTree seam_, parts_;
  std::vector<std::vector<Index>> needed_;  // buckets of each part
  std::vector<std::vector<Index>> crossed_; // of each part: buckets that overlap one of another
                                            // part
};

} // namespace

void
NearTriangles::reserve (std::size_t triangle_count, std::size_t point_count)
{
  triangles.reserve (triangle_count);
  part.reserve (triangle_count);
  component.reserve (triangle_count);
  points.reserve (point_count);
  values.positions.reserve (point_count);
  values.spacing.reserve (point_count);
}

void
NearTriangles::add (const NearTriangles& next)
{
  const auto append = [] (const auto& some, auto& all) {
    all.insert (all.end (), some.begin (), some.end ());
  };
  append (next.triangles, triangles);
  append (next.part, part);
  append (next.component, component);
  append (next.points, points);
  append (next.values.positions, values.positions);
  append (next.values.spacing, values.spacing);
}

NearTriangles
findNearTriangles (const std::vector<Triangle>& seam,
                   const std::vector<Eigen::Vector3d>& seam_positions,
                   const std::vector<InnerCheck>& checks, PartWork& work, const RunContext& run)
{
  return NearFinder (seam, seam_positions, checks, work, run).find ();
}

} // namespace pcl::floater
