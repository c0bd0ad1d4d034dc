// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Planes, frames and small geometry.
#pragma once

#include "core/types.h"

#include <Eigen/Eigenvalues>

namespace pcl::floater {
constexpr double PI = 3.14159265358979323846;
constexpr double DEGREE = PI / 180.0; ///< in radians

/// Length of a closed loop of points.
inline double
perimeter (const Positions& positions, const std::vector<Index>& loop)
{
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size (); ++i)
    length += (positions[loop[(i + 1) % loop.size ()]] - positions[loop[i]]).norm ();
  return length;
}

/// Distance between two of some points.
inline double
distanceBetween (const Positions& positions, Index p, Index q)
{
  return (positions[q] - positions[p]).norm ();
}

/// Twice the signed area of the triangle of the origin, a and b; positive if b is to the left of a.
inline double
cross (const Vector2d& a, const Vector2d& b)
{
  return a.x () * b.y () - a.y () * b.x ();
}

/// Twice the area of a triangle in the direction of its normal.
inline Vector3d
areaVector (const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  return (b - a).cross (c - a);
}

/// Radius of the circle through three points; infinite, or not a number, if they lie on one line.
inline double
circumradius (const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d ab = b - a, ac = c - a;
  return ab.norm () * ac.norm () * (c - b).norm () / (2.0 * ab.cross (ac).norm ());
}

/// From point a to the centre of the circle through a, b and c.
/// \param normal (b - a) x (c - a)
inline Vector3d
toCircumcentre (const Vector3d& ab, const Vector3d& ac, const Vector3d& normal)
{
  return (ab.squaredNorm () * ac.cross (normal) + ac.squaredNorm () * normal.cross (ab)) /
         (2.0 * normal.squaredNorm ());
}

/// Direction k of `count` that are spread evenly over the sphere, on a spiral.
inline Vector3d
spiralDirection (std::size_t k, std::size_t count)
{
  const double golden_angle = PI * (3.0 - std::sqrt (5.0));
  const double z = 1.0 - static_cast<double> (2 * k + 1) / static_cast<double> (count);
  const double radius = std::sqrt (1.0 - z * z), angle = static_cast<double> (k) * golden_angle;
  return {radius * std::cos (angle), radius * std::sin (angle), z};
}

/// Whether the surface is folded at an edge: the normals of its two triangles are more than 120
/// degrees apart. The normals may have any lengths; a triangle without area is not folded.
inline bool
isFold (const Vector3d& normal, const Vector3d& other)
{
  constexpr double SQR_COSINE = 0.25; // of 120 degrees
  const double product = normal.dot (other);
  return product < 0.0 &&
         product * product > SQR_COSINE * normal.squaredNorm () * other.squaredNorm ();
}

/// True if the surface bends by more than 60 degrees between two normals of any length.
inline bool
isBent (const Vector3d& normal, const Vector3d& other)
{
  return !isFold (normal, -other);
}

/// Right-handed axes with the normal as the third.
struct TangentFrame
{
  explicit TangentFrame (const Vector3d& unit_normal)
      : normal (unit_normal), x (unit_normal.unitOrthogonal ()), y (unit_normal.cross (x))
  {
  }

  Vector2d project (const Vector3d& offset) const { return {x.dot (offset), y.dot (offset)}; }

  Vector3d normal, x, y;
};

struct Plane
{
  Vector3d centre = Vector3d::Zero ();
  Vector3d normal = Vector3d::UnitZ (); ///< unit vector of arbitrary sign
  double mean_square = 0.0;             ///< of the distances to the plane
  double aspect = 0.0; ///< middle over largest eigenvalue of the covariance: 1 for a disc, 0 for
                       ///< collinear points, which determine no plane

  /// Distance of a point to the plane, negative below it.
  double height (const Vector3d& point) const { return normal.dot (point - centre); }
};

struct Line
{
  Vector3d direction = Vector3d::UnitX (); ///< unit vector of arbitrary sign
  double mean_square = 0.0; ///< of the distances to the line, in the direction of larger ones
  double aspect = 1.0;      ///< see Plane
};

/// Axes of least (first) to largest (last) spread, and the spreads: root mean squares.
struct PrincipalAxes
{
  Vector3d centre;
  Eigen::Matrix3d axes; ///< unit vectors, in columns
  Vector3d spread;
};

/// Accumulates sums for the least-squares plane. The points should lie around the origin, within a
/// few times their own extent.
class PlaneFit
{
public:
  void add (const Vector3d& point, double weight = 1.0)
  {
    sum_ += weight * point;
    products_.noalias () += weight * point * point.transpose ();
    weight_ += weight;
  }

  /// Sum of the weights.
  double weight () const { return weight_; }

  /// Needs a positive weight. For collinear or coinciding points: one of the planes that contain
  /// them.
  Plane plane () const
  {
    const Eigen::Matrix3d scattered = scatter ();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect (scattered);
    Plane plane;
    plane.centre = sum_ / weight_;
    const Vector3d normal = solver.eigenvectors ().col (0);
    if (normal.allFinite ())
      plane.normal = normal.normalized ();
    const Vector3d& eigenvalues = solver.eigenvalues ();
    if (eigenvalues[2] > 0.0)
      plane.aspect = std::max (0.0, eigenvalues[1]) / eigenvalues[2];
    plane.mean_square = std::max (0.0, plane.normal.dot (scattered * plane.normal)) / weight_;
    return plane;
  }

  /// The least-squares line. Needs a positive weight.
  Line line () const
  {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect (scatter ());
    Line line;
    const Vector3d direction = solver.eigenvectors ().col (2);
    if (direction.allFinite ())
      line.direction = direction.normalized ();
    const Vector3d& eigenvalues = solver.eigenvalues ();
    line.mean_square = std::max (0.0, eigenvalues[1]) / weight_;
    if (eigenvalues[2] > 0.0)
      line.aspect = std::max (0.0, eigenvalues[1]) / eigenvalues[2];
    return line;
  }

  /// Slower than plane (), but more accurate for nearly collinear points. Needs a positive weight.
  PrincipalAxes principalAxes () const
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver (scatter ());
    return {sum_ / weight_, solver.eigenvectors (),
            (solver.eigenvalues ().cwiseMax (0.0) / weight_).cwiseSqrt ()};
  }

private:
  // Covariance times the sum of the weights.
  Eigen::Matrix3d scatter () const { return products_ - sum_ * sum_.transpose () / weight_; }

  Vector3d sum_ = Vector3d::Zero ();
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero ();
  double weight_ = 0.0;
};

} // namespace pcl::floater
