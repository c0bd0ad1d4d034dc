// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a mesh and of its parameterization, side by side.
#pragma once

#include "canvas.h"
#include "cloud_reader.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace pcl::floater {
/// A mesh with the vertices that its triangles use. They are moved to the origin, and scaled so
/// that the longest side of their box is 2.
struct PictureMesh
{
  std::vector<Eigen::Vector3d> points;
  Triangles triangles;                      ///< at least one
  std::vector<Eigen::Vector2d> coordinates; ///< of a texture, parallel to the points; may be empty
  Eigen::Vector3d centre;                   ///< what has become the origin
  double scale;                             ///< factor
};

/// Reads a mesh from a .vtk or .ply file, with texture coordinates if it has some. Triangles with a
/// vertex that is not finite are left out.
/// \throw ReadError if it cannot be read or has no triangles
inline PictureMesh
readPictureMesh (const std::filesystem::path& path)
{
  const std::string extension = lowerExtension (path);
  if (extension != ".vtk" && extension != ".ply")
    throw ReadError ("its extension must be .vtk or .ply");
  PictureMesh mesh;
  ReadOptions options;
  options.faces = &mesh.triangles;
  Cloud cloud = cloudFormatOf (path) (FileBytes (path), options);
  removeNonFinitePoints (cloud, mesh.triangles);
  if (mesh.triangles.empty ())
    throw ReadError ("it has no polygons");
  const Field *s = cloud.find ("s"), *t = cloud.find ("t");
  Eigen::AlignedBox3d box;
  for (const std::uint32_t point : takeUsed (cloud.size (), mesh.triangles)) {
    const std::size_t row = cloud.row (point);
    box.extend (mesh.points.emplace_back (cloud.positionOfRow (row)));
    if (s != nullptr && t != nullptr)
      mesh.coordinates.emplace_back (std::fmax (0.0, std::fmin (s->asDouble (row), 1.0)),
                                     std::fmax (0.0, std::fmin (t->asDouble (row), 1.0)));
  }
  // Halves, because the size of the largest numbers overflows.
  mesh.centre = 0.5 * box.min () + 0.5 * box.max ();
  mesh.scale = 1.0 / (0.5 * box.max () - 0.5 * box.min ()).maxCoeff ();
  if (!std::isfinite (mesh.scale))
    mesh.scale = 1.0;
  for (Eigen::Vector3d& point : mesh.points)
    point = mesh.scale * (point - mesh.centre);
  return mesh;
}

using View = std::array<Eigen::Vector3d, 2>; ///< unit vectors: towards the viewer, and up

/// Where points are on a canvas.
struct Camera
{
  Eigen::Matrix3d axes;   ///< its rows are right, up and towards the viewer
  Eigen::Vector3d origin; ///< the middle of the picture; in perspective, the viewer
  double half_side;       ///< of the picture; in perspective, at the distance 1
  bool is_perspective;
};

constexpr double MARGIN = 1.06; // side of the picture over that of the mesh in it
constexpr double DEGREE = 3.14159265358979323846 / 180.0;
constexpr double CLOSED = 1e-3;         // a mesh with a shorter mean normal counts as closed
constexpr double ONE_SIDED = 0.55;      // a mesh with a longer mean normal faces one way ...
constexpr double SHEET = 0.8;           // ... and is a sheet if it is longer than this
constexpr double NEARLY_PARALLEL = 0.8; // cosine
constexpr double SMALLEST = 1e-9;       // half of the side of a picture
constexpr double TIP_BACK = 50.0, FROM_ABOVE = 15.0, TURN = 20.0; // degrees

inline Eigen::Map<const Eigen::Matrix3Xd>
asColumns (const std::vector<Eigen::Vector3d>& points)
{
  return {points[0].data (), 3, static_cast<Eigen::Index> (points.size ())};
}

