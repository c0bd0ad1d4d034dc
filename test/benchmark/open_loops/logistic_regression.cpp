// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "logistic_regression.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double PENALTY = 1.0; // on a column of mean 0 and deviation 1, of thousands of cases
constexpr int MOST_ITERATIONS = 50;
constexpr double SMALL_STEP = 1e-10; // Newton's method converges quadratically
} // namespace

Eigen::VectorXd
fitLogistic (const Eigen::MatrixXd& features, const Eigen::VectorXd& outcomes,
             const Eigen::VectorXd& weights)
{
  // Columns of mean 0 and deviation 1, but for the constant.
  const Eigen::Index columns = features.cols ();
  Eigen::VectorXd mean = features.colwise ().mean (), deviation (columns);
  mean (0) = 0.0;
  Eigen::MatrixXd x = features.rowwise () - mean.transpose ();
  for (Eigen::Index j = 0; j < columns; ++j) {
    deviation (j) = std::sqrt (x.col (j).squaredNorm () / static_cast<double> (x.rows ()));
    x.col (j) /= deviation (j);
  }
  Eigen::VectorXd b = Eigen::VectorXd::Zero (columns);
  for (int i = 0; i < MOST_ITERATIONS; ++i) {
    const Eigen::ArrayXd probability = 1.0 / (1.0 + (-(x * b).array ()).exp ());
    const Eigen::ArrayXd variance = weights.array () * probability * (1.0 - probability);
    Eigen::MatrixXd hessian = x.transpose () * variance.matrix ().asDiagonal () * x;
    hessian.diagonal ().array () += PENALTY;
    const Eigen::VectorXd gradient =
        x.transpose () * (weights.array () * (outcomes.array () - probability)).matrix () -
        PENALTY * b;
    const Eigen::VectorXd step = hessian.ldlt ().solve (gradient);
    b += step;
    if (step.norm () < SMALL_STEP)
      break;
  }
  b.array () /= deviation.array ();
  b (0) -= b.tail (columns - 1).dot (mean.tail (columns - 1));
  return b;
}

} // namespace floater
} // namespace pcl
