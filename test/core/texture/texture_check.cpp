// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture_check.h"

#include "mesh_oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <map>
#include <set>
#include <sstream>

namespace pcl::floater::samples {
namespace {
using Corners = std::array<Eigen::Vector2f, 3>;

CGAL::Orientation
turn (const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto place = [] (const Eigen::Vector2f& p) {
    return Kernel::Point_2 (static_cast<double> (p.x ()), static_cast<double> (p.y ()));
  };
  return CGAL::orientation (place (a), place (b), place (c));
}

// Two convex shapes have no inner point in common if an edge of one of them parts them.
bool
isParted (const Corners& a, const Corners& b)
{
  for (std::size_t i = 0; i < 3; ++i)
    if (std::all_of (b.begin (), b.end (), [&] (const Eigen::Vector2f& p) {
          return turn (a[i], a[(i + 1) % 3], p) != CGAL::LEFT_TURN;
        }))
      return true;
  return false;
}

double
distance (const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  const Eigen::Vector2d along = b - a;
  const double t = along.squaredNorm () > 0.0
                       ? std::clamp ((p - a).dot (along) / along.squaredNorm (), 0.0, 1.0)
                       : 0.0;
  return (a + t * along - p).norm ();
}

// Least distance of two charts, between vertices of one and boundary edges of the other.
double
leastDistance (const TextureCoordinates& texture)
{
  std::map<std::pair<Index, Index>, Index> borders; // directed edge: chart
  for (std::size_t t = 0; t < texture.corners.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      borders[{texture.corners[t][i], texture.corners[t][(i + 1) % 3]}] = texture.charts[t];
  for (auto edge = borders.begin (); edge != borders.end ();) {
    const auto mate = borders.find ({edge->first.second, edge->first.first});
    if (mate != borders.end ())
      borders.erase (mate);
    else {
      ++edge;
      continue;
    }
    edge = borders.erase (edge);
  }
  double least = 1.0;
  const auto place = [&texture] (Index c) -> Eigen::Vector2d {
    return texture.coordinates[c].cast<double> ();
  };
  for (const auto& [edge, chart] : borders)
    for (const auto& [other, other_chart] : borders)
      if (chart != other_chart)
        least = std::min (least,
                          distance (place (edge.first), place (other.first), place (other.second)));
  return least;
}

void
checkSizes (const std::vector<Eigen::Vector3d>& positions, const std::vector<Triangle>& triangles,
            const TextureCoordinates& texture, std::ostream& flaws)
{
  if (texture.corners.size () != triangles.size () || texture.charts.size () != triangles.size () ||
      texture.points.size () != texture.coordinates.size ())
    flaws << "sizes\n";
  std::set<Index> used;
  for (std::size_t t = 0; t < triangles.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index c = texture.corners[t][i];
      used.insert (c);
      if (c >= texture.points.size () || texture.points[c] != triangles[t][i])
        flaws << "corner " << i << " of triangle " << t << " is at another point\n";
    }
  if (used.size () != texture.coordinates.size ())
    flaws << "coordinates of no corner\n";
  for (const Eigen::Vector2f& p : texture.coordinates)
    if (!(p.minCoeff () >= 0.0F && p.maxCoeff () <= 1.0F))
      flaws << "(" << p.transpose () << ") is outside\n";
  static_cast<void> (positions);
}

void
checkCharts (const std::vector<Triangle>& triangles, const TextureCoordinates& texture,
             std::ostream& flaws)
{
  std::map<Index, std::vector<Triangle>> charts, by_coordinates;
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    charts[texture.charts[t]].push_back (triangles[t]);
    by_coordinates[texture.charts[t]].push_back (texture.corners[t]);
  }
  if (charts.size () != texture.chart_count ||
      (!charts.empty () && charts.rbegin ()->first + 1 != charts.size ()))
    flaws << "number of charts\n";
  std::size_t vertices = 0;
  for (const auto& [chart, members] : charts) {
    const Topology topology = topologyOf (members);
    if (!topology.manifold || topology.components != 1 || topology.loops.size () != 1 ||
        topology.euler != 1)
      flaws << "chart " << chart << " of " << members.size () << " triangles is no disc\n";
    if (topologyOf (by_coordinates[chart]).vertices != topology.vertices)
      flaws << "chart " << chart << " is cut open\n";
    vertices += topology.vertices;
  }
  if (vertices != texture.coordinates.size ())
    flaws << "charts share coordinates\n";
  std::map<std::pair<Index, Index>, Index> sides;
  std::set<std::pair<Index, Index>> seams, told;
  for (std::size_t t = 0; t < triangles.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      sides[{triangles[t][i], triangles[t][(i + 1) % 3]}] = texture.charts[t];
  for (const auto& [edge, chart] : sides) {
    const auto mate = sides.find ({edge.second, edge.first});
    if (mate != sides.end () && mate->second != chart)
      seams.insert (std::minmax (edge.first, edge.second));
  }
  for (const auto& seam : texture.seams)
    told.insert (std::minmax (seam[0], seam[1]));
  if (seams != told || told.size () != texture.seams.size ())
    flaws << "seams\n";
}

void
checkFigures (const std::vector<Eigen::Vector3d>& positions, const std::vector<Triangle>& triangles,
              const TextureCoordinates& texture, std::ostream& flaws)
{
  // The stretch by the lengths of edges: their squares, weighted by the cotangents of the angles in
  // the plane, are twice the Dirichlet energy of the map.
  double energy = 0.0, area = 0.0, plane_area = 0.0;
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    std::array<Eigen::Vector2d, 3> uv;
    std::array<Eigen::Vector3d, 3> place;
    for (std::size_t i = 0; i < 3; ++i) {
      uv[i] = texture.coordinates[texture.corners[t][i]].cast<double> ();
      place[i] = positions[triangles[t][i]];
    }
    const Eigen::Vector2d a = uv[1] - uv[0], b = uv[2] - uv[0];
    const double in_plane = 0.5 * (a.x () * b.y () - a.y () * b.x ());
    const double in_space = 0.5 * (place[1] - place[0]).cross (place[2] - place[0]).norm ();
    area += in_space;
    plane_area += in_plane;
    double integral = 0.0; // over the triangle in the plane
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d to = uv[(i + 1) % 3] - uv[i], back = uv[(i + 2) % 3] - uv[i];
      integral += to.dot (back) / (2.0 * in_plane) *
                  (place[(i + 1) % 3] - place[(i + 2) % 3]).squaredNorm () / 2.0;
    }
    // Mean square of the singular values, over the triangle in space.
    energy += in_space * 0.5 * integral / in_plane;
  }
  const double stretch = std::sqrt (energy / area * plane_area / area);
  if (area > 0.0 && !(std::abs (stretch - texture.stretch) < 1e-3 * stretch))
    flaws << "the stretch is " << stretch << ", not " << texture.stretch << "\n";
  if (!(std::abs (plane_area - texture.area_used) < 1e-5) || !(texture.area_used <= 1.0))
    flaws << "the area is " << plane_area << ", not " << texture.area_used << "\n";
  if (!(texture.largest_stretch >= texture.stretch * 0.999))
    flaws << "the largest stretch is less than the mean\n";
}

} // namespace

