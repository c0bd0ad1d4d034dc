// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/loops.h"

#include "core/order_statistics.h"
#include "local/planar_star.h"
#include "local/star_reach.h"
#include "mesh/hole_filling.h"

#include <set>

namespace pcl::floater {
namespace {
constexpr double MOST_TURNING = 1.5; // turns; rough loops on noise have arbitrary values

// A larger sector without neighbours counts as empty. Theory: 180 degrees minus the bend of a hole
// that is 6 spacings wide.
constexpr double EMPTY_ANGLE = 130.0 * DEGREE;

// LoopEvidence::depth times open_share, since a loop with points beyond it is not empty. Deeper gaps
// stay open by the automatic policy. Measured: fewer than 1 in 200 generated gaps from 4 spacings on
// are deeper.
constexpr double DEEPEST_GAP = 2.46;

// Absolute log odds from which on loops are certain: 20 to 1.
constexpr double CERTAIN_LOG_ODDS = 3.0;

// Corners of a loop in its filling; a longer one is sampled in even steps. Limits the time, which
// grows with the third power.
constexpr std::size_t MOST_CORNERS = 64;

// Weight of the squared edges of a filling beside its doubled area: of fillings with about the same
// area, as in a flat loop, prefers short edges.
constexpr double EDGE_WEIGHT = 0.05;

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
struct RingWalk
{
  static constexpr Index RINGS = 4;

  const TriangleMesh& mesh;
  const Positions& positions;
  // Of each point, NONE outside of a walk.
  std::vector<Index> ring_of = std::vector<Index> (positions.size (), NONE);
  std::vector<Index> fan = {}, beside = {};
  // Of the last walk: its points, with the ends of the rings, and the edges from the loop inwards.
  std::vector<Index> points = {};
  std::array<std::size_t, RINGS> ends = {};
  LogLengths inwards = {};

  // The edges that begin in each ring and do not lead back; ring 0 is the loop.
  std::array<LogLengths, RINGS> walk (const std::vector<Index>& loop)
  {
    std::array<LogLengths, RINGS> edges;
    points = loop;
    inwards = {};
    for (const Index p : points)
      ring_of[p] = 0;
    std::size_t first = 0;
    for (Index ring = 0; ring < RINGS; ++ring) {
      const std::size_t last = ends[ring] = points.size ();
      for (std::size_t i = first; i < last; ++i)
        for (const Index q : around (points[i]))
          if (ring_of[q] == NONE) {
            ring_of[q] = ring + 1;
            points.push_back (q);
          }
      for (; first < last; ++first) {
        const Index p = points[first];
        for (const Index q : around (p))
          if (ring_of[q] > ring || (ring_of[q] == ring && p < q)) {
            const double length = (positions[q] - positions[p]).norm ();
            edges[ring].add (length);
            if (ring_of[q] > ring && ring == 0)
              inwards.add (length);
          }
      }
    }
    for (const Index p : points)
      ring_of[p] = NONE;
    return edges;
  }

  // Geodesic curvature at a point of a loop: half a turn minus the angles of its triangles.
  double curvature (Index p)
  {
    double angle = PI;
    around (p);
    for (std::size_t i = 1; i < beside.size (); ++i) {
      const Vector3d a = positions[beside[i - 1]] - positions[p];
      const Vector3d b = positions[beside[i]] - positions[p];
      angle -= std::atan2 (a.cross (b).norm (), a.dot (b));
    }
    return angle;
  }

