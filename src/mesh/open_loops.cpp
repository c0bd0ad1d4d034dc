// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/open_loops.h"

#include "core/geometry.h"
#include "core/tangent_frame.h"
#include "local/planar_star.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace pcl
{
namespace floater
{
namespace
{
// True if the automatic policy takes a loop for the end of the surface.
bool
isBoundary (const BoundaryLoop& loop, const LoopEvidence& evidence, std::size_t component_points,
            const OpenLoopLimits& limits)
{
  const auto count = static_cast<double> (loop.points.size ());
  const double steps = loop.width * count / loop.length;
  const double roots = count / std::sqrt (static_cast<double> (component_points));
  return (evidence.open_share >= limits.open_share &&
          (steps >= limits.wide_steps || roots >= limits.whole_roots)) ||
         (evidence.open_share >= limits.all_open_share && steps >= limits.small_steps) ||
         (evidence.open_share >= limits.half_open_share && roots >= limits.long_roots);
}

// Tells whether a point has a large sector without neighbours: of those on its own sheet, or of
// all.
class SectorTest
{
public:
  SectorTest (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const std::vector<Eigen::Vector3f>& normals, const OpenLoopLimits& limits)
      : positions_ (positions), neighbors_ (neighbors), normals_ (normals), limits_ (limits)
  {
  }

  bool hasEmptySector (Index p, bool same_sheet)
  {
    const Eigen::Vector3d normal = normals_[p].cast<double> ();
    const TangentFrame frame (normal);
    planar_.clear ();
    for (Index q : neighbors_.row (p)) {
      const Eigen::Vector3d offset = positions_[q] - positions_[p];
      const Eigen::Vector3d other = normals_[q].cast<double> ();
      const double limit = limits_.sheet_sine * offset.norm ();
      if (!same_sheet ||
          (std::abs (normal.dot (offset)) <= limit && std::abs (other.dot (offset)) <= limit &&
           std::abs (normal.dot (other)) >= limits_.sheet_cosine))
        planar_.push_back ({frame.project (offset), q});
    }
    star_.order (planar_);
    return star_.openingAngle () > limits_.empty_sector * DEGREE;
  }

private:
  const std::vector<Eigen::Vector3d>& positions_;
  const CsrLists& neighbors_;
  const std::vector<Eigen::Vector3f>& normals_;
  const OpenLoopLimits& limits_;
  PlanarStar star_;
  std::vector<PlanarNeighbor> planar_;
};

} // namespace

std::vector<LoopEvidence>
findEvidence (const std::vector<BoundaryLoop>& loops, const std::vector<Eigen::Vector3d>& positions,
              const CsrLists& neighbors, const std::vector<Eigen::Vector3f>& normals,
              const OpenLoopLimits& limits, const RunContext& run)
{
  std::vector<LoopEvidence> evidence;
  evidence.reserve (loops.size ());
  SectorTest test (positions, neighbors, normals, limits);
  ProgressLoop progress (run);
  for (const BoundaryLoop& loop : loops) {
    std::size_t open = 0, empty = 0;
    for (const Index p : loop.points) {
      progress.next ();
      open += test.hasEmptySector (p, true) ? 1 : 0;
      empty += test.hasEmptySector (p, false) ? 1 : 0;
    }
    const auto count = static_cast<double> (loop.points.size ());
    evidence.push_back ({static_cast<double> (open) / count, static_cast<double> (empty) / count});
  }
  return evidence;
}

void
chooseOpenLoops (std::vector<BoundaryLoop>& loops, const std::vector<LoopEvidence>& evidence,
                 const std::vector<std::size_t>& component_points, const HoleOptions& holes,
                 double unit, const OpenLoopLimits& limits)
{
  std::vector<std::uint8_t> is_boundary (loops.size ());
  for (std::size_t i = 0; i < loops.size (); ++i)
    is_boundary[i] =
        isBoundary (loops[i], evidence[i], component_points[loops[i].component], limits) ? 1 : 0;
  // Boundaries first, then by the length along which points see an empty sector.
  std::vector<std::size_t> by_size (loops.size ());
  std::iota (by_size.begin (), by_size.end (), std::size_t{0});
  const auto key = [&] (std::size_t i) {
    return std::make_tuple (is_boundary[i], evidence[i].empty_share * loops[i].length,
                            loops[i].length);
  };
  std::stable_sort (by_size.begin (), by_size.end (),
                    [&key] (std::size_t a, std::size_t b) { return key (b) < key (a); });

  switch (holes.policy) {
  case HolePolicy::CLOSE_ALL:
    return;
  case HolePolicy::KEEP_LARGEST: {
    std::vector<std::uint8_t> has_one (component_points.size (), 0);
    for (const std::size_t i : by_size) {
      loops[i].keep_open = has_one[loops[i].component] == 0;
      has_one[loops[i].component] = 1;
    }
    return;
  }
  case HolePolicy::KEEP_COUNT:
    for (std::size_t rank = 0; rank < by_size.size (); ++rank)
      loops[by_size[rank]].keep_open = rank < static_cast<std::size_t> (holes.kept_loops);
    return;
  case HolePolicy::BY_SIZE:
    for (BoundaryLoop& loop : loops)
      loop.keep_open =
          (holes.largest_hole > 0.0 && loop.width > holes.largest_hole * loop.spacing) ||
          (holes.largest_hole_length > 0.0 && loop.width > holes.largest_hole_length * unit);
    return;
  case HolePolicy::AUTO:
    for (std::size_t i = 0; i < loops.size (); ++i)
      loops[i].keep_open = is_boundary[i] != 0;
    return;
  }
}

} // namespace floater
} // namespace pcl
