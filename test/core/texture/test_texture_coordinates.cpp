// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The whole way from a mesh to its texture coordinates, on surfaces of all kinds. What must hold of
// all texture coordinates is checked without any code of the texture stage.
#include "mesh/known_meshes.h"
#include "mesh/self_intersections.h"
#include "texture/chart_mesh.h"

#include <pcl/surface/floater/texture_coordinates.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <sstream>

namespace pcl::floater {
namespace {
using namespace samples;
using Edge = std::pair<Index, Index>;

double
distance (const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  const Eigen::Vector2d along = b - a;
  const double t = along.squaredNorm () > 0.0
                       ? std::clamp ((p - a).dot (along) / along.squaredNorm (), 0.0, 1.0)
                       : 0.0;
  return (a + t * along - p).norm ();
}

// Least distance of two charts, between vertices of one and edges of the other.
double
leastDistance (const TextureCoordinates& texture)
{
  double least = 1.0;
  const auto place = [&texture] (std::size_t t, std::size_t i) -> Eigen::Vector2d {
    return texture.coordinates[texture.corners[t][i % 3]].cast<double> ();
  };
  for (std::size_t t = 0; t < texture.corners.size (); ++t)
    for (std::size_t u = 0; u < texture.corners.size (); ++u)
      for (std::size_t i = 0; i < 9 && texture.charts[t] != texture.charts[u]; ++i)
        least = std::min (least, distance (place (t, i), place (u, i / 3), place (u, i / 3 + 1)));
  return least;
}

void
checkSizes (const std::vector<Triangle>& triangles, const TextureCoordinates& texture,
            std::ostream& flaws)
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
    const MeshTopology topology = topologyOf (members);
    if (!topology.manifold || topology.components != 1 || topology.loops.size () != 1 ||
        topology.euler != 1)
      flaws << "chart " << chart << " of " << members.size () << " triangles is no disc\n";
    if (topologyOf (by_coordinates[chart]).vertices != topology.vertices)
      flaws << "chart " << chart << " is cut open\n";
    vertices += topology.vertices;
  }
  if (vertices != texture.coordinates.size ())
    flaws << "charts share coordinates\n";
  std::map<Edge, Index> sides;
  std::set<Edge> seams, told;
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

// The formula of the stretch is tested on known maps (test_charts.cpp).
void
checkFigures (const Mesh& mesh, const TextureCoordinates& texture, std::ostream& flaws)
{
  std::vector<Eigen::Vector2d> uv;
  for (const Eigen::Vector2f& p : texture.coordinates)
    uv.emplace_back (p.cast<double> ());
  const StretchSums sums = stretchOf (mesh.triangles, mesh.positions, texture.corners, uv);
  const double mean = sums.mean (), largest = sums.largest (), area = sums.planeArea ();
  if (!(std::abs (mean - texture.stretch) < 1e-3 * mean) ||
      !(std::abs (largest - texture.largest_stretch) < 1e-2 * largest))
    flaws << "the stretch is " << mean << " and " << largest << ", not " << texture.stretch
          << " and " << texture.largest_stretch << "\n";
  if (!(std::abs (area - texture.area_used) < 1e-5) || !(texture.area_used <= 1.0))
    flaws << "the area is " << area << ", not " << texture.area_used << "\n";
}

// All that is wrong, one line each: sizes and indices, coordinates out of the square, charts that
// are no disc, triangles that are flipped, overlaps, charts nearer to each other than the gutter,
// seams, figures.
std::string
flawsOf (const Mesh& mesh, const TextureCoordinates& texture)
{
  std::ostringstream flaws;
  if (texture.status != RunStatus::SUCCESS)
    return "it failed: " + texture.message;
  checkSizes (mesh.triangles, texture, flaws);
  if (!flaws.str ().empty ())
    return flaws.str ();
  checkCharts (mesh.triangles, texture, flaws);
  const auto& uv = texture.coordinates;
  const auto place = [&uv] (Index c) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    return Kernel::Point_2 (static_cast<double> (uv[c].x ()), static_cast<double> (uv[c].y ()));
  };
  std::size_t flipped = 0;
  for (const auto& [a, b, c] : texture.corners)
    flipped += CGAL::orientation (place (a), place (b), place (c)) == CGAL::LEFT_TURN ? 0 : 1;
  if (flipped != 0 || texture.flipped != flipped)
    flaws << flipped << " triangles are flipped; told: " << texture.flipped << "\n";
  Positions flat;
  for (const Eigen::Vector2f& p : uv)
    flat.emplace_back (static_cast<double> (p.x ()), static_cast<double> (p.y ()), 0.0);
  const CrossingPairs pairs = findSelfIntersections (texture.corners, flat, 1);
  if (!pairs.empty () || !pairs.untested.empty ())
    flaws << pairs.size () << " pairs of triangles share more than their common corners\n";
  checkFigures (mesh, texture, flaws);
  constexpr std::size_t FEW = 1500; // for all distances
  if (texture.corners.size () < FEW && !(leastDistance (texture) > 0.99 * texture.gutter))
    flaws << "charts are " << leastDistance (texture) << " apart, less than the gutter of "
          << texture.gutter << "\n";
  return flaws.str ();
}

