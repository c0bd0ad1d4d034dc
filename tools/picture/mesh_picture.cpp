// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_picture.h"

#include "canvas.h"
#include "mesh_view.h"

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
constexpr std::size_t SUPERSAMPLING = 2;        // pixels drawn per pixel, in each direction
constexpr std::size_t MOST_DRAWN_EDGES = 15000; // triangles of a shaded mesh up to which edges show
constexpr int COLOUR_STEP = 5;                  // of 256 levels of each colour
constexpr int BOUNDARY_WIDTH = 4, EDGE_WIDTH = 1; // pixels drawn
constexpr double LIFT = 3.0;                      // pixels drawn

const Colour FRONT{0.56, 0.69, 0.85}, BACK{0.93, 0.66, 0.40}, BOUNDARY{0.83, 0.06, 0.13},
    EDGE{0.18, 0.27, 0.40};

// \param lift in pixels, by which lines on a surface are nearer than that
std::vector<Spot>
project (const std::vector<Eigen::Vector3d>& points, const Camera& camera, const Canvas& canvas,
         double lift = 0.0)
{
  std::vector<Spot> spots;
  spots.reserve (points.size ());
  for (const Eigen::Vector3d& point : points) {
    spots.push_back (camera.project (point, canvas.side ()));
    spots.back ().nearness += lift * 2.0 * camera.half_side / canvas.side () * spots.back ().weight;
  }
  return spots;
}

// \param opacity of the edges of all triangles; those of the boundary are opaque
void
drawEdges (Canvas& canvas, const std::vector<Spot>& spots, const Triangles& triangles,
           double opacity)
{
  constexpr unsigned HALF = 32; // of the bits of an edge: the lower and the higher of its vertices
  std::vector<std::uint64_t> edges;
  edges.reserve (3 * triangles.size ());
  for (const auto& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax (triangle[i], triangle[(i + 1) % 3]);
      edges.push_back (std::uint64_t{low} << HALF | high);
    }
  const auto draw = [&] (std::uint64_t edge, int width, const Colour& colour, double its_opacity) {
    canvas.drawLine (spots[edge >> HALF], spots[static_cast<std::uint32_t> (edge)], width, colour,
                     its_opacity);
  };
  if (opacity > 0.0)
    for (const std::uint64_t edge : edges)
      draw (edge, EDGE_WIDTH, EDGE, opacity);
  // Those that one triangle has.
  std::sort (edges.begin (), edges.end ());
  for (auto edge = edges.begin (), next = edge; edge != edges.end (); edge = next) {
    next =
        std::find_if (edge, edges.end (), [edge] (std::uint64_t other) { return other != *edge; });
    if (next - edge == 1)
      draw (*edge, BOUNDARY_WIDTH, BOUNDARY, 1.0);
  }
}

bool
edgesShow (const PictureMesh& mesh)
{
  return mesh.triangles.size () <= MOST_DRAWN_EDGES;
}

// One light over the left shoulder of the viewer, and a weaker one from the lower right.
double
brightness (const Eigen::Vector3d& normal)
{
  static const Eigen::Vector3d LEFT = 0.9 * Eigen::Vector3d (-0.8, 1.0, 1.0).normalized (),
                               RIGHT = 0.55 * Eigen::Vector3d (1.0, -0.6, 0.8).normalized ();
  return std::max (normal.dot (LEFT), 0.0) + std::max (normal.dot (RIGHT), 0.0);
}

enum class Shading
{
  NONE,
  FLAT,
  SMOOTH
};

