// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Logistic regression by Newton's method.
#pragma once

#include <Eigen/Core>

namespace pcl
{
namespace floater
{
/// Coefficients b of the log odds x . b that make the weighted likelihood of the outcomes largest,
/// by iteratively reweighted least squares (Hastie, Tibshirani, Friedman 2009 "The Elements of
/// Statistical Learning", section 4.4.1), with a small penalty on the squares of b, without which
/// classes that can be told without error would have no best b. O(n k^2) for n rows of k columns.
/// \param features one row for each case; the first column is 1
/// \param outcomes 0 or 1
/// \param weights  above 0
Eigen::VectorXd
fitLogistic (const Eigen::MatrixXd& features, const Eigen::VectorXd& outcomes,
             const Eigen::VectorXd& weights);

} // namespace floater
} // namespace pcl