// With nothing wrong with it.
TextureCoordinates
textureOf (const Mesh& mesh, const TextureOptions& options = {})
{
  TextureCoordinates texture = computeTextureCoordinates (mesh.positions, mesh.triangles, options);
  EXPECT_EQ (flawsOf (mesh, texture), "");
  return texture;
}

TEST (TextureCoordinates, PlaneIsOneChartWithoutStretch)
{
  const TextureCoordinates texture = textureOf (sheet (12));
  EXPECT_EQ (texture.chart_count, 1U);
  EXPECT_TRUE (texture.seams.empty ());
  EXPECT_NEAR (texture.stretch, 1.0, 1e-5);
  EXPECT_GT (texture.area_used, 0.97);
}

TEST (TextureCoordinates, ARoofIsCutAtItsRidge)
{
  Mesh roof = sheet (10); // two slopes of 45 degrees
  for (Eigen::Vector3d& p : roof.positions)
    p.z () = -std::abs (p.x () - 0.5);
  const TextureCoordinates texture = textureOf (roof);
  EXPECT_EQ (texture.chart_count, 2U);
  EXPECT_EQ (texture.seams.size (), 10U);
  EXPECT_NEAR (texture.seam_length, 1.0, 1e-9);
  EXPECT_NEAR (texture.stretch, 1.0, 1e-4);
  for (const auto& seam : texture.seams)
    EXPECT_NEAR (roof.positions[seam[0]].z () + roof.positions[seam[1]].z (), 0.0, 1e-9);
}

TEST (TextureCoordinates, TorusAndHolesAndManyComponents)
{
  textureOf (torus (40, 16));
  textureOf (annulus (24));
  Mesh many = tetrahedron ();
  for (int i = 0; i < 30; ++i)
    many = beside (i % 2 == 0 ? sheet (1 + static_cast<Index> (i % 5)) : annulus (5), many);
  const TextureCoordinates texture = textureOf (many);
  EXPECT_GE (texture.chart_count, 31U);
  EXPECT_GT (texture.area_used, 0.4);
}

TEST (TextureCoordinates, DegenerateMeshes)
{
  // A sheet with one point far out of it: the triangles around it stand on edge.
  for (const double height : {1.0, 10.0, 1000.0}) {
    Mesh spike = sheet (10);
    spike.positions[60].z () = height;
    textureOf (spike);
  }
  // Triangles without area, and points in one place.
  Mesh mesh = sheet (6);
  mesh.positions[24] = 0.5 * (mesh.positions[23] + mesh.positions[25]); // on a line
  mesh.positions[10] = mesh.positions[9];
  mesh.positions[3] = mesh.positions[4];
  textureOf (mesh);
  const Mesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  textureOf (line);
  textureOf (beside ({{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}}, line));
  // Points without a triangle have no coordinates.
  mesh = sheet (3);
  mesh.positions.emplace_back (std::nan (""), 0.0, 0.0);
  EXPECT_EQ (textureOf (mesh).coordinates.size (), 16U);
  const TextureCoordinates none = textureOf ({});
  EXPECT_EQ (none.chart_count, 0U);
  EXPECT_EQ (none.stretch, 1.0);
}

