// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/convex_layout.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "floater/domain.h"
#include "floater/solvers/solver.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl::floater {
namespace {
constexpr int MOST_STEPS = 10;          // of the relaxation; later ones hardly lower the stretch
constexpr double LEAST_PROGRESS = 0.98; // factor of the stretch by a step, to continue
constexpr double SMALLEST_TANGENT = 1e-6, LARGEST_TANGENT = 1e6; // of half an angle

// tan (angle / 2) at corner i of a triangle.
double
halfTangent (const std::array<Eigen::Vector3d, 3>& place, std::size_t i)
{
  const Eigen::Vector3d a = place[(i + 1) % 3] - place[i], b = place[(i + 2) % 3] - place[i];
  const double sine = a.cross (b).norm (), cosine = a.dot (b), lengths = a.norm () * b.norm ();
  const double tangent = cosine >= 0.0 ? sine / (lengths + cosine) : (lengths - cosine) / sine;
  // NaN: two equal corners
  return tangent > SMALLEST_TANGENT ? std::min (tangent, LARGEST_TANGENT) : SMALLEST_TANGENT;
}

// Neighbours of the inner vertices and their mean value weights.
struct Weights
{
  CsrLists neighbors;
  std::vector<double> values;
};

Weights
meanValueWeights (const ChartMesh& chart)
{
  const TriangleMesh& mesh = chart.mesh;
  std::vector<std::uint8_t> is_inner (chart.positions.size (), 1);
  for (const Index p : chart.loop)
    is_inner[p] = 0;
  // At an inner vertex, each edge ends one triangle and begins another.
  Weights weights;
  weights.neighbors = makeCsrLists (chart.positions.size (), [&] (const auto& emit) {
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (is_inner[mesh.from ({t, side})] != 0)
          emit (mesh.from ({t, side}), 3 * t + side);
  });
  const auto tangentAt = [&] (Index t, std::uint8_t corner) {
    const Triangle& c = mesh.triangles[t];
    return halfTangent ({chart.positions[c[0]], chart.positions[c[1]], chart.positions[c[2]]},
                        corner);
  };
  weights.values.reserve (weights.neighbors.ids.size ());
  for (Index& id : weights.neighbors.ids) {
    const MeshEdge edge{id / 3, static_cast<std::uint8_t> (id % 3)}, mate = mesh.mate (edge);
    const double length =
        (chart.positions[mesh.to (edge)] - chart.positions[mesh.from (edge)]).norm ();
    const double sum = tangentAt (edge.triangle, TriangleMesh::next (edge.side)) +
                       tangentAt (mate.triangle, TriangleMesh::previous (mate.side));
    weights.values.push_back (length > 0.0 ? sum / length : 1.0);
    id = mesh.to (edge);
  }
  return weights;
}

// Stretch around each vertex, and in total.
struct LocalStretch
{
  std::vector<double> of_vertex;
  double mean = std::numeric_limits<double>::infinity (); // infinite if a triangle is flipped
};

LocalStretch
measureLocally (const ChartMesh& chart, const RestShapes& rest,
                const std::vector<Eigen::Vector2d>& uv)
{
  LocalStretch result;
  std::vector<double> squares (uv.size (), 0.0), areas (uv.size (), 0.0);
  double sum = 0.0, plane_area = 0.0;
  for (std::size_t t = 0; t < chart.mesh.triangles.size (); ++t) {
    const Triangle& c = chart.mesh.triangles[t];
    Eigen::Matrix2d edges;
    edges << uv[c[1]] - uv[c[0]], uv[c[2]] - uv[c[0]];
    const double determinant = edges.determinant ();
    if (!(determinant > 0.0))
      return result;
    const RestShape& shape = rest.shapes[t];
    // For the inverse of the map from the shape: as many squares, over the determinant.
    const double inverse_determinant = 1.0 / (determinant * shape.to_unit.determinant ());
    const double square = 0.5 * shape.area * (edges * shape.to_unit).squaredNorm () *
                          inverse_determinant * inverse_determinant;
    sum += square;
    plane_area += 0.5 * determinant;
    for (const Index p : c) {
      squares[p] += square;
      areas[p] += shape.area;
    }
  }
  result.mean = std::sqrt (sum * plane_area);
  result.of_vertex.resize (uv.size ());
  for (std::size_t p = 0; p < uv.size (); ++p)
    result.of_vertex[p] = std::sqrt (squares[p] / areas[p]);
  return result;
}

std::vector<Eigen::Vector2d>
solveWeights (const ChartMesh& chart, const Weights& weights,
              const std::vector<Eigen::Vector2d>& loop_uv, const RunContext& run)
{
  const std::vector<std::uint8_t> all (chart.positions.size (), 1);
  const LinearSystem system =
      assembleSystem (weights.neighbors, weights.values, chart.loop, loop_uv, all);
  const Solution solution = solve (system, {}, run);
  if (solution.outcome == Solution::Outcome::OUT_OF_MEMORY)
    throw std::bad_alloc ();
  if (solution.outcome != Solution::Outcome::OK)
    return {};
  std::vector<Eigen::Vector2d> uv (chart.positions.size ());
  for (std::size_t i = 0; i < chart.loop.size (); ++i)
    uv[chart.loop[i]] = loop_uv[i];
  for (std::size_t i = 0; i < system.unknowns (); ++i)
    uv[system.point_of_unknown[i]] = solution.uv.row (static_cast<Eigen::Index> (i));
  return uv;
}

} // namespace