// Mean of the unit normals, weighted by area, on the outer side if the surface bulges. The longer
// it is, the more of the mesh faces one way.
inline Eigen::Vector3d
meanNormal (const PictureMesh& mesh)
{
  const Eigen::Vector3d centre = asColumns (mesh.points).rowwise ().mean ();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero ();
  double area = 0.0, volume = 0.0; // twice the area, six times the volume seen from the centre
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& corner = mesh.points[a];
    const Eigen::Vector3d normal = (mesh.points[b] - corner).cross (mesh.points[c] - corner);
    sum += normal;
    area += normal.norm ();
    volume += normal.dot (corner - centre);
  }
  if (!(area > 0.0))
    return Eigen::Vector3d::Zero ();
  return (volume < 0.0 && sum.norm () < SHEET * area ? -1.0 : 1.0) / area * sum;
}

inline Camera
lookAlong (const View& view)
{
  const auto& [back, up] = view;
  const Eigen::Vector3d right = up.cross (back).normalized ();
  Camera camera{};
  camera.axes << right.transpose (), back.cross (right).normalized ().transpose (),
      back.transpose ();
  return camera;
}

/// A mesh that faces one way is seen from there, and a sheet is tipped back; up is y, as in scans,
/// or z. A mesh that faces all ways is seen along its axis of least variance; if it is open, its
/// opening is below, because the mean normal points away from it.
inline View
chooseView (const PictureMesh& mesh)
{
  const Eigen::Vector3d normal = meanNormal (mesh);
  Eigen::Vector3d facing = normal.normalized (), up = Eigen::Vector3d::UnitY ();
  if (normal.norm () <= ONE_SIDED) {
    const auto points = asColumns (mesh.points);
    const Eigen::Matrix3Xd around = points.colwise () - points.rowwise ().mean ();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver (around * around.transpose ());
    facing = solver.eigenvectors ().col (0); // the axis of least variance
    facing *= facing.sum () < 0.0 ? -1.0 : 1.0;
    if (normal.norm () > CLOSED)
      up = normal.normalized ();
  }
  if (std::abs (facing.dot (up)) > NEARLY_PARALLEL)
    (normal.norm () <= ONE_SIDED ? facing : up) = Eigen::Vector3d::UnitZ ();
  if (std::abs (facing.dot (up)) > NEARLY_PARALLEL)
    facing = up.unitOrthogonal ();

  const Eigen::Vector3d right = up.cross (facing).normalized ();
  facing = right.cross (up);
  const double tilt = normal.norm () > SHEET ? TIP_BACK : -FROM_ABOVE;
  const Eigen::Vector3d tilted = Eigen::AngleAxisd (tilt * DEGREE, right) * facing;
  return {Eigen::AngleAxisd (TURN * DEGREE, up) * tilted, up};
}

inline Camera
aimCamera (const View& view, const std::vector<Eigen::Vector3d>& points)
{
  Camera camera = lookAlong (view);
  const Eigen::Matrix3Xd seen = camera.axes * asColumns (points);
  const Eigen::AlignedBox3d box (seen.rowwise ().minCoeff (), seen.rowwise ().maxCoeff ());
  camera.origin = camera.axes.transpose () * box.center ();
  camera.half_side = 0.5 * MARGIN * std::max ({box.sizes ().x (), box.sizes ().y (), SMALLEST});
  return camera;
}

/// Perspective from a viewpoint, along the mean direction to the points. Up is z; where that is
/// nearly the direction, y, or -y as in depth cameras if they look along z.
/// \return nothing if not all points are within 60 degrees of that direction
inline std::optional<Camera>
aimFromViewpoint (const Eigen::Vector3d& viewpoint, const std::vector<Eigen::Vector3d>& points)
{
  constexpr double WIDEST = 60.0, ALONG_Z = 0.8; // degrees on either side; a cosine
  const Eigen::Matrix3Xd rays =
      (asColumns (points).colwise () - viewpoint).colwise ().normalized ();
  const Eigen::Vector3d mean = rays.rowwise ().sum ().normalized ();
  const double least = (mean.transpose () * rays).minCoeff ();
  if (!(least > std::cos (WIDEST * DEGREE)))
    return std::nullopt;
  const Eigen::Vector3d up = std::abs (mean.z ()) > ALONG_Z
                                 ? Eigen::Vector3d (0.0, mean.z () > 0.0 ? -1.0 : 1.0, 0.0)
                                 : Eigen::Vector3d::UnitZ ();
  Camera camera = lookAlong ({-mean, up});
  camera.origin = viewpoint;
  camera.half_side = std::max (std::sqrt (1.0 - least * least) / least, SMALLEST);
  camera.is_perspective = true;
  return camera;
}

