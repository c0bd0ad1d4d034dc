// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/loops.h"

#include "core/geometry.h"
#include "local/planar_star.h"
#include "mesh/hole_filling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace pcl::floater {
namespace {
constexpr std::size_t WIDTH_POINTS = 256; // maximum for the width: its time is quadratic

double
widthOf (const std::vector<Index>& points, const std::vector<Eigen::Vector3d>& positions)
{
  const std::size_t step = (points.size () + WIDTH_POINTS - 1) / WIDTH_POINTS;
  double sqr_width = 0.0;
  for (std::size_t i = 0; i < points.size (); i += step)
    for (std::size_t j = 0; j < i; j += step)
      sqr_width =
          std::max (sqr_width, (positions[points[i]] - positions[points[j]]).squaredNorm ());
  return std::sqrt (sqr_width);
}

} // namespace

void
measureLoop (BoundaryLoop& loop, const std::vector<Eigen::Vector3d>& positions,
             const std::vector<float>& spacing)
{
  const std::size_t count = loop.points.size ();
  loop.length = loop.spacing = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Index p = loop.points[i];
    loop.length += (positions[loop.points[i + 1 == count ? 0 : i + 1]] - positions[p]).norm ();
    loop.spacing += spacing[p];
  }
  loop.spacing /= static_cast<double> (std::max<std::size_t> (1, count));
  loop.width = widthOf (loop.points, positions);
}

std::vector<BoundaryLoop>
findBoundaryLoops (const TriangleMesh& mesh, const MeshComponents& components,
                   const std::vector<Eigen::Vector3d>& positions, const std::vector<float>& spacing,
                   const RunContext& run)
{
  std::vector<BoundaryLoop> loops;
  ProgressLoop progress (run);
  for (std::vector<Index>& points : boundaryLoops (mesh, run)) {
    progress.next ();
    BoundaryLoop loop;
    loop.component = components.of_triangle[mesh.triangle_of[points.front ()]];
    loop.points = std::move (points);
    measureLoop (loop, positions, spacing);
    loops.push_back (std::move (loop));
  }
  return loops;
}

namespace {
constexpr double MOST_TURNING = 1.5; // turns; rough loops on noise have arbitrary values

// Corners of a loop in its filling; a longer one is sampled in even steps. Limits the time, which
// grows with the third power.
constexpr std::size_t MOST_CORNERS = 64;

// Weight of the squared edges of a filling beside its doubled area: of fillings with about the same
// area, as in a flat loop, prefers short edges.
constexpr double EDGE_WEIGHT = 0.05;

// Tests whether a point has a large sector without neighbours, on its own sheet or on any.
class SectorTest
{
public:
  SectorTest (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const std::vector<Eigen::Vector3f>& normals, const EmptySectorLimits& limits)
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
      if (!same_sheet || onSameSheet (normal, other, offset, limits_.sheet))
        planar_.push_back ({frame.project (offset), q});
    }
    star_.order (planar_);
    return star_.openingAngle () > limits_.angle * DEGREE;
  }

private:
  const std::vector<Eigen::Vector3d>& positions_;
  const CsrLists& neighbors_;
  const std::vector<Eigen::Vector3f>& normals_;
  const EmptySectorLimits& limits_;
  PlanarStar star_;
  std::vector<PlanarNeighbor> planar_;
};

// Mean and standard deviation of logarithms of lengths.
class LogLengths
{
public:
  void add (double length)
  {
    const double logarithm = std::log (length);
    count_ += 1.0;
    sum_ += logarithm;
    squares_ += logarithm * logarithm;
  }
  bool isEmpty () const { return count_ == 0.0; }
  double mean () const { return isEmpty () ? 0.0 : sum_ / count_; }
  double deviation () const
  {
    return isEmpty () ? 0.0 : std::sqrt (std::max (0.0, squares_ / count_ - mean () * mean ()));
  }

private:
  double count_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

// Walks from loops into the surface, ring by ring of points, and measures edges.
class RingWalk
{
public:
  static constexpr std::size_t RINGS = 4;

  RingWalk (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions)
      : mesh_ (mesh), positions_ (positions), ring_ (positions.size (), 0)
  {
  }

  // The edges that begin in each ring and do not lead back; ring 0 is the loop.
  std::array<LogLengths, RINGS> walk (const std::vector<Index>& loop)
  {
    std::array<LogLengths, RINGS> edges;
    // A point of ring k has the number base_ + k + 1; lower numbers belong to earlier walks.
    if (base_ > LARGEST_BASE) {
      std::fill (ring_.begin (), ring_.end (), 0U);
      base_ = 0;
    }
    current_ = loop;
    for (const Index p : current_)
      ring_[p] = base_ + 1;
    for (std::uint32_t k = 0; k < RINGS; ++k) {
      const std::uint32_t own = base_ + k + 1;
      next_.clear ();
      for (const Index p : current_)
        forEachNeighbor (p, [&] (Index q) {
          if (ring_[q] <= base_) {
            ring_[q] = own + 1;
            next_.push_back (q);
          }
        });
      for (const Index p : current_)
        forEachNeighbor (p, [&] (Index q) {
          if (ring_[q] > own || (ring_[q] == own && p < q))
            edges[k].add ((positions_[q] - positions_[p]).norm ());
        });
      current_.swap (next_);
    }
    base_ += RINGS + 1;
    return edges;
  }