PlaneLayout
layOutOnCircle (const ChartMesh& chart, const RestShapes& rest, const RunContext& run)
{
  PlaneLayout layout;
  const std::vector<Eigen::Vector2d> loop_uv = layLoop (chart.positions, chart.loop, {});
  Weights weights = meanValueWeights (chart);
  std::vector<Eigen::Vector2d> uv = solveWeights (chart, weights, loop_uv, run);
  if (uv.empty ())
    return layout;
  LocalStretch stretch = measureLocally (chart, rest, uv);
  if (std::isinf (stretch.mean)) {
    // Weights of long triangles are so different that rounding merges their ends.
    std::fill (weights.values.begin (), weights.values.end (), 1.0);
    uv = solveWeights (chart, weights, loop_uv, run);
    if (uv.empty ())
      return layout;
    stretch = measureLocally (chart, rest, uv);
    if (std::isinf (stretch.mean))
      return layout;
  }
  layout.uv = std::move (uv);
  if (chart.loop.size () == chart.positions.size ())
    return layout; // no inner vertex
  for (int step = 0; step < MOST_STEPS; ++step) {
    for (std::size_t i = 0; i < weights.values.size (); ++i)
      weights.values[i] /= stretch.of_vertex[weights.neighbors.ids[i]];
    std::vector<Eigen::Vector2d> next = solveWeights (chart, weights, loop_uv, run);
    if (next.empty ())
      break;
    LocalStretch next_stretch = measureLocally (chart, rest, next);
    if (!(next_stretch.mean < stretch.mean))
      break;
    const bool goes_on = next_stretch.mean < LEAST_PROGRESS * stretch.mean;
    layout.uv = std::move (next);
    stretch = std::move (next_stretch);
    if (!goes_on)
      break;
  }
  return layout;
}

bool
layOutWithin (const ChartMesh& chart, const RunContext& run, std::vector<Eigen::Vector2d>& uv)
{
  std::vector<Eigen::Vector2d> loop_uv;
  for (const Index p : chart.loop)
    loop_uv.push_back (uv[p]);
  std::vector<Eigen::Vector2d> solved =
      solveWeights (chart, meanValueWeights (chart), loop_uv, run);
  if (solved.empty ())
    return false;
  uv = std::move (solved);
  return true;
}

namespace {
constexpr double EAR_HEIGHT = 0.2; // of a triangle with two edges on the boundary, over its base

class Untangler
{
public:
  Untangler (const ChartMesh& chart, const UntanglingLimits& limits,
             std::vector<Eigen::Vector2d>& uv)
      : chart_ (chart), limits_ (limits), uv_ (uv), before_ (uv.size (), NONE),
        after_ (uv.size (), NONE), corners_ (makeCsrLists (uv.size (), [&chart] (const auto& emit) {
          for (Index t = 0; t < chart.mesh.triangles.size (); ++t)
            for (std::uint8_t i = 0; i < 3; ++i)
              emit (chart.mesh.triangles[t][i], 3 * t + i);
        }))
  {
    for (std::size_t i = 0; i < chart.loop.size (); ++i) {
      const Index p = chart.loop[i], next = chart.loop[i + 1 == chart.loop.size () ? 0 : i + 1];
      after_[p] = next;
      before_[next] = p;
    }
  }

  bool untangle (const RunContext& run)
  {
    for (int round = 0; round < limits_.rounds; ++round) {
      run.poll ();
      bad_.clear ();
      const std::size_t flipped = findFlipped ();
      if (static_cast<double> (flipped) >
          limits_.most_flipped * static_cast<double> (chart_.mesh.triangles.size ()))
        break;
      findCrossing ();
      if (bad_.empty ())
        return true;
      markAround (1 + round / limits_.rounds_per_ring);
      for (int sweep = 0; sweep < limits_.sweeps; ++sweep)
        for (const Index p : marked_)
          uv_[p] = targetOf (p);
    }
    return false;
  }

private:
  // \return number of flipped triangles
  std::size_t findFlipped ()
  {
    std::size_t flipped = 0;
    for (const Triangle& t : chart_.mesh.triangles)
      if (!(cross (Eigen::Vector2d (uv_[t[1]] - uv_[t[0]]),
                   Eigen::Vector2d (uv_[t[2]] - uv_[t[0]])) > 0.0)) {
        ++flipped;
        bad_.insert (bad_.end (), t.begin (), t.end ());
      }
    return flipped;
  }