// \param texture or nullptr: front and back sides have their colours
void
drawTriangles (Canvas& canvas, const PictureMesh& mesh, const Camera& camera, const Mipmap* texture,
               Shading shading)
{
  const std::vector<Spot> spots = project (mesh.points, camera, canvas);
  // As the camera sees them: unit normals of triangles, and their sums around the vertices.
  std::vector<Eigen::Vector3d> normals, sums (mesh.points.size (), Eigen::Vector3d::Zero ());
  normals.reserve (mesh.triangles.size ());
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.points[triangle[0]];
    normals.emplace_back (
        camera.axes *
        (mesh.points[triangle[1]] - a).cross (mesh.points[triangle[2]] - a).normalized ());
    for (const std::uint32_t corner : triangle)
      sums[corner] += normals.back ();
  }
  for (Eigen::Vector3d& sum : sums)
    sum.normalize ();
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    const auto& triangle = mesh.triangles[t];
    const std::array<Spot, 3> corners{spots[triangle[0]], spots[triangle[1]], spots[triangle[2]]};
    const auto mean = [&triangle] (const auto& values, const Eigen::Vector3d& shares) {
      return (shares[0] * values[triangle[0]] + shares[1] * values[triangle[1]] +
              shares[2] * values[triangle[2]])
          .eval ();
    };
    double level = 0.0;
    if (texture != nullptr)
      level = texture->level ({mesh.coordinates[triangle[0]], mesh.coordinates[triangle[1]],
                               mesh.coordinates[triangle[2]]},
                              corners);
    const double side = Canvas::signedArea (corners) < 0.0 ? 1.0 : -1.0;
    canvas.fill (corners, [&] (const Eigen::Vector3d& shares) -> Colour {
      Colour colour = side > 0.0 ? FRONT : BACK;
      if (texture != nullptr)
        colour = texture->colour (mean (mesh.coordinates, shares), level);
      if (shading == Shading::NONE)
        return colour;
      const Eigen::Vector3d normal =
          shading == Shading::FLAT ? normals[t] : mean (sums, shares).normalized ();
      return (brightness (side * normal) * colour).cwiseMin (1.0);
    });
  }
  if (texture == nullptr)
    drawEdges (canvas, project (mesh.points, camera, canvas, LIFT), mesh.triangles,
               edgesShow (mesh) ? 1.0 : 0.0);
}

// Rounds the colours, which is invisible and makes the file a third smaller.
void
coarsenColours (ColourImage& image)
{
  for (ColourImage::Pixel& pixel : image.pixels)
    for (std::uint8_t& value : pixel)
      value = static_cast<std::uint8_t> (
          std::min (255, (value + COLOUR_STEP / 2) / COLOUR_STEP * COLOUR_STEP));
}

} // namespace

ColourImage
makeCheckerboard ()
{
  constexpr std::size_t SQUARES = 32, FIELDS = 8, PIXELS = 32; // pixels along a square
  constexpr std::size_t SIDE = SQUARES * PIXELS, FIELD = SIDE / FIELDS;
  ColourImage image{SIDE, SIDE, {}};
  for (std::size_t row = 0; row < SIDE; ++row)
    for (std::size_t x = 0; x < SIDE; ++x) {
      const std::size_t y = SIDE - 1 - row, column = x / FIELD, line = y / FIELD; // of fields
      const double right = static_cast<double> (column) / (FIELDS - 1);
      const double up = static_cast<double> (line) / (FIELDS - 1);
      const double shade = 255.0 * ((x / PIXELS + y / PIXELS) % 2 != 0 ? 0.45 : 1.0);
      image.pixels.push_back ({static_cast<std::uint8_t> (shade * (0.35 + 0.65 * right)),
                               static_cast<std::uint8_t> (shade * (0.35 + 0.65 * up)),
                               static_cast<std::uint8_t> (shade * (1.0 - 0.25 * (right + up)))});
    }
  return image;
}

ColourImage
drawMesh (PictureMesh mesh, std::size_t height, const PictureOptions& options)
{
  const View from_above{Eigen::Vector3d::UnitZ (), Eigen::Vector3d::UnitY ()};
  const bool has_two_panels = options.parameterization || options.texture;
  ColourImage image{has_two_panels ? 2 * height : height, height, {}};
  image.pixels.resize (image.width * image.height);
  std::optional<Mipmap> texture;
  if (options.texture)
    texture.emplace (*options.texture);

  Canvas canvas (SUPERSAMPLING * height);
  std::optional<Camera> camera;
  if (options.viewpoint)
    camera = aimFromViewpoint (mesh.scale * (*options.viewpoint - mesh.centre), mesh.points);
  if (!camera)
    camera = aimCamera (chooseView (mesh), mesh.points);
  drawTriangles (canvas, mesh, *camera, texture ? &*texture : nullptr,
                 options.flat_shading ? Shading::FLAT : Shading::SMOOTH);
  canvas.copyTo (image, 0);

  canvas = Canvas (SUPERSAMPLING * height);
  if (texture) {
    for (std::size_t i = 0; i < mesh.points.size (); ++i)
      mesh.points[i] << mesh.coordinates[i], 0.0;
    drawTriangles (canvas, mesh,
                   aimCamera (from_above, {Eigen::Vector3d::Zero (), Eigen::Vector3d::Ones ()}),
                   &*texture, Shading::NONE);
  }
  else if (options.parameterization) {
    const PictureMesh& flat = *options.parameterization;
    const std::vector<Spot> spots =
        project (flat.points, aimCamera (from_above, flat.points), canvas);
    drawEdges (canvas, spots, flat.triangles, edgesShow (flat) ? 1.0 : 0.2);
  }
  if (has_two_panels)
    canvas.copyTo (image, height);
  coarsenColours (image);
  return image;
}

} // namespace pcl::floater