  const std::vector<Index>& around (Index p)
  {
    mesh.fan (p, fan, beside);
    return beside;
  }
};

// The largest height of a triangle in a filling of least area.
double
findDepth (const std::vector<Index>& loop, const Positions& positions, PolygonFilling& filling)
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

// Whether a loop is the last of lines in parallel planes, as slices of a body, and the next plane would miss
// the surface, since the sections become so narrow towards the loop.
bool
isLastLine (const RingWalk& rings, const Positions& positions, const Vector3d& centre,
            const Vector3d& axis)
{
  // Root mean square of the distances to the nearest plane, in steps between planes: 0.29 for any heights.
  constexpr double LARGEST_OFFSET = 0.1;
  // Of the squared width, over one step. Where a surface ends within a step, it is 2 or more for a
  // paraboloid, and 1.5 or more for a sphere that 5 planes meet.
  constexpr double LEAST_GROWTH = 1.5;
  const auto heightOf = [&] (Index p) { return axis.dot (positions[p] - centre); };
  std::vector<double> heights;
  for (std::size_t i = rings.ends[0]; i < rings.ends[1]; ++i)
    heights.push_back (heightOf (rings.points[i]));
  const double step = heights.empty () ? 0.0 : median (heights);
  if (step == 0.0)
    return false;
  std::array<PlaneFit, 2> sections; // at the loop, and a step beside
  double sum = 0.0;
  for (std::size_t i = 0; i < rings.ends[2]; ++i) {
    const Index p = rings.points[i];
    const double height = heightOf (p) / step, plane = std::round (height);
    sum += (height - plane) * (height - plane);
    if (plane == 0.0 || plane == 1.0)
      sections[plane == 0.0 ? 0 : 1].add (positions[p] - centre);
  }
  return sum < LARGEST_OFFSET * LARGEST_OFFSET * static_cast<double> (rings.ends[2]) &&
         sections[0].weight () > 0.0 &&
         sections[1].line ().mean_square > LEAST_GROWTH * sections[0].line ().mean_square;
}

LoopEvidence
lookAt (const BoundaryLoop& loop, const Positions& positions, RingWalk& rings,
        PolygonFilling& filling)
{
  const std::size_t count = loop.points.size ();
  Vector3d centre = Vector3d::Zero ();
  for (const Index p : loop.points)
    centre += positions[p] / static_cast<double> (count);
  // Points of a loop that count for each line that it interrupts, at least. With 3, generated lines keep
  // as many windows as if all points counted; with 2, half of those that are 6 lines wide, 8 steps apart.
  constexpr double POINTS_OF_LINE = 3.0;
  const std::array<LogLengths, RingWalk::RINGS> edges = rings.walk (loop.points);
  const double mean = loop.length / static_cast<double> (count),
               inwards = rings.inwards.isEmpty () ? mean : std::exp (rings.inwards.mean ());
  Vector3d double_area = Vector3d::Zero ();
  double curvature = 0.0, squares = 0.0, across = 0.0; // steps from line to line
  for (std::size_t i = 0; i < count; ++i) {
    const Index p = loop.points[i], q = loop.points[i + 1 == count ? 0 : i + 1];
    const double step = (positions[q] - positions[p]).norm ();
    squares += step * step;
    across += step * step > mean * inwards ? 1.0 : 0.0;
    double_area += (positions[p] - centre).cross (positions[q] - centre);
    curvature += rings.curvature (p);
  }
  LoopEvidence evidence;
  evidence.compactness = 2.0 * PI * double_area.norm () / (loop.length * loop.length);
  const double edge = std::sqrt (squares / static_cast<double> (count));
  const double most = static_cast<double> (count) / (POINTS_OF_LINE * std::max (1.0, across));
  evidence.line_distance = std::max (1.0, std::min (inwards / mean, most));
  evidence.is_last_line = isLastLine (rings, positions, centre, double_area.normalized ());
  evidence.depth = findDepth (loop.points, positions, filling) / (edge * evidence.line_distance);
  evidence.irregularity = edges[2].deviation ();
  evidence.edge = std::exp (edges[2].mean ());
  evidence.growth = edges[3].isEmpty () ? 0.0 : edges[0].mean () - edges[3].mean ();
  evidence.turning = std::clamp (curvature / (2.0 * PI), -MOST_TURNING, +MOST_TURNING);
  return evidence;
}

// The coefficients belong to a logistic regression: the sum of evidence times coefficient is the
// logarithm of the odds that the loop is a boundary. They were fitted to loops of generated surfaces:
// windows of 4 to 40 spacings, borders, and gaps, on ten shapes in thirteen samplings, and on random
// bodies in four. A gap that stays open counts as four windows that are filled. Long loops with hardly
// a point beyond are told by the 4th power of their open share.
LoopJudgement
judge (const BoundaryLoop& loop, const LoopEvidence& evidence)
{
  const double points = static_cast<double> (loop.points.size ()) / evidence.line_distance;
  LoopJudgement judgement;
  judgement.log_odds = -12.6 + 2.19 * std::log (points) + 12.9 * evidence.compactness -
                       5.35 * evidence.irregularity - 2.06 * evidence.growth +
                       1.54 * evidence.turning +
                       0.599 * std::sqrt (points) * std::pow (evidence.open_share, 4);
  judgement.empty_length = evidence.empty_share * loop.length;
  judgement.is_too_deep = evidence.depth * evidence.open_share > DEEPEST_GAP;
  if (evidence.is_last_line)
    judgement = {std::min (judgement.log_odds, -CERTAIN_LOG_ODDS), judgement.empty_length, false};
  return judgement;
}

// Likely boundaries first, by descending value; then the others by their empty length; stable.
template <typename Value>
std::vector<BoundaryLoop*>
fromLargest (std::vector<BoundaryLoop>& loops, Value&& value)
{
  const auto key = [&value] (const BoundaryLoop& loop) {
    const bool is_likely = loop.judgement.log_odds > 0.0;
    return std::make_pair (is_likely, is_likely ? value (loop) : loop.judgement.empty_length);
  };
  std::vector<BoundaryLoop*> order;
  order.reserve (loops.size ());
  for (BoundaryLoop& loop : loops)
    order.push_back (&loop);
  std::stable_sort (
      order.begin (), order.end (),
      [&key] (const BoundaryLoop* a, const BoundaryLoop* b) { return key (*b) < key (*a); });
  return order;
}

} // namespace

BoundaryLoop
measureLoop (std::vector<Index> points, const Positions& positions,
             const std::vector<float>& spacing)
{
  constexpr std::size_t WIDTH_POINTS = 256; // maximum for the width: its time is quadratic
  BoundaryLoop loop;
  loop.length = perimeter (positions, points);
  for (const Index p : points)
    loop.spacing += spacing[p];
  loop.spacing /= static_cast<double> (std::max<std::size_t> (1, points.size ()));
  const std::size_t step = (points.size () + WIDTH_POINTS - 1) / WIDTH_POINTS;
  double sqr_width = 0.0;
  for (std::size_t i = 0; i < points.size (); i += step)
    for (std::size_t j = 0; j < i; j += step)
      sqr_width =
          std::max (sqr_width, (positions[points[i]] - positions[points[j]]).squaredNorm ());
  loop.width = std::sqrt (sqr_width);
  loop.points = std::move (points);
  return loop;
}

std::vector<BoundaryLoop>
findBoundaryLoops (const TriangleMesh& mesh, const MeshComponents& components,
                   const Positions& positions, const std::vector<float>& spacing,
                   const RunContext& run)
{
  std::vector<BoundaryLoop> loops;
  ProgressLoop progress (run);
  for (std::vector<Index>& points : boundaryLoops (mesh, run)) {
    progress.next ();
    const Index component = components.of_triangle[mesh.triangle_of[points.front ()]];
    loops.push_back (measureLoop (std::move (points), positions, spacing));
    loops.back ().component = component;
  }
  return loops;
}

std::vector<LoopEvidence>
judgeLoops (const TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
            const LocalGeometry& geometry, const RunContext& run)
{
  const Normals& normals = geometry.stars.normals;
  PlanarStar star;
  std::vector<PlanarNeighbor> planar;
  // Whether a point has a large sector without neighbours, on its own sheet or on any.
  const auto hasEmptySector = [&] (Index p, bool same_sheet) {
    const TangentFrame frame (normals[p].cast<double> ());
    planar.clear ();
    for (const Index q : geometry.neighbors.row (p)) {
      const Vector3d offset = positions[q] - positions[p];
      if (!same_sheet || onSameSheet (frame.normal, normals[q].cast<double> (), offset))
        planar.push_back ({frame.project (offset), q});
    }
    star.order (planar);
    return star.openingAngle () > EMPTY_ANGLE;
  };
  std::vector<LoopEvidence> evidence;
  RingWalk rings{mesh, positions};
  PolygonFilling filling (run);
  ProgressLoop progress (run);
  for (BoundaryLoop& loop : loops) {
    if (loop.points.empty ()) {
      evidence.emplace_back ();
      continue;
    }
    std::size_t open = 0, empty = 0;
    for (const Index p : loop.points) {
      progress.next ();
      open += hasEmptySector (p, true) ? 1 : 0;
      empty += hasEmptySector (p, false) ? 1 : 0;
    }
    const auto count = static_cast<double> (loop.points.size ());
    evidence.push_back (lookAt (loop, positions, rings, filling));
    evidence.back ().open_share = static_cast<double> (open) / count;
    evidence.back ().empty_share = static_cast<double> (empty) / count;
    loop.judgement = judge (loop, evidence.back ());
  }
  return evidence;
}

bool
isDoubtful (const LoopJudgement& judgement)
{
  constexpr double CERTAIN = 0.9; // probability. Chosen by hand
  const double probability = judgement.probability ();
  return std::max (probability, 1.0 - probability) < CERTAIN ||
         (judgement.is_too_deep && probability <= 0.5);
}

void
judgeTogether (const std::vector<BoundaryLoop*>& loops)
{
  // Difference of the logarithms of the widths of loops that are judged together. Of 140 generated
  // plates with windows, 137, 138 and 139 are right with 0.1, 0.2 and 0.3, 134 if each is judged by
  // itself.
  constexpr double ALIKE = 0.2;
  std::vector<std::pair<double, BoundaryLoop*>> by_width;
  for (BoundaryLoop* loop : loops)
    if (loop->width > 0.0)
      by_width.emplace_back (std::log (loop->width), loop);
  std::stable_sort (by_width.begin (), by_width.end (),
                    [] (const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> sums{0.0};
  for (const auto& [width, loop] : by_width)
    sums.push_back (sums.back () +
                    std::clamp (loop->judgement.log_odds, -CERTAIN_LOG_ODDS, CERTAIN_LOG_ODDS));
  std::size_t first = 0, last = 0;
  for (const auto& [width, loop] : by_width) {
    while (by_width[first].first < width - ALIKE)
      ++first;
    while (last < by_width.size () && by_width[last].first <= width + ALIKE)
      ++last;
    double& own = loop->judgement.log_odds;
    const double together =
        (sums[last] - sums[first]) / std::sqrt (static_cast<double> (last - first));
    if (std::abs (own) < CERTAIN_LOG_ODDS || (own < 0.0 && together > CERTAIN_LOG_ODDS))
      own = together;
  }
}

void
chooseOpenLoops (std::vector<BoundaryLoop>& loops, const HoleOptions& holes, double unit)
{
  std::set<Index> have_one; // components
  int kept = 0;
  switch (holes.policy) {
  case HolePolicy::CLOSE_ALL:
    return;
  case HolePolicy::KEEP_LARGEST:
    for (BoundaryLoop* loop : fromLargest (loops, [] (const BoundaryLoop& l) { return l.length; }))
      loop->keep_open = have_one.insert (loop->component).second;
    return;
  case HolePolicy::KEEP_COUNT:
    for (BoundaryLoop* loop :
         fromLargest (loops, [] (const BoundaryLoop& l) { return l.judgement.log_odds; }))
      loop->keep_open = kept++ < holes.kept_loops;
    return;
  case HolePolicy::BY_SIZE:
    for (BoundaryLoop& loop : loops)
      loop.keep_open =
          loop.width > holes.largest_hole * (holes.unit == LengthUnit::CLOUD ? unit : loop.spacing);
    return;
  case HolePolicy::AUTO:
    for (BoundaryLoop& loop : loops)
      loop.keep_open = loop.judgement.staysOpen ();
    return;
  }
}

} // namespace pcl::floater
