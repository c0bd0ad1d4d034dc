// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_view.h"

#include <vtkCamera.h>
#include <vtkIdList.h>
#include <vtkNew.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
constexpr double MARGIN = 1.06; // side of the picture over that of the mesh in it
constexpr double DEGREE = 3.14159265358979323846 / 180.0;
constexpr double CLOSED = 1e-3;         // a mesh with a shorter mean normal counts as closed
constexpr double ONE_SIDED = 0.55;      // a mesh with a longer mean normal faces one way ...
constexpr double SHEET = 0.8;           // ... and is a sheet if it is longer than this
constexpr double NEARLY_PARALLEL = 0.8; // cosine
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
meanNormal (vtkPolyData* mesh, const std::vector<Eigen::Vector3d>& points)
{
  const Eigen::Vector3d centre = centreOf (points);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero ();
  double area = 0.0, volume = 0.0; // twice the area, six times the volume seen from the centre
  vtkNew<vtkIdList> polygon;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells (); ++cell) {
    mesh->GetCellPoints (cell, polygon);
    for (vtkIdType i = 2; i < polygon->GetNumberOfIds (); ++i) {
      const auto corner = [&] (vtkIdType j) -> const Eigen::Vector3d& {
        return points[static_cast<std::size_t> (polygon->GetId (j))];
      };
      const Eigen::Vector3d normal = (corner (i - 1) - corner (0)).cross (corner (i) - corner (0));
      sum += normal;
      area += normal.norm ();
      volume += normal.dot (corner (0) - centre);
    }
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

} // namespace

std::vector<Eigen::Vector3d>
pointsOf (vtkPolyData* mesh)
{
  std::vector<Eigen::Vector3d> points (static_cast<std::size_t> (mesh->GetNumberOfPoints ()));
  for (std::size_t i = 0; i < points.size (); ++i)
    mesh->GetPoint (static_cast<vtkIdType> (i), points[i].data ());
  return points;
}

View
chooseView (vtkPolyData* mesh, const std::vector<Eigen::Vector3d>& points)
{
  const Eigen::Vector3d normal = meanNormal (mesh, points);
  Eigen::Vector3d facing = normal.normalized (), up = Eigen::Vector3d::UnitY ();
  if (normal.norm () <= ONE_SIDED) {
    facing = axisOfLeastVariance (points);
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

void
aimCamera (vtkRenderer* renderer, const View& view, const std::vector<Eigen::Vector3d>& points)
{
  const Eigen::Vector3d right = view.up.cross (view.towards_viewer).normalized ();
  const Eigen::Vector3d up = view.towards_viewer.cross (right).normalized ();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points)
    box.extend (Eigen::Vector3d (right.dot (p), up.dot (p), view.towards_viewer.dot (p)));
  const Eigen::Vector3d middle = box.center ();
  const Eigen::Vector3d focus =
      middle.x () * right + middle.y () * up + middle.z () * view.towards_viewer;
  const Eigen::Vector3d position = focus + box.diagonal ().norm () * view.towards_viewer;
  vtkCamera* camera = renderer->GetActiveCamera ();
  camera->ParallelProjectionOn ();
  camera->SetFocalPoint (focus.data ());
  camera->SetPosition (position.data ());
  camera->SetViewUp (up.data ());
  camera->SetParallelScale (0.5 * MARGIN * std::max (box.sizes ().x (), box.sizes ().y ()));
  renderer->ResetCameraClippingRange ();
}

bool
aimFromViewpoint (vtkRenderer* renderer, const Eigen::Vector3d& viewpoint,
                  const std::vector<Eigen::Vector3d>& points)
{
  constexpr double WIDEST = 60.0, ALONG_Z = 0.8; // degrees on either side; a cosine
  Eigen::Vector3d mean = Eigen::Vector3d::Zero ();
  for (const Eigen::Vector3d& p : points)
    mean += (p - viewpoint).normalized ();
  mean.normalize ();
  double least = 1.0;
  for (const Eigen::Vector3d& p : points)
    least = std::min (least, mean.dot ((p - viewpoint).normalized ()));
  const double angle = std::acos (least) / DEGREE;
  if (!(angle < WIDEST))
    return false;
  const Eigen::Vector3d focus = viewpoint + mean;
  vtkCamera* camera = renderer->GetActiveCamera ();
  camera->SetPosition (viewpoint.data ());
  camera->SetFocalPoint (focus.data ());
  if (mean.z () > ALONG_Z)
    camera->SetViewUp (0.0, -1.0, 0.0);
  else
    camera->SetViewUp (0.0, 0.0, 1.0);
  camera->SetViewAngle (2.0 * angle);
  renderer->ResetCameraClippingRange ();
  return true;
}

} // namespace pcl::floater
