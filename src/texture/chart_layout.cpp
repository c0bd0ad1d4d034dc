// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/chart_layout.h"

#include "core/geometry.h"
#include "texture/convex_layout.h"
#include "texture/stretch.h"

#include <utility>

namespace pcl::floater {
namespace {
bool
isLayout (const ChartMesh& chart, const std::vector<Eigen::Vector2d>& uv)
{
  return isUpright (chart.mesh.triangles, uv) && isSimple (chart.loop, uv);
}

// Projects the chart, seen from its mean normal.
std::vector<Eigen::Vector2d>
project (const ChartMesh& chart)
{
  Eigen::Vector3d normal = Eigen::Vector3d::Zero (), middle = Eigen::Vector3d::Zero ();
  for (const Triangle& t : chart.mesh.triangles)
    normal += areaVector (chart.positions[t[0]], chart.positions[t[1]], chart.positions[t[2]]);
  for (const Eigen::Vector3d& p : chart.positions)
    middle += p / static_cast<double> (chart.positions.size ());
  const TangentFrame frame (normal.normalized ());
  std::vector<Eigen::Vector2d> uv;
  uv.reserve (chart.positions.size ());
  for (const Eigen::Vector3d& p : chart.positions)
    uv.push_back (frame.project (p - middle));
  return uv;
}

double
meanStretch (const ChartMesh& chart, const std::vector<Eigen::Vector2d>& uv)
{
  const std::vector<Triangle>& triangles = chart.mesh.triangles;
  return stretchOf (triangles, chart.positions, triangles, uv).mean ();
}

// The first valid layout of: the projection; the projection with small defects repaired; a
// convex-combination map on the circle. Otherwise empty.
std::vector<Eigen::Vector2d>
beginLayout (const ChartMesh& chart, const RestShapes& rest, const DescentLimits& limits,
             const RunContext& run)
{
  std::vector<Eigen::Vector2d> uv = project (chart);
  if (isLayout (chart, uv) || (untangle (chart, run, uv) && isLayout (chart, uv)))
    return uv;
  if (chart.mesh.triangles.size () > limits.most_on_circle)
    return {};
  uv = layOutOnCircle (chart, rest, run);
  return !uv.empty () && isLayout (chart, uv) ? uv : std::vector<Eigen::Vector2d> ();
}

// Lowers the distortion of a layout, unless that raises its stretch; sets its figures.
void
relax (const ChartMesh& chart, const RestShapes& rest, const DescentLimits& limits,
       const RunContext& run, ChartLayout& layout)
{
  layout.area = rest.area;
  layout.stretch = meanStretch (chart, layout.uv);
  std::vector<Eigen::Vector2d> uv = layout.uv;
  descendDistortion (chart, rest, limits, run, uv);
  if (!isLayout (chart, uv))
    return;
  if (const double stretch = meanStretch (chart, uv); stretch < layout.stretch) {
    layout.stretch = stretch;
    layout.uv = std::move (uv);
  }
}

// Lays one triangle out by the lengths of its edges.
void
layOutTriangle (const ChartMesh& chart, ChartLayout& layout)
{
  constexpr double LEAST_HEIGHT_ALONE = 1.0 / 16.0;
  const Triangle& c = chart.mesh.triangles.front ();
  const FlatTriangle flat = layFlat (
      {chart.positions[c[0]], chart.positions[c[1]], chart.positions[c[2]]}, LEAST_HEIGHT_ALONE);
  layout.uv.resize (3);
  for (std::size_t i = 0; i < 3; ++i)
    layout.uv[c[i]] = flat.corners[i];
  layout.stretch = meanStretch (chart, layout.uv);
  layout.area = 0.5 * flat.longest * flat.longest *
                cross (flat.corners[1] - flat.corners[0], flat.corners[2] - flat.corners[0]);
}

} // namespace

ChartLayout
layOutChart (const std::vector<Triangle>& triangles, std::vector<Index> chart_triangles,
             const std::vector<Eigen::Vector3d>& positions, const DescentLimits& limits,
             const RunContext& run)
{
  run.poll ();
  ChartLayout layout;
  ChartMesh chart = makeChartMesh (triangles, chart_triangles, positions);
  layout.triangles = std::move (chart_triangles);
  if (layout.triangles.size () == 1)
    layOutTriangle (chart, layout);
  else if (!chart.loop.empty ()) {
    const RestShapes rest = makeRestShapes (chart);
    layout.area = rest.area;
    layout.uv = beginLayout (chart, rest, limits, run);
    if (!layout.uv.empty ())
      relax (chart, rest, limits, run, layout);
  }
  layout.points = std::move (chart.points);
  layout.corners = std::move (chart.mesh.triangles);
  layout.loop = std::move (chart.loop);
  return layout;
}

void
refineLayout (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& positions,
              const DescentLimits& limits, const RunContext& run, ChartLayout& layout)
{
  const ChartMesh chart = makeChartMesh (triangles, layout.triangles, positions);
  relax (chart, makeRestShapes (chart), limits, run, layout);
}

} // namespace pcl::floater
