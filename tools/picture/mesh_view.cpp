// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_view.h"

#include "cloud_reader.h"
#include "format.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
PictureMesh
readPictureMesh (const std::filesystem::path& path)
{
  const std::string extension = lowerExtension (path);
  if (extension != ".vtk" && extension != ".ply")
    throw ReadError ("its extension must be .vtk or .ply");
  const FileBytes file (path);
  PictureMesh mesh;
  Triangles all;
  const Cloud cloud = extension == ".vtk" ? parseVtk (file, all) : parsePly (file, false, &all);
  const std::vector<Eigen::Vector3d> positions = cloud.positions ();
  const Field *s = cloud.find ("s"), *t = cloud.find ("t");

  constexpr std::uint32_t UNUSED = std::numeric_limits<std::uint32_t>::max ();
  std::vector<std::uint32_t> number (positions.size (), UNUSED);
  Eigen::AlignedBox3d box;
  for (auto& triangle : all) {
    if (!std::all_of (triangle.begin (), triangle.end (),
                      [&] (std::uint32_t corner) { return positions[corner].allFinite (); }))
      continue;
    for (std::uint32_t& corner : triangle) {
      if (number[corner] == UNUSED) {
        number[corner] = static_cast<std::uint32_t> (mesh.points.size ());
        mesh.points.push_back (positions[corner]);
        box.extend (positions[corner]);
        if (s != nullptr && t != nullptr)
          mesh.coordinates.emplace_back (std::fmax (0.0, std::fmin (s->asDouble (corner), 1.0)),
                                         std::fmax (0.0, std::fmin (t->asDouble (corner), 1.0)));
      }
      corner = number[corner];
    }
    mesh.triangles.push_back (triangle);
  }
  if (mesh.triangles.empty ())
    throw ReadError ("it has no polygons");
  // Halves, because the size of the largest numbers overflows.
  mesh.centre = 0.5 * box.min () + 0.5 * box.max ();
  mesh.scale = 1.0 / (0.5 * box.max () - 0.5 * box.min ()).maxCoeff ();
  if (!std::isfinite (mesh.scale))
    mesh.scale = 1.0;
  for (Eigen::Vector3d& point : mesh.points)
    point = mesh.scale * (point - mesh.centre);
  return mesh;
}

namespace {
constexpr double MARGIN = 1.06; // side of the picture over that of the mesh in it
constexpr double DEGREE = 3.14159265358979323846 / 180.0;
constexpr double CLOSED = 1e-3;         // a mesh with a shorter mean normal counts as closed
constexpr double ONE_SIDED = 0.55;      // a mesh with a longer mean normal faces one way ...
constexpr double SHEET = 0.8;           // ... and is a sheet if it is longer than this
constexpr double NEARLY_PARALLEL = 0.8; // cosine
constexpr double SMALLEST = 1e-9;       // half of the side of a picture
constexpr double TIP_BACK = 50.0, FROM_ABOVE = 15.0, TURN = 20.0; // degrees

Eigen::Vector3d
centreOf (const std::vector<Eigen::Vector3d>& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero ();
  for (const Eigen::Vector3d& p : points)
    sum += p;
  return sum / static_cast<double> (points.size ());
}

// Mean of the unit normals, weighted by area, on the outer side if the surface bulges. The longer
// it is, the more of the mesh faces one way.
Eigen::Vector3d
meanNormal (const PictureMesh& mesh)
{
  const Eigen::Vector3d centre = centreOf (mesh.points);
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

Eigen::Vector3d
axisOfLeastVariance (const std::vector<Eigen::Vector3d>& points)
{
  const Eigen::Vector3d centre = centreOf (points);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero ();
  for (const Eigen::Vector3d& p : points)
    covariance += (p - centre) * (p - centre).transpose ();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver (covariance);
  const Eigen::Vector3d axis = solver.eigenvectors ().col (0);
  return axis.sum () < 0.0 ? Eigen::Vector3d (-axis) : axis;
}

Camera
lookAlong (const View& view)
{
  const Eigen::Vector3d right = view.up.cross (view.towards_viewer).normalized ();
  Camera camera{};
  camera.axes << right.transpose (), view.towards_viewer.cross (right).normalized ().transpose (),
      view.towards_viewer.transpose ();
  return camera;
}

} // namespace

View
chooseView (const PictureMesh& mesh)
{
  const Eigen::Vector3d normal = meanNormal (mesh);
  Eigen::Vector3d facing = normal.normalized (), up = Eigen::Vector3d::UnitY ();
  if (normal.norm () <= ONE_SIDED) {
    facing = axisOfLeastVariance (mesh.points);
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

Camera
aimCamera (const View& view, const std::vector<Eigen::Vector3d>& points)
{
  Camera camera = lookAlong (view);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points)
    box.extend (camera.axes * p);
  camera.origin = camera.axes.transpose () * box.center ();
  camera.half_side = 0.5 * MARGIN * std::max ({box.sizes ().x (), box.sizes ().y (), SMALLEST});
  return camera;
}

std::optional<Camera>
aimFromViewpoint (const Eigen::Vector3d& viewpoint, const std::vector<Eigen::Vector3d>& points)
{
  constexpr double WIDEST = 60.0, ALONG_Z = 0.8; // degrees on either side; a cosine
  Eigen::Vector3d mean = Eigen::Vector3d::Zero ();
  for (const Eigen::Vector3d& p : points)
    mean += (p - viewpoint).normalized ();
  mean.normalize ();
  double least = 1.0;
  for (const Eigen::Vector3d& p : points)
    least = std::min (least, mean.dot ((p - viewpoint).normalized ()));
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

} // namespace pcl::floater
