// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/open_loops.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pcl::floater {
namespace {
// Indices by descending key; stable.
template <typename Key>
std::vector<std::size_t>
fromLargest (std::size_t count, Key&& key)
{
  std::vector<std::size_t> order (count);
  std::iota (order.begin (), order.end (), std::size_t{0});
  std::stable_sort (order.begin (), order.end (),
                    [&key] (std::size_t a, std::size_t b) { return key (b) < key (a); });
  return order;
}

// Likely boundaries first, by value; then the others by their empty length.
std::pair<bool, double>
rank (const LoopJudgement& judgement, double value)
{
  return judgement.log_odds > 0.0 ? std::make_pair (true, value)
                                  : std::make_pair (false, judgement.empty_length);
}

void
keepLargest (std::vector<BoundaryLoop>& loops, const std::vector<LoopJudgement>& judgements,
             std::size_t components)
{
  const auto key = [&] (std::size_t i) { return rank (judgements[i], loops[i].length); };
  std::vector<std::uint8_t> has_one (components, 0);
  for (const std::size_t i : fromLargest (loops.size (), key)) {
    loops[i].keep_open = has_one[loops[i].component] == 0;
    has_one[loops[i].component] = 1;
  }
}

void
keepCount (std::vector<BoundaryLoop>& loops, const std::vector<LoopJudgement>& judgements,
           std::size_t count)
{
  const auto key = [&] (std::size_t i) { return rank (judgements[i], judgements[i].log_odds); };
  const std::vector<std::size_t> order = fromLargest (loops.size (), key);
  for (std::size_t i = 0; i < order.size (); ++i)
    loops[order[i]].keep_open = i < count;
}

} // namespace

LoopJudgement
judgeLoop (const BoundaryLoop& loop, const LoopEvidence& evidence, const OpenLoopLimits& limits)
{
  const auto points = static_cast<double> (loop.points.size ());
  LoopJudgement judgement;
  judgement.log_odds = limits.constant + limits.points * std::log (points) +
                       limits.compactness * evidence.compactness +
                       limits.irregularity * evidence.irregularity +
                       limits.growth * evidence.growth + limits.turning * evidence.turning +
                       limits.open_points * std::sqrt (points) * std::pow (evidence.open_share, 4);
  judgement.empty_length = evidence.empty_share * loop.length;
  judgement.is_too_deep = evidence.depth * evidence.open_share > limits.deepest_gap;
  return judgement;
}

bool
isDoubtful (const LoopJudgement& judgement, const OpenLoopLimits& limits)
{
  const double probability = judgement.probability ();
  return std::max (probability, 1.0 - probability) < limits.doubtful ||
         (judgement.is_too_deep && probability <= 0.5);
}

std::vector<LoopJudgement>
judgeLoops (const TriangleMesh& mesh, const std::vector<BoundaryLoop>& loops,
            const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, const OpenLoopLimits& limits,
            const RunContext& run)
{
  const std::vector<LoopEvidence> evidence =
      findEvidence (mesh, loops, positions, neighbors, normals, limits.sectors, run);
  std::vector<LoopJudgement> judgements;
  judgements.reserve (loops.size ());
  for (std::size_t i = 0; i < loops.size (); ++i)
    judgements.push_back (judgeLoop (loops[i], evidence[i], limits));
  return judgements;
}

void
chooseOpenLoops (std::vector<BoundaryLoop>& loops, const std::vector<LoopJudgement>& judgements,
                 std::size_t components, const HoleOptions& holes, double unit)
{
  switch (holes.policy) {
  case HolePolicy::CLOSE_ALL:
    return;
  case HolePolicy::KEEP_LARGEST:
    keepLargest (loops, judgements, components);
    return;
  case HolePolicy::KEEP_COUNT:
    keepCount (loops, judgements, static_cast<std::size_t> (holes.kept_loops));
    return;
  case HolePolicy::BY_SIZE:
    for (BoundaryLoop& loop : loops)
      loop.keep_open =
          loop.width > holes.largest_hole * (holes.unit == LengthUnit::CLOUD ? unit : loop.spacing);
    return;
  case HolePolicy::AUTO:
    for (std::size_t i = 0; i < loops.size (); ++i)
      loops[i].keep_open = judgements[i].log_odds > 0.0 || judgements[i].is_too_deep;
    return;
  }
}

} // namespace pcl::floater