std::size_t
countOverlaps (const std::vector<Corners>& corners)
{
  // By their left ends; triangles that begin beyond the right end of one cannot meet it.
  std::vector<std::size_t> order (corners.size ());
  for (std::size_t i = 0; i < order.size (); ++i)
    order[i] = i;
  const auto left = [&] (std::size_t t) {
    return std::min ({corners[t][0].x (), corners[t][1].x (), corners[t][2].x ()});
  };
  std::sort (order.begin (), order.end (),
             [&] (std::size_t a, std::size_t b) { return left (a) < left (b); });
  std::size_t overlaps = 0;
  for (std::size_t i = 0; i < order.size (); ++i) {
    const Corners& a = corners[order[i]];
    const auto [low, high] = std::minmax ({a[0].y (), a[1].y (), a[2].y ()});
    const float right = std::max ({a[0].x (), a[1].x (), a[2].x ()});
    for (std::size_t j = i + 1; j < order.size () && left (order[j]) < right; ++j) {
      const Corners& b = corners[order[j]];
      if (std::min ({b[0].y (), b[1].y (), b[2].y ()}) < high &&
          std::max ({b[0].y (), b[1].y (), b[2].y ()}) > low && !isParted (a, b) &&
          !isParted (b, a))
        ++overlaps;
    }
  }
  return overlaps;
}

std::string
flawsOfTexture (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Triangle>& triangles, const TextureCoordinates& texture,
                bool with_distances)
{
  std::ostringstream flaws;
  if (texture.status != RunStatus::SUCCESS)
    return "it failed: " + texture.message + "\n";
  checkSizes (positions, triangles, texture, flaws);
  if (!flaws.str ().empty ())
    return flaws.str ();
  checkCharts (triangles, texture, flaws);
  std::vector<Corners> corners;
  std::size_t flipped = 0;
  for (const Triangle& t : texture.corners) {
    corners.push_back (
        {texture.coordinates[t[0]], texture.coordinates[t[1]], texture.coordinates[t[2]]});
    const Corners& c = corners.back ();
    flipped += turn (c[0], c[1], c[2]) == CGAL::LEFT_TURN ? 0 : 1;
  }
  if (flipped != 0 || texture.flipped != flipped)
    flaws << flipped << " triangles are flipped; told: " << texture.flipped << "\n";
  if (const std::size_t overlaps = countOverlaps (corners))
    flaws << overlaps << " overlaps\n";
  checkFigures (positions, triangles, texture, flaws);
  if (with_distances && !(leastDistance (texture) > 0.99 * texture.gutter))
    flaws << "charts are " << leastDistance (texture) << " apart, less than the gutter of "
          << texture.gutter << "\n";
  return flaws.str ();
}

} // namespace pcl::floater::samples