  // Geodesic curvature at a point of a loop: half a turn minus the angles of its triangles.
  double curvature (Index p)
  {
    double angle = PI;
    mesh_.fan (p, fan_);
    for (const Index t : fan_) {
      const std::uint8_t side = mesh_.sideOf (t, p);
      const Eigen::Vector3d a =
          positions_[mesh_.triangles[t][TriangleMesh::next (side)]] - positions_[p];
      const Eigen::Vector3d b =
          positions_[mesh_.triangles[t][TriangleMesh::previous (side)]] - positions_[p];
      angle -= std::atan2 (a.cross (b).norm (), a.dot (b));
    }
    return angle;
  }

private:
  static constexpr std::uint32_t LARGEST_BASE = 0xffff0000U;

  // All points that share an edge with p.
  template <typename Visit>
  void forEachNeighbor (Index p, Visit&& visit)
  {
    const auto first = [&] (Index t) {
      return mesh_.triangles[t][TriangleMesh::next (mesh_.sideOf (t, p))];
    };
    const auto last = [&] (Index t) {
      return mesh_.triangles[t][TriangleMesh::previous (mesh_.sideOf (t, p))];
    };
    mesh_.fan (p, fan_);
    for (const Index t : fan_)
      visit (first (t));
    if (last (fan_.back ()) != first (fan_.front ())) // the fan ends at a boundary
      visit (last (fan_.back ()));
  }

  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  std::vector<std::uint32_t> ring_;
  std::uint32_t base_ = 0;
  std::vector<Index> current_, next_, fan_;
};

// The largest height of a triangle in a filling of least area.
double
findDepth (const std::vector<Index>& loop, const std::vector<Eigen::Vector3d>& positions,
           PolygonFilling& filling)
{
  std::vector<Index> corners;
  const std::size_t count = std::min (loop.size (), MOST_CORNERS);
  for (std::size_t i = 0; i < count; ++i)
    corners.push_back (loop[i * loop.size () / count]);
  const auto squaredEdges = [&positions] (Index a, Index b, Index c) {
    return (positions[b] - positions[a]).squaredNorm () +
           (positions[c] - positions[b]).squaredNorm () +
           (positions[a] - positions[c]).squaredNorm ();
  };
  const auto cost = [&] (Index a, Index b, Index c) {
    return areaVector (positions[a], positions[b], positions[c]).norm () +
           EDGE_WEIGHT * squaredEdges (a, b, c);
  };
  double depth = 0.0;
  for (const auto& [a, b, c] : filling.fill (corners, cost, [] (Index, Index) { return true; })) {
    const double longest = std::sqrt (std::max ({(positions[b] - positions[a]).squaredNorm (),
                                                 (positions[c] - positions[b]).squaredNorm (),
                                                 (positions[a] - positions[c]).squaredNorm ()}));
    if (longest > 0.0)
      depth =
          std::max (depth, areaVector (positions[a], positions[b], positions[c]).norm () / longest);
  }
  return depth;
}

LoopEvidence
lookAt (const BoundaryLoop& loop, const std::vector<Eigen::Vector3d>& positions, RingWalk& rings,
        PolygonFilling& filling)
{
  const std::size_t count = loop.points.size ();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero ();
  for (const Index p : loop.points)
    centre += positions[p] / static_cast<double> (count);
  Eigen::Vector3d double_area = Eigen::Vector3d::Zero ();
  double curvature = 0.0, length = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Index p = loop.points[i], q = loop.points[i + 1 == count ? 0 : i + 1];
    const double step = (positions[q] - positions[p]).norm ();
    length += step;
    squares += step * step;
    double_area += (positions[p] - centre).cross (positions[q] - centre);
    curvature += rings.curvature (p);
  }
  const std::array<LogLengths, RingWalk::RINGS> edges = rings.walk (loop.points);
  LoopEvidence evidence;
  evidence.compactness = 2.0 * PI * double_area.norm () / (length * length);
  const double edge = std::sqrt (squares / static_cast<double> (count));
  evidence.depth = findDepth (loop.points, positions, filling) / edge;
  evidence.irregularity = edges[2].deviation ();
  evidence.edge = std::exp (edges[2].mean ());
  evidence.growth = edges[3].isEmpty () ? 0.0 : edges[0].mean () - edges[3].mean ();
  evidence.turning = std::clamp (curvature / (2.0 * PI), -MOST_TURNING, +MOST_TURNING);
  return evidence;
}

} // namespace

std::vector<LoopEvidence>
findEvidence (const TriangleMesh& mesh, const std::vector<BoundaryLoop>& loops,
              const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const std::vector<Eigen::Vector3f>& normals, const EmptySectorLimits& limits,
              const RunContext& run)
{
  std::vector<LoopEvidence> evidence;
  evidence.reserve (loops.size ());
  SectorTest test (positions, neighbors, normals, limits);
  RingWalk rings (mesh, positions);
  PolygonFilling filling (run);
  ProgressLoop progress (run);
  for (const BoundaryLoop& loop : loops) {
    std::size_t open = 0, empty = 0;
    for (const Index p : loop.points) {
      progress.next ();
      open += test.hasEmptySector (p, true) ? 1 : 0;
      empty += test.hasEmptySector (p, false) ? 1 : 0;
    }
    const auto count = static_cast<double> (loop.points.size ());
    evidence.push_back (lookAt (loop, positions, rings, filling));
    evidence.back ().open_share = static_cast<double> (open) / count;
    evidence.back ().empty_share = static_cast<double> (empty) / count;
  }
  return evidence;
}

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
