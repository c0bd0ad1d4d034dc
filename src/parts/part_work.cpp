// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/part_work.h"

#include "consensus/candidates.h"
#include "core/parallel.h"
#include "local/planes.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

namespace pcl::floater {
namespace {
template <typename Value>
std::vector<Value>
slice (const std::vector<Value>& values, Index first, Index last)
{
  return {values.begin () + first, values.begin () + last};
}

} // namespace

PartSource
sourceOf (const Points& points, const Parts& parts, LocalGeometry& geometry,
          const CandidateLimits& limits, const RunContext& run)
{
  struct Proposed
  {
    std::vector<std::uint8_t> reaches_out;
    std::vector<Eigen::Vector3f> smoothed;
    std::vector<CandidateLists> candidates; // of each part
    std::atomic<std::size_t> begun{0};
  };
  const auto all = std::make_shared<Proposed> ();
  all->reaches_out = reachesOut (geometry.stars.neighbors, 0, parts);
  all->smoothed = smoothedNormals (points.workingPositions (), geometry.neighbors,
                                   geometry.stars.normals, Rows::all (points.size ()), run);
  for (std::size_t part = 0; part < parts.count (); ++part)
    all->candidates.push_back (
        findCandidates (points.workingPositions (), geometry.stars, all->smoothed, geometry.spacing,
                        Rows::range (parts.first (part), parts.last (part)), limits, run));
  std::vector<Eigen::Vector3f> normals = std::move (geometry.stars.normals);
  geometry.stars = {};
  geometry.stars.normals = std::move (normals);
  const auto propose = [all, &parts] (std::size_t part) {
    const Index first = parts.first (part), last = parts.last (part);
    ProposedPart proposed;
    proposed.smoothed = slice (all->smoothed, first, last);
    proposed.candidates = divideCandidates (std::move (all->candidates[part]), first, last,
                                            slice (all->reaches_out, first, last));
    if (++all->begun == parts.count ()) // no other part needs them
      std::vector<Eigen::Vector3f> ().swap (all->smoothed);
    return proposed;
  };
  return {propose, [&geometry] () -> NeighborRows {
            return [table = NeighborTable (geometry.neighbors)] (const std::vector<Index>& some) {
              return table.some (some);
            };
          }};
}

PartWork::PartWork (const Points& points, const Parts& parts, LocalGeometry& geometry,
                    PartSource source, const ConsensusLimits& limits, const RunContext& run)
    : points_ (points), parts_ (parts), geometry_ (geometry), source_ (std::move (source)),
      smallest_island_ (limits.smallest_island), meshes_ (parts.count ())
{
  parallelTasks (run, parts.count (), [&] (std::size_t part) {
    ProposedPart proposed = source_.propose (part);
    meshes_[part] = makePartMesh (pointsOf (part, points.workingPositions (), geometry.spacing),
                                  std::move (proposed.smoothed), std::move (proposed.candidates),
                                  source_.neighbors (), limits, run.withThreads (1));
  });
}

PartPoints
PartWork::pointsOf (std::size_t part, const std::vector<Eigen::Vector3d>& positions,
                    const std::vector<float>& spacing) const
{
  const Index first = parts_.first (part), last = parts_.last (part);
  return {first,
          slice (positions, first, last),
          slice (geometry_.stars.normals, first, last),
          slice (spacing, first, last),
          {}};
}

PartRim
PartWork::rim (std::size_t part, std::size_t rings) const
{
  const std::vector<Eigen::Vector3d>& positions = points_.workingPositions ();
  const std::vector<Eigen::Vector3f>& normals = geometry_.stars.normals;
  return findRim (
      pointsOf (part, positions, geometry_.spacing), meshes_[part], source_.neighbors (),
      [&] (const std::vector<Index>& others, std::vector<Eigen::Vector3d>& other_positions,
           std::vector<Eigen::Vector3f>& other_normals) {
        for (const Index p : others) {
          other_positions.push_back (positions[p]);
          other_normals.push_back (normals[p]);
        }
      },
      rings, smallest_island_);
}

void
PartWork::finish (std::vector<PartChange> changes, const PartFinishSettings& settings,
                  const std::vector<Eigen::Vector3f>* facing_normals, const RunContext& run)
{
  finished_.resize (parts_.count ());
  triangles_.resize (parts_.count ());
  buckets_.resize (parts_.count ());
  std::atomic<std::size_t> begun{0};
  parallelTasks (run, parts_.count (), [&] (std::size_t part) {
    const Index first = parts_.first (part), last = parts_.last (part);
    PartPoints points = pointsOf (part, points_.positions, geometry_.meshSpacing ());
    if (facing_normals != nullptr)
      points.facing_normals = slice (*facing_normals, first, last);
    std::vector<Triangle> triangles = std::move (meshes_[part].triangles);
    meshes_[part] = {};
    if (++begun == parts_.count ()) // no other part needs them
      std::vector<Eigen::Vector3f> ().swap (geometry_.stars.normals);
    FinishedPart finished = finishPart (std::move (points), std::move (triangles), changes[part],
                                        source_.neighbors (), settings, run.withThreads (1));
    triangles_[part] = std::move (finished.triangles);
    buckets_[part] = std::move (finished.buckets);
    finished_[part] = std::move (finished);
    changes[part] = {};
  });
}

std::vector<Triangle>
PartWork::triangles (std::size_t part, const Ranges& ranges) const
{
  const auto begin = triangles_[part].begin ();
  std::vector<Triangle> some;
  for (const auto& [first, last] : ranges)
    some.insert (some.end (), begin + static_cast<std::ptrdiff_t> (first),
                 begin + static_cast<std::ptrdiff_t> (last));
  return some;
}

PointValues
PartWork::valuesOf (const std::vector<Index>& points) const
{
  PointValues values;
  for (const Index p : points) {
    values.positions.push_back (points_.positions[p]);
    values.spacing.push_back (geometry_.meshSpacing ()[p]);
  }
  return values;
}

} // namespace pcl::floater
