// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/convex_layout.h"

#include "core/geometry.h"
#include "floater/domain.h"
#include "floater/solvers/solver.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

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

} // namespace pcl::floater
