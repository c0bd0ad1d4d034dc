// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/chart_layout.h"

#include "core/order_statistics.h"
#include "floater/floater_method.h"
#include "floater/solvers/solver.h"

#include <new>

namespace pcl::floater {
namespace {
// Infinite if there is no layout, or a triangle is flipped.
double
meanStretch (const MeshPiece& chart, const std::vector<Vector2d>& uv)
{
  const std::vector<Triangle>& triangles = chart.mesh.triangles;
  return uv.empty () ? std::numeric_limits<double>::infinity ()
                     : stretchOf (triangles, chart.positions, triangles, uv).mean ();
}

bool
isLayout (const MeshPiece& chart, const std::vector<Vector2d>& uv)
{
  return isUpright (chart.mesh.triangles, uv) && isSimple (chart.loop, uv);
}

// Projects the chart, seen from its mean normal.
std::vector<Vector2d>
project (const MeshPiece& chart)
{
  Vector3d normal = Vector3d::Zero (), middle = Vector3d::Zero ();
  for (const Triangle& t : chart.mesh.triangles)
    normal += areaVectorOf (t, chart.positions);
  for (const Vector3d& p : chart.positions)
    middle += p / static_cast<double> (chart.positions.size ());
  const TangentFrame frame (normal.normalized ());
  std::vector<Vector2d> uv;
  uv.reserve (chart.positions.size ());
  for (const Vector3d& p : chart.positions)
    uv.push_back (frame.project (p - middle));
  return uv;
}

// The first valid layout of: the projection; the projection with small defects repaired; a
// convex-combination map on the circle. Otherwise empty.
std::vector<Vector2d>
beginLayout (const MeshPiece& chart, const DescentLimits& limits, const RunContext& run)
{
  std::vector<Vector2d> uv = project (chart);
  if (isLayout (chart, uv) || (untangle (chart, run, uv) && isLayout (chart, uv)))
    return uv;
  if (chart.mesh.triangles.size () > limits.most_on_circle)
    return {};
  uv = layOutOnCircle (chart, run);
  return !uv.empty () && isLayout (chart, uv) ? uv : std::vector<Vector2d> ();
}

// Lowers the distortion of a layout, unless that raises its stretch; sets its figures.
void
relax (const RestShapes& rest, const DescentLimits& limits, const RunContext& run,
       ChartLayout& layout)
{
  layout.area = rest.area;
  layout.stretch = meanStretch (layout.chart, layout.uv);
  std::vector<Vector2d> uv = layout.uv;
  descendDistortion (layout.chart, rest, limits, run, uv);
  if (!isLayout (layout.chart, uv))
    return;
  if (const double stretch = meanStretch (layout.chart, uv); stretch < layout.stretch) {
    layout.stretch = stretch;
    layout.uv = std::move (uv);
  }
}

} // namespace

std::vector<Vector2d>
layOutOnCircle (const MeshPiece& chart, const RunContext& run)
{
  constexpr int MOST_STEPS = 10;          // later ones hardly lower the stretch
  constexpr double LEAST_PROGRESS = 0.98; // factor of the stretch by a step, to continue
  const std::size_t vertices = chart.positions.size ();
  const std::vector<Vector2d> loop_uv = layLoop (chart.positions, chart.loop, {});
  const CsrLists neighbors = MeshRings (chart.mesh).neighbors;
  std::vector<double> weights (neighbors.ids.size (), 1.0);
  // By the weights; empty if the solver fails.
  const auto layOut = [&] {
    const LinearSystem system =
        assembleSystem (neighbors, weights, chart.loop, loop_uv, Flags (vertices, 1));
    const Solution solution = solve (system, {}, run);
    if (solution.problem.status == RunStatus::OUT_OF_MEMORY)
      throw std::bad_alloc ();
    std::vector<Vector2d> uv;
    if (solution.problem)
      return uv;
    uv.resize (vertices);
    for (std::size_t i = 0; i < chart.loop.size (); ++i)
      uv[chart.loop[i]] = loop_uv[i];
    for (std::size_t i = 0; i < system.unknowns (); ++i)
      uv[system.point_of_unknown[i]] = solution.uv.row (static_cast<Eigen::Index> (i));
    return uv;
  };
  std::vector<Vector2d> uv = layOut ();
  double stretch = meanStretch (chart, uv);
  if (std::isinf (stretch))
    return {};
  bool goes_on = true;
  for (int step = 0; step < MOST_STEPS && goes_on; ++step) {
    std::vector<StretchSums> around (vertices);
    for (const Triangle& t : chart.mesh.triangles)
      for (const Index p : t)
        around[p].add ({chart.positions[t[0]], chart.positions[t[1]], chart.positions[t[2]]},
                       {uv[t[0]], uv[t[1]], uv[t[2]]});
    for (std::size_t i = 0; i < weights.size (); ++i)
      weights[i] /= around[neighbors.ids[i]].absolute ();
    std::vector<Vector2d> next = layOut ();
    const double next_stretch = meanStretch (chart, next);
    if (!(next_stretch < stretch))
      break;
    goes_on = next_stretch < LEAST_PROGRESS * stretch;
    uv = std::move (next);
    stretch = next_stretch;
  }
  return uv;
}

bool
untangle (const MeshPiece& chart, const RunContext& run, std::vector<Vector2d>& uv)
{
  constexpr int ROUNDS_AT_MOST = 60; // remaining defects are wider than 30 triangles and no details
  // Moved are vertices of flipped triangles and some rings around them: one, plus one after this many
  // rounds. A patch by means of neighbours is upright if the polygon around it is convex (Tutte 1963);
  // a wider patch mostly has a better one.
  constexpr int ROUNDS_PER_RING = 4;
  constexpr int SWEEPS = 4;            // over these vertices in a round
  constexpr double MOST_FLIPPED = 0.2; // share of flipped triangles; above, the whole is flipped
  constexpr double EAR_HEIGHT = 0.2; // of a triangle with two edges on the boundary, over its base
  const std::vector<Triangle>& triangles = chart.mesh.triangles;
  const MeshRings rings (chart.mesh);
  const auto targetOf = [&] (Index p) -> Vector2d {
    const Vector2d mean = rings.meanAround (uv, p);
    if (rings.before[p] == NONE || rings.leaving.row (p).size () > 1)
      return mean;
    // A vertex of one triangle lies to the right of the way from the one before to the one after.
    const Vector2d way = uv[rings.after[p]] - uv[rings.before[p]];
    return mean + EAR_HEIGHT * Vector2d (way.y (), -way.x ());
  };
  std::vector<Index> moved;
  for (int round = 0; round < ROUNDS_AT_MOST; ++round) {
    run.poll ();
    std::vector<Index> bad; // vertices of flipped triangles, then those around
    Flags is_bad (uv.size (), 0);
    const auto add = [&] (const Triangle& t) {
      for (const Index p : t)
        if (is_bad[p] == 0) {
          is_bad[p] = 1;
          bad.push_back (p);
        }
    };
    std::size_t flipped = 0;
    for (const Triangle& t : triangles)
      if (!(cross (uv[t[1]] - uv[t[0]], uv[t[2]] - uv[t[0]]) > 0.0)) {
        ++flipped;
        add (t);
      }
    if (flipped == 0)
      return true;
    if (static_cast<double> (flipped) > MOST_FLIPPED * static_cast<double> (triangles.size ()))
      return false;
    for (int ring = 0; ring < 1 + round / ROUNDS_PER_RING; ++ring)
      // NOLINTNEXTLINE(modernize-loop-convert): they become more
      for (std::size_t i = 0, size = bad.size (); i < size; ++i)
        for (const Index id : rings.leaving.row (bad[i]))
          add (triangles[id / 3]);
    moved.insert (moved.end (), bad.begin (), bad.end ());
    sortUnique (moved);
    for (int sweep = 0; sweep < SWEEPS; ++sweep)
      for (const Index p : moved)
        uv[p] = targetOf (p);
  }
  return false;
}

ChartLayout
layOutChart (const std::vector<Triangle>& triangles, std::vector<Index> chart_triangles,
             const Positions& positions, const DescentLimits& limits, const RunContext& run)
{
  run.poll ();
  ChartLayout layout;
  layout.chart = cutOut (triangles, chart_triangles, positions);
  layout.triangles = std::move (chart_triangles);
  if (layout.chart.loop.empty ())
    return layout;
  const RestShapes rest = makeRestShapes (layout.chart);
  if (layout.triangles.size () == 1) {
    const Eigen::Matrix2d edges = rest.shapes.front ().to_unit.inverse ();
    const Triangle& corners = layout.chart.mesh.triangles.front ();
    layout.uv.assign (3, Vector2d::Zero ());
    layout.uv[corners[1]] = edges.col (0);
    layout.uv[corners[2]] = edges.col (1);
  }
  else
    layout.uv = beginLayout (layout.chart, limits, run);
  if (!layout.uv.empty ())
    relax (rest, limits, run, layout);
  return layout;
}

void
refineLayout (const Positions& positions, const DescentLimits& limits, const RunContext& run,
              ChartLayout& layout)
{
  layout.chart.positions = valuesAt (positions, layout.chart.points);
  relax (makeRestShapes (layout.chart), limits, run, layout);
}

} // namespace pcl::floater