  // Boundary edges from left to right: an edge can only cross others that begin before it ends.
  void findCrossing ()
  {
    const std::vector<Index>& loop = chart_.loop;
    const std::size_t size = loop.size ();
    const auto from = [&] (std::size_t i) -> const Eigen::Vector2d& { return uv_[loop[i]]; };
    const auto to = [&] (std::size_t i) -> const Eigen::Vector2d& {
      return uv_[loop[i + 1 == size ? 0 : i + 1]];
    };
    std::vector<std::size_t> order (size);
    std::iota (order.begin (), order.end (), std::size_t{0});
    const auto begin = [&] (std::size_t i) { return std::min (from (i).x (), to (i).x ()); };
    std::sort (order.begin (), order.end (), [&] (std::size_t a, std::size_t b) {
      return begin (a) != begin (b) ? begin (a) < begin (b) : a < b;
    });
    std::vector<std::size_t> open; // edges that have not ended yet
    for (const std::size_t i : order) {
      open.erase (std::remove_if (open.begin (), open.end (),
                                  [&] (std::size_t j) {
                                    return std::max (from (j).x (), to (j).x ()) < begin (i);
                                  }),
                  open.end ());
      for (const std::size_t j : open)
        if ((i + 1) % size != j && (j + 1) % size != i &&
            haveCommon (from (i), to (i), from (j), to (j)))
          for (const std::size_t edge : {i, j}) {
            bad_.push_back (loop[edge]);
            bad_.push_back (loop[edge + 1 == size ? 0 : edge + 1]);
          }
      open.push_back (i);
    }
  }

  // Whether two segments have a point in common.
  static bool haveCommon (const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& c, const Eigen::Vector2d& d)
  {
    const auto side = [] (const Eigen::Vector2d& p, const Eigen::Vector2d& q,
                          const Eigen::Vector2d& r) {
      return cross (Eigen::Vector2d (q - p), Eigen::Vector2d (r - p));
    };
    if (std::max (a.y (), b.y ()) < std::min (c.y (), d.y ()) ||
        std::max (c.y (), d.y ()) < std::min (a.y (), b.y ()))
      return false;
    return side (a, b, c) * side (a, b, d) <= 0.0 && side (c, d, a) * side (c, d, b) <= 0.0;
  }

  // Marks bad vertices and some rings around them, in addition to earlier marks.
  void markAround (int rings)
  {
    std::vector<Index> found = bad_;
    std::vector<std::uint8_t> is_found (uv_.size (), 0);
    for (const Index p : found)
      is_found[p] = 1;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t before = found.size ();
      for (std::size_t i = 0; i < before; ++i)
        for (const Index id : corners_.row (found[i]))
          for (const Index q : chart_.mesh.triangles[id / 3])
            if (is_found[q] == 0) {
              is_found[q] = 1;
              found.push_back (q);
            }
    }
    marked_.insert (marked_.end (), found.begin (), found.end ());
    sortUnique (marked_);
  }

  // The mean of the neighbours; on the boundary, of those along it.
  Eigen::Vector2d targetOf (Index p) const
  {
    const Row row = corners_.row (p);
    if (before_[p] == NONE) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero ();
      for (const Index id : row)
        sum += cornerAfter (id, 1);
      return sum / static_cast<double> (row.size ());
    }
    const Eigen::Vector2d &before = uv_[before_[p]], &after = uv_[after_[p]];
    const Eigen::Vector2d middle = 0.5 * (before + after);
    if (row.size () > 1)
      return middle;
    // A vertex of one triangle lies to the right of the line from the vertex before to the one
    // after it.
    const Eigen::Vector2d way = after - before;
    return middle + EAR_HEIGHT * Eigen::Vector2d (way.y (), -way.x ());
  }

  // Corner of a triangle, as 3 triangle + corner, after a number of steps.
  const Eigen::Vector2d& cornerAfter (Index id, Index places) const
  {
    return uv_[chart_.mesh.triangles[id / 3][(id % 3 + places) % 3]];
  }

  const ChartMesh& chart_;
  const UntanglingLimits& limits_;
  std::vector<Eigen::Vector2d>& uv_;
  std::vector<Index> before_, after_; // per vertex: those along the boundary, NONE if it is inside
  CsrLists corners_;                  // per vertex: where it is a corner, as 3 triangle + corner
  std::vector<Index> bad_;            // vertices, some more than once
  std::vector<Index> marked_;         // to be moved
};

} // namespace

bool
untangle (const ChartMesh& chart, const UntanglingLimits& limits, const RunContext& run,
          std::vector<Eigen::Vector2d>& uv)
{
  return Untangler (chart, limits, uv).untangle (run);
}

} // namespace pcl::floater
