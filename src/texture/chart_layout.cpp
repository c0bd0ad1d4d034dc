// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/chart_layout.h"

#include "core/geometry.h"
#include "texture/convex_layout.h"
#include "texture/stretch.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
  normal.normalize ();
  const Eigen::Vector3d u = normal.unitOrthogonal (), v = normal.cross (u);
  std::vector<Eigen::Vector2d> uv;
  uv.reserve (chart.positions.size ());
  for (const Eigen::Vector3d& p : chart.positions)
    uv.emplace_back (u.dot (p - middle), v.dot (p - middle));
  return uv;
}

// Measures the mean stretch, and the median by area.
void
measure (const ChartMesh& chart, const std::vector<Eigen::Vector2d>& uv, ChartLayout& layout)
{
  StretchSums sums;
  std::vector<std::pair<double, double>> by_stretch; // squared stretch, area
  for (const Triangle& t : chart.mesh.triangles) {
    StretchSums one;
    one.add ({chart.positions[t[0]], chart.positions[t[1]], chart.positions[t[2]]},
             {uv[t[0]], uv[t[1]], uv[t[2]]});
    sums.add (one);
    if (one.area () > 0.0)
      by_stretch.emplace_back (one.meanSquare (), one.area ());
  }
  layout.stretch = layout.median_stretch = sums.mean ();
  std::sort (by_stretch.begin (), by_stretch.end ());
  double area = 0.0;
  for (const auto& [square, of_one] : by_stretch)
    if ((area += of_one) >= 0.5 * sums.area ()) {
      layout.median_stretch = std::sqrt (square * sums.planeArea () / sums.area ());
      break;
    }
}

// The first valid layout of: the projection; the projection with small defects repaired; its
// boundary, with convex combinations inside; a convex-combination map on the circle. Otherwise
// empty.
std::vector<Eigen::Vector2d>
beginLayout (const ChartMesh& chart, const RestShapes& rest, const DescentLimits& limits,
             const RunContext& run)
{
  std::vector<Eigen::Vector2d> uv = project (chart);
  const bool is_simple = isSimple (chart.loop, uv);
  if (is_simple && isUpright (chart.mesh.triangles, uv))
    return uv;
  std::vector<Eigen::Vector2d> mended = uv;
  if (untangle (chart, {}, run, mended) && isLayout (chart, mended))
    return mended;
  if (is_simple) {
    if (layOutWithin (chart, run, uv) && isUpright (chart.mesh.triangles, uv))
      return uv;
  }
  if (chart.mesh.triangles.size () > limits.most_on_circle)
    return {};
  uv = layOutOnCircle (chart, rest, run).uv;
  return !uv.empty () && isLayout (chart, uv) ? uv : std::vector<Eigen::Vector2d> ();
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
  if (!chart.loop.empty ()) {
    const RestShapes rest = makeRestShapes (chart);
    layout.area = rest.area;
    std::vector<Eigen::Vector2d> uv = beginLayout (chart, rest, limits, run);
    if (!uv.empty ()) {
      std::vector<Eigen::Vector2d> even = uv;
      descendDistortion (chart, rest, limits, run, even);
      if (isLayout (chart, even))
        uv = std::move (even);
      measure (chart, uv, layout);
      layout.uv = std::move (uv);
    }
  }
  layout.points = std::move (chart.points);
  layout.corners = std::move (chart.mesh.triangles);
  layout.loop = std::move (chart.loop);
  return layout;
}

ChartLayout
layOutTriangle (const std::vector<Triangle>& triangles, Index triangle,
                const std::vector<Eigen::Vector3d>& positions)
{
  constexpr double LEAST = 1.0 / 16.0; // height over length
  const Triangle& corners = triangles[triangle];
  ChartLayout layout;
  layout.triangles = {triangle};
  layout.points.assign (corners.begin (), corners.end ());
  std::sort (layout.points.begin (), layout.points.end ());
  layout.uv.resize (3);
  std::array<Index, 3> place{};
  for (std::size_t i = 0; i < 3; ++i)
    place[i] =
        static_cast<Index> (std::find (layout.points.begin (), layout.points.end (), corners[i]) -
                            layout.points.begin ());
  layout.corners = {place};
  layout.loop.assign (place.begin (), place.end ());
  std::size_t from = 0;
  const auto edge = [&] (std::size_t i) -> Eigen::Vector3d {
    return positions[corners[(i + 1) % 3]] - positions[corners[i % 3]];
  };
  for (const std::size_t i : {1, 2})
    if (edge (i).norm () > edge (from).norm ())
      from = i;
  const double base = std::max (edge (from).norm (), std::numeric_limits<double>::min ());
  const Eigen::Vector3d along = edge (from) / base, up = -edge (from + 2);
  const double height = std::max (along.cross (up).norm (), LEAST * base);
  layout.uv[place[from]] = {0.0, 0.0};
  layout.uv[place[(from + 1) % 3]] = {1.0, 0.0};
  layout.uv[place[(from + 2) % 3]] = {along.dot (up) / base, height / base};
  layout.area = 0.5 * base * height;
  return layout;
}

bool
refineLayout (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& positions,
              const DescentLimits& limits, const RunContext& run, ChartLayout& layout)
{
  const ChartMesh chart = makeChartMesh (triangles, layout.triangles, positions);
  const RestShapes rest = makeRestShapes (chart);
  std::vector<Eigen::Vector2d> uv = layout.uv;
  ChartLayout refined;
  measure (chart, uv, refined);
  const double before = refined.stretch;
  descendDistortion (chart, rest, limits, run, uv);
  if (!isLayout (chart, uv))
    return false;
  measure (chart, uv, refined);
  if (!(refined.stretch < before))
    return false;
  layout.uv = std::move (uv);
  layout.area = rest.area;
  layout.stretch = refined.stretch;
  layout.median_stretch = refined.median_stretch;
  return true;
}

} // namespace pcl::floater