// A disc that would be cut, in one piece.
TEST (TextureCoordinates, WholeDiscs)
{
  const Mesh bowl = facing_cases::makeBowl (0.9);
  EXPECT_GT (textureOf (bowl).chart_count, 1U);
  TextureOptions options;
  options.whole_discs = true;
  const TextureCoordinates whole = textureOf (bowl, options);
  EXPECT_EQ (whole.chart_count, 1U);
  EXPECT_LT (whole.stretch, 2.0);
  // What is no disc is cut as always.
  const Mesh ring = torus (30, 12);
  EXPECT_EQ (textureOf (ring, options).coordinates, textureOf (ring).coordinates);
}

// Bodies, shells, terrain, torn sheets: open and closed, of one and of many components.
TEST (TextureCoordinates, OfRandomSurfacesHaveNoFlaw)
{
  for (const facing_cases::Family& family : facing_cases::FAMILIES) {
    SCOPED_TRACE (family.name);
    const Mesh mesh = makeFacingCase (family, 3);
    const TextureCoordinates texture = textureOf (mesh);
    EXPECT_LT (texture.stretch, 1.2);
    EXPECT_LT (texture.chart_count, 20U + mesh.triangles.size () / 20U);
  }
}

TEST (TextureCoordinates, NoiseDoesNotDecideCharts)
{
  for (const double noise : {0.1, 0.3, 1.0}) { // spacings
    SCOPED_TRACE (noise);
    const TextureCoordinates texture = textureOf (noisySheet (40, 0.1 * noise, 7));
    EXPECT_LE (texture.chart_count, 3U);
    EXPECT_LT (texture.stretch, 1.0 + 0.5 * noise);
  }
}

TEST (TextureCoordinates, BadInputIsRefused)
{
  const auto refused = [] (const Mesh& mesh, const TextureOptions& options) {
    const TextureCoordinates texture =
        computeTextureCoordinates (mesh.positions, mesh.triangles, options);
    EXPECT_FALSE (texture.message.empty ());
    EXPECT_TRUE (texture.coordinates.empty ());
    return texture.status;
  };
  const Mesh mesh = sheet (3);
  std::vector<Mesh> bad (5, mesh);
  bad[0].triangles[4][1] = 16;
  bad[1].positions[5].y () = std::numeric_limits<double>::infinity ();
  std::swap (bad[2].triangles[3][0], bad[2].triangles[3][1]); // faces the other way
  bad[3].triangles.push_back (mesh.triangles.front ());
  bad[4].triangles[0] = {2, 2, 3};
  for (std::size_t i = 0; i < bad.size (); ++i)
    EXPECT_EQ (refused (bad[i], {}), RunStatus::INVALID_INDICES) << i;
  std::vector<TextureOptions> options (3);
  options[0].largest_stretch = 0.9;
  options[1].largest_stretch = std::nan ("");
  options[2].threads = -1;
  for (const TextureOptions& one : options)
    EXPECT_EQ (refused (mesh, one), RunStatus::INVALID_OPTION);
}

TEST (TextureCoordinates, ProgressAndCancellation)
{
  const Mesh mesh = torus (40, 16);
  std::vector<double> fractions;
  int calls = 0, last = -1;
  TextureOptions options;
  options.progress_callback = [&] (double fraction) { fractions.push_back (fraction); };
  options.cancelled_callback = [&] { return ++calls == last; };
  textureOf (mesh, options);
  ASSERT_FALSE (fractions.empty ());
  EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
  EXPECT_EQ (fractions.back (), 1.0);
  ASSERT_GT (calls, 0);
  const int all = calls / 2; // another run may ask less often
  for (last = 1; last <= all; last += 1 + all / 5) {
    calls = 0;
    const TextureCoordinates texture =
        computeTextureCoordinates (mesh.positions, mesh.triangles, options);
    EXPECT_EQ (texture.status, RunStatus::CANCELLED);
    EXPECT_TRUE (texture.coordinates.empty ());
  }
  options.cancelled_callback = [] () -> bool { throw std::runtime_error ("broken"); };
  EXPECT_EQ (computeTextureCoordinates (mesh.positions, mesh.triangles, options).status,
             RunStatus::INTERNAL_ERROR);
}

} // namespace
} // namespace pcl::floater
