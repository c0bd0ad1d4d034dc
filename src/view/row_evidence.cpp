// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/row_evidence.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl::floater {
RowEvidence
findRows (const Points& points, const RowOf& row_of, std::size_t count)
{
  constexpr double OPPOSITE = -0.7; // cosine of 135 degrees
  constexpr double BENT = 0.87;     // cosine of 30 degrees. Noise of 0.3 spacings along the surface
                                    // turns rows by 12 degrees
  constexpr double FEWEST_BENT = 0.02; // of the rows: such noise has 0.012, a body on a table more
  const std::vector<Eigen::Vector3d>& positions = points.positions;
  const std::size_t step = std::max<std::size_t> (1, positions.size () / count);
  std::size_t looked_at = 0;
  std::vector<Eigen::Vector3d> directions;          // of the rows
  Eigen::Matrix3d along = Eigen::Matrix3d::Zero (); // sum of their squares
  for (std::size_t p = step / 2; p < positions.size (); p += step) {
    const Row row = row_of (static_cast<Index> (p));
    if (row.size () < 2)
      continue;
    const Eigen::Vector3d u = (positions[row[0]] - positions[p]).normalized ();
    const Eigen::Vector3d v = (positions[row[1]] - positions[p]).normalized ();
    ++looked_at;
    if (u.dot (v) >= OPPOSITE)
      continue;
    directions.push_back ((u - v).normalized ());
    along += directions.back () * directions.back ().transpose ();
  }
  RowEvidence rows;
  if (directions.empty ())
    return rows;
  const auto axesOf = [] (const Eigen::Matrix3d& squares) -> Eigen::Matrix3d {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> (squares).eigenvectors ();
  };
  // Most rows may have one direction, which with any other one gives the plane.
  const Eigen::Vector3d usual = axesOf (along).col (2);
  along.setZero ();
  double bent = 0.0;
  for (const Eigen::Vector3d& direction : directions)
    if (std::abs (direction.dot (usual)) < BENT) {
      ++bent;
      along += direction * direction.transpose () + usual * usual.transpose ();
    }
  const auto in_rows = static_cast<double> (directions.size ());
  rows.share = in_rows / static_cast<double> (looked_at);
  rows.across = axesOf (along).col (0);
  rows.are_straight = bent < FEWEST_BENT * in_rows;
  return rows;
}

} // namespace pcl::floater
