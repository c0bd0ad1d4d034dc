// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The iterative solver of TW 385: BiCGSTAB with an ILUT preconditioner, by GMM++.
#pragma once

#include "floater/solvers/linear_system.h"

#include <array>
#include <memory>
#include <vector>

namespace pcl
{
namespace floater
{
/// ILUT(p, tau) of TW 385, section 5.
constexpr int ILUT_FILL = 15;
constexpr double ILUT_THRESHOLD = 1e-2;

/// Both right-hand sides by GMM++.
struct IterativeSolution
{
  std::vector<Eigen::Vector2d> uv;         ///< per unknown
  double setup_seconds = 0.0;              ///< of the preconditioner
  std::array<double, 2> seconds{};         ///< of the iterations, per right-hand side
  std::array<std::size_t, 2> iterations{}; ///< per right-hand side
  bool converged = false;                  ///< both, by the residual that the method itself updates
  double residual = 0.0;                   ///< max over both of |b - A u| / |b|, computed anew

  double totalSeconds () const { return setup_seconds + seconds[0] + seconds[1]; }
};

/// An ILUT preconditioner and its matrix, to solve with at several tolerances.
class GmmBicgstab
{
public:
  GmmBicgstab (const LinearSystem& system, int fill, double threshold);
  ~GmmBicgstab ();
  GmmBicgstab (const GmmBicgstab&) = delete;
  GmmBicgstab& operator= (const GmmBicgstab&) = delete;

  /// From zero until the residual is `tolerance` times |b| in the 2-norm, as GMM++ measures, or for
  /// `most_iterations`.
  IterativeSolution solve (double tolerance, std::size_t most_iterations) const;

private:
  struct Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

} // namespace floater
} // namespace pcl
