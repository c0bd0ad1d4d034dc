// SPDX-License-Identifier: GPL-3.0-or-later
// Weighted least-squares planes.
#pragma once

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
struct Plane
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero ();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ (); ///< unit vector of arbitrary sign
  double mean_square = 0.0;                           ///< of the distances to the plane

  /// Distance of a point to the plane, negative below it.
  double height (const Eigen::Vector3d& point) const { return normal.dot (point - centre); }
};

/// Sums for the plane that fits points best. The points should lie around the origin, within a few
/// times their own extent.
class PlaneFit
{
public:
  void add (const Eigen::Vector3d& point, double weight = 1.0)
  {
    sum_ += weight * point;
    products_.noalias () += weight * point * point.transpose ();
    weight_ += weight;
  }

  /// Needs a positive weight. Points on a line or all in one place get one of the planes that
  /// hold them.
  Plane plane () const
  {
    Plane plane;
    plane.centre = sum_ / weight_;
    const Eigen::Matrix3d covariance =
        products_ / weight_ - plane.centre * plane.centre.transpose ();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect (covariance);
    const Eigen::Vector3d normal = solver.eigenvectors ().col (0);
    if (normal.allFinite ())
      plane.normal = normal.normalized ();
    plane.mean_square = std::max (0.0, plane.normal.dot (covariance * plane.normal));
    return plane;
  }

private:
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero ();
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero ();
  double weight_ = 0.0;
};

} // namespace floater
} // namespace pcl
