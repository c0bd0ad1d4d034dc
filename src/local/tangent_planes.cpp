// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/tangent_planes.h"

#include "core/parallel.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t CORE = 8;    // nearest points of the first plane
constexpr double NEAR_PLANE = 0.5; // refit: largest sine between a neighbour and the first plane

// Sums for the covariance of offsets from a centre point, which itself counts as one offset (zero).
class Covariance
{
public:
  void add (const Eigen::Vector3d& offset)
  {
    sum_ += offset;
    products_.noalias () += offset * offset.transpose ();
    ++count_;
  }

  std::size_t count () const { return count_; }

  Eigen::Vector3d smallestAxis () const
  {
    const double n = static_cast<double> (count_);
    const Eigen::Matrix3d covariance = products_ - sum_ * sum_.transpose () / n;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect (covariance);
    return solver.eigenvectors ().col (0);
  }

private:
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero ();
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero ();
  std::size_t count_ = 1;
};

Eigen::Vector3d
fitPlane (const std::vector<Eigen::Vector3d>& positions, Index p, Row neighbors)
{
  Covariance core;
  for (std::size_t i = 0; i < std::min (CORE, neighbors.size ()); ++i)
    core.add (positions[neighbors[i]] - positions[p]);
  const Eigen::Vector3d first = core.smallestAxis ();
  Covariance sheet;
  for (Index q : neighbors) {
    const Eigen::Vector3d offset = positions[q] - positions[p];
    if (std::abs (first.dot (offset)) <= NEAR_PLANE * offset.norm ())
      sheet.add (offset);
  }
  const Eigen::Vector3d normal = sheet.count () > CORE / 2 ? sheet.smallestAxis () : first;
  return normal.allFinite () ? normal.normalized () : Eigen::Vector3d::UnitZ ();
}

} // namespace

std::vector<Eigen::Vector3f>
fitTangentPlanes (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  const RunContext& run)
{
  std::vector<Eigen::Vector3f> normals (positions.size ());
  parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
      normals[p] = fitPlane (positions, static_cast<Index> (p), neighbors.row (p)).cast<float> ();
  });
  return normals;
}

} // namespace floater
} // namespace pcl
