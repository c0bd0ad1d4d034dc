// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/local_parts.h"

#include "consensus/candidates.h"
#include "core/parallel.h"
#include "local/planes.h"

#include <algorithm>
#include <atomic>
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

LocalParts::LocalParts (const Points& points, const Parts& parts, LocalGeometry& geometry,
                        const PartsSettings& settings, const RunContext& run)
    : points_ (points), parts_ (parts), geometry_ (geometry), settings_ (settings),
      meshes_ (parts.count ()),
      neighbors_ ([table = NeighborTable (geometry.neighbors)] (const std::vector<Index>& some) {
        return table.some (some);
      })
{
  run.beginStage (Stage::CONSENSUS);
  const ConsensusLimits& consensus = settings.surface.limits.consensus;
  const std::vector<std::uint8_t> reaches_out = reachesOut (geometry.stars.neighbors, 0, parts);
  std::vector<Eigen::Vector3f> smoothed =
      smoothedNormals (points.workingPositions (), geometry.neighbors, geometry.stars.normals,
                       Rows::all (points.size ()), run);
  std::vector<CandidateLists> candidates; // of each part
  for (std::size_t part = 0; part < parts.count (); ++part)
    candidates.push_back (findCandidates (
        points.workingPositions (), geometry.stars, smoothed, geometry.spacing,
        Rows::range (parts.first (part), parts.last (part)), consensus.candidates, run));
  std::vector<Eigen::Vector3f> normals = std::move (geometry.stars.normals);
  geometry.stars = {};
  geometry.stars.normals = std::move (normals);
  std::atomic<std::size_t> begun{0};
  parallelTasks (run, parts.count (), [&] (std::size_t part) {
    const Index first = parts.first (part), last = parts.last (part);
    std::vector<Eigen::Vector3f> own = slice (smoothed, first, last);
    if (++begun == parts.count ()) // no other part needs them
      std::vector<Eigen::Vector3f> ().swap (smoothed);
    meshes_[part] = makePartMesh (pointsOf (part, points.workingPositions (), geometry.spacing),
                                  std::move (own),
                                  divideCandidates (std::move (candidates[part]), first, last,
                                                    slice (reaches_out, first, last)),
                                  neighbors_, consensus, run.withThreads (1));
  });
}

PartPoints
LocalParts::pointsOf (std::size_t part, const std::vector<Eigen::Vector3d>& positions,
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
LocalParts::rim (std::size_t part, std::size_t rings)
{
  const std::vector<Eigen::Vector3d>& positions = points_.workingPositions ();
  const std::vector<Eigen::Vector3f>& normals = geometry_.stars.normals;
  return findRim (
      pointsOf (part, positions, geometry_.spacing), meshes_[part], neighbors_,
      [&] (const std::vector<Index>& others, std::vector<Eigen::Vector3d>& other_positions,
           std::vector<Eigen::Vector3f>& other_normals) {
        for (const Index p : others) {
          other_positions.push_back (positions[p]);
          other_normals.push_back (normals[p]);
        }
      },
      rings, settings_.surface.limits.consensus.smallest_island);
}

void
LocalParts::finish (std::vector<PartChange> changes, const RunContext& run)
{
  finished_.resize (parts_.count ());
  triangles_.resize (parts_.count ());
  buckets_.resize (parts_.count ());
  const PartFinishSettings settings = settings_.ofPart (parts_);
  std::atomic<std::size_t> begun{0};
  parallelTasks (run, parts_.count (), [&] (std::size_t part) {
    const Index first = parts_.first (part), last = parts_.last (part);
    PartPoints points = pointsOf (part, points_.positions, geometry_.meshSpacing ());
    if (const auto* const normals = settings_.surface.facing.normals)
      points.facing_normals = slice (*normals, first, last);
    std::vector<Triangle> triangles = std::move (meshes_[part].triangles);
    meshes_[part] = {};
    if (++begun == parts_.count ()) // no other part needs them
      std::vector<Eigen::Vector3f> ().swap (geometry_.stars.normals);
    FinishedPart finished = finishPart (std::move (points), std::move (triangles), changes[part],
                                        neighbors_, settings, run.withThreads (1));
    triangles_[part] = std::move (finished.triangles);
    buckets_[part] = std::move (finished.buckets);
    finished_[part] = std::move (finished);
    changes[part] = {};
  });
}

FinishedPart
LocalParts::finished (std::size_t part)
{
  return std::move (finished_[part]);
}

std::vector<Triangle>
LocalParts::triangles (std::size_t part, const Ranges& ranges)
{
  const auto begin = triangles_[part].begin ();
  std::vector<Triangle> some;
  for (const auto& [first, last] : ranges)
    some.insert (some.end (), begin + static_cast<std::ptrdiff_t> (first),
                 begin + static_cast<std::ptrdiff_t> (last));
  return some;
}

PointValues
LocalParts::valuesOf (const std::vector<Index>& points)
{
  PointValues values;
  for (const Index p : points) {
    values.positions.push_back (points_.positions[p]);
    values.spacing.push_back (geometry_.meshSpacing ()[p]);
  }
  return values;
}

} // namespace pcl::floater