constexpr std::size_t MOST_DRAWN_EDGES = 15000; // triangles of a shaded mesh up to which edges show
constexpr int BOUNDARY_WIDTH = 4, EDGE_WIDTH = 1; // pixels drawn
constexpr double LIFT = 3.0;                      // pixels drawn

inline const Colour FRONT{0.56, 0.69, 0.85}, BACK{0.93, 0.66, 0.40}, BOUNDARY{0.83, 0.06, 0.13},
    EDGE{0.18, 0.27, 0.40};

// \param lift in pixels, by which lines on a surface are nearer than that
inline std::vector<Spot>
project (const std::vector<Eigen::Vector3d>& points, const Camera& camera, const Canvas& canvas,
         double lift = 0.0)
{
  const double side = canvas.side ();
  std::vector<Spot> spots;
  spots.reserve (points.size ());
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = camera.axes * (point - camera.origin);
    const double weight = camera.is_perspective ? -1.0 / p.z () : 1.0;
    const double pixels = 0.5 * side / camera.half_side * weight;
    const double nearness = camera.is_perspective ? weight : p.z ();
    spots.push_back ({{0.5 * side + pixels * p.x (), 0.5 * side - pixels * p.y ()},
                      nearness + lift * 2.0 * camera.half_side / side * weight,
                      weight});
  }
  return spots;
}

// \param opacity of the edges of all triangles; those of the boundary are opaque
inline void
drawEdges (Canvas& canvas, const std::vector<Spot>& spots, const Triangles& triangles,
           double opacity)
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges; // the lower and the higher vertex
  edges.reserve (3 * triangles.size ());
  for (const auto& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.emplace_back (std::minmax (triangle[i], triangle[(i + 1) % 3]));
  if (opacity > 0.0)
    for (const auto& [a, b] : edges)
      canvas.drawLine (spots[a], spots[b], EDGE_WIDTH, EDGE, opacity);
  // Those that one triangle has.
  std::sort (edges.begin (), edges.end ());
  for (auto edge = edges.begin (), next = edge; edge != edges.end (); edge = next) {
    next = std::find_if (edge, edges.end (), [edge] (const auto& other) { return other != *edge; });
    if (next - edge == 1)
      canvas.drawLine (spots[edge->first], spots[edge->second], BOUNDARY_WIDTH, BOUNDARY, 1.0);
  }
}

// One light over the left shoulder of the viewer, and a weaker one from the lower right.
inline const Eigen::Vector3d LEFT = 0.9 * Eigen::Vector3d (-0.8, 1.0, 1.0).normalized (),
                             RIGHT = 0.55 * Eigen::Vector3d (1.0, -0.6, 0.8).normalized ();

enum class Shading
{
  NONE,
  FLAT,
  SMOOTH
};

