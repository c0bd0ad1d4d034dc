// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmm_bicgstab.h"

#include "stopwatch.h"

#include <gmm/gmm.h>

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
using Matrix = gmm::csr_matrix<double>;
using Ilut = gmm::ilut_precond<Matrix>;
} // namespace

struct GmmBicgstab::Implementation
{
  Implementation (const LinearSystem& s, int fill, double threshold) : system (s)
  {
    gmm::row_matrix<gmm::rsvector<double>> rows (s.unknowns (), s.unknowns ());
    for (std::size_t i = 0; i < s.unknowns (); ++i)
      for (int entry = s.row_offsets[i]; entry < s.row_offsets[i + 1]; ++entry) {
        const auto e = static_cast<std::size_t> (entry);
        rows (i, static_cast<std::size_t> (s.columns[e])) = s.values[e];
      }
    gmm::copy (rows, matrix);
    const Stopwatch stopwatch;
    preconditioner = std::make_unique<Ilut> (matrix, fill, threshold);
    setup_seconds = stopwatch.seconds ();
  }

  const LinearSystem& system;
  Matrix matrix;
  std::unique_ptr<Ilut> preconditioner;
  double setup_seconds = 0.0;
};

GmmBicgstab::GmmBicgstab (const LinearSystem& system, int fill, double threshold)
    : implementation_ (std::make_unique<Implementation> (system, fill, threshold))
{
}

GmmBicgstab::~GmmBicgstab () = default;

IterativeSolution
GmmBicgstab::solve (double tolerance, std::size_t most_iterations) const
{
  const LinearSystem& system = implementation_->system;
  IterativeSolution result;
  result.setup_seconds = implementation_->setup_seconds;
  result.uv.resize (system.unknowns ());
  result.converged = true;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::vector<double>& rhs = side == 0 ? system.rhs_u : system.rhs_v;
    std::vector<double> x (system.unknowns (), 0.0);
    gmm::iteration iteration (tolerance, 0, most_iterations);
    const Stopwatch stopwatch;
    gmm::bicgstab (implementation_->matrix, x, rhs, *implementation_->preconditioner, iteration);
    result.seconds[side] = stopwatch.seconds ();
    result.iterations[side] = iteration.get_iteration ();
    result.converged = result.converged && iteration.converged ();
    std::vector<double> rest (system.unknowns ());
    gmm::mult (implementation_->matrix, gmm::scaled (x, -1.0), rhs, rest);
    result.residual = std::max (result.residual, gmm::vect_norm2 (rest) / gmm::vect_norm2 (rhs));
    for (std::size_t i = 0; i < x.size (); ++i)
      result.uv[i][static_cast<Eigen::Index> (side)] = x[i];
  }
  return result;
}

} // namespace floater
} // namespace pcl