// \param texture by texture coordinates; without one, front and back sides have their colours
inline void
drawTriangles (Canvas& canvas, const PictureMesh& mesh, const Camera& camera,
               std::optional<ColourImage> texture, Shading shading)
{
  const std::vector<Spot> spots = project (mesh.points, camera, canvas);
  if (texture) {
    double on_canvas = 0.0, in_image = 0.0; // areas, in pixels
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector2d u = mesh.coordinates[b] - mesh.coordinates[a],
                            v = mesh.coordinates[c] - mesh.coordinates[a];
      on_canvas += std::abs (Canvas::signedArea ({spots[a], spots[b], spots[c]}));
      in_image += std::abs (u.x () * v.y () - u.y () * v.x ()) *
                  static_cast<double> (texture->pixels.size ());
    }
    // Its pixels become about as large as those of the canvas, so that none is passed over.
    constexpr double MOST = 1.5; // in one of the canvas, along a side
    double pixels = on_canvas > 0.0 ? std::sqrt (in_image / on_canvas) : 1.0;
    for (; pixels > MOST && std::min (texture->width, texture->height) > 1; pixels /= 2.0)
      texture = halved (*texture);
  }
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
    const double side = Canvas::signedArea (corners) < 0.0 ? 1.0 : -1.0;
    canvas.fill (corners, [&] (const Eigen::Vector3d& shares) -> Colour {
      Colour colour = side > 0.0 ? FRONT : BACK;
      if (texture)
        colour = colourAt (*texture, mean (mesh.coordinates, shares));
      if (shading == Shading::NONE)
        return colour;
      const Eigen::Vector3d normal =
          side * (shading == Shading::FLAT ? normals[t] : mean (sums, shares).normalized ());
      const double brightness =
          std::max (normal.dot (LEFT), 0.0) + std::max (normal.dot (RIGHT), 0.0);
      return (brightness * colour).cwiseMin (1.0);
    });
  }
  if (!texture)
    drawEdges (canvas, project (mesh.points, camera, canvas, LIFT), mesh.triangles,
               mesh.triangles.size () <= MOST_DRAWN_EDGES ? 1.0 : 0.0);
}

struct PictureOptions
{
  std::optional<PictureMesh> parameterization; ///< in the plane; its edges are drawn beside
  /// Image on the mesh, by its texture coordinates; beside it, the same in the square of the texture.
  std::optional<ColourImage> texture;
  Shading shading = Shading::SMOOTH; ///< FLAT is one for each triangle, which shows bumps
  /// From where the mesh is seen, if it lies within 60 degrees of one direction from there.
  std::optional<Eigen::Vector3d> viewpoint;
};

/// Draws a mesh: front sides blue, back sides orange, boundary edges red, and all edges if there
/// are few. It is seen from the side to which most of it faces.
/// \param height in pixels; mesh and parameterization are as wide each
inline ColourImage
drawMesh (PictureMesh mesh, std::size_t height, const PictureOptions& options)
{
  const View from_above{Eigen::Vector3d::UnitZ (), Eigen::Vector3d::UnitY ()};
  const bool has_two_panels = options.parameterization || options.texture;
  ColourImage image{has_two_panels ? 2 * height : height, height, {}};
  image.pixels.resize (image.width * image.height);

  Canvas canvas (2 * height); // is halved
  std::optional<Camera> camera;
  if (options.viewpoint)
    camera = aimFromViewpoint (mesh.scale * (*options.viewpoint - mesh.centre), mesh.points);
  if (!camera)
    camera = aimCamera (chooseView (mesh), mesh.points);
  drawTriangles (canvas, mesh, *camera, options.texture, options.shading);
  const auto copyTo = [&] (std::size_t left) {
    const ColourImage panel = halved (canvas.image ());
    for (std::size_t row = 0; row < height; ++row)
      std::copy_n (&panel.pixels[row * height], height, &image.pixels[row * image.width + left]);
  };
  copyTo (0);

  canvas = Canvas (2 * height);
  if (options.texture) {
    for (std::size_t i = 0; i < mesh.points.size (); ++i)
      mesh.points[i] << mesh.coordinates[i], 0.0;
    drawTriangles (canvas, mesh,
                   aimCamera (from_above, {Eigen::Vector3d::Zero (), Eigen::Vector3d::Ones ()}),
                   options.texture, Shading::NONE);
  }
  else if (options.parameterization) {
    const PictureMesh& flat = *options.parameterization;
    const std::vector<Spot> spots =
        project (flat.points, aimCamera (from_above, flat.points), canvas);
    drawEdges (canvas, spots, flat.triangles,
               flat.triangles.size () <= MOST_DRAWN_EDGES ? 1.0 : 0.2);
  }
  if (has_two_panels)
    copyTo (height);
  return image;
}

} // namespace pcl::floater
