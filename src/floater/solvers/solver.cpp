// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/solver.h"

#include "floater/solvers/bicgstab_solver.h"
#include "floater/solvers/eigen_sparse_lu_solver.h"
#include "floater/solvers/gauss_seidel_solver.h"
#include "floater/solvers/nested_dissection.h"
#include "floater/solvers/ordering.h"
#include "floater/solvers/umfpack_solver.h"
#ifdef PCL_FLOATER_HAS_SUPERLU
#include "floater/solvers/superlu_solver.h"
#endif

#include <string>

namespace pcl::floater {
namespace {
// Above this number, nested dissection is faster than AMD. Its factors are smaller by a tenth (127k
// unknowns, a closed shape with a hole) to a quarter (1M, a height field).
constexpr std::size_t DISSECTION_UNKNOWNS = 100'000;

const char*
solverName (Solver solver)
{
  switch (solver) {
  case Solver::UMFPACK:
    return "UMFPACK with its symmetric strategy";
  case Solver::UMFPACK_UNSYMMETRIC:
    return "UMFPACK with its unsymmetric strategy";
  case Solver::SUPERLU:
    return "SuperLU";
  case Solver::EIGEN_SPARSE_LU:
    return "Eigen's SparseLU";
  case Solver::BICGSTAB_ILUT:
    return "BiCGSTAB";
  case Solver::GAUSS_SEIDEL:
    return "Gauss-Seidel";
  }
  return "unknown";
}

// Whether the solver makes the ordering by itself, or needs none.
bool
ordersItself (Solver solver, Ordering ordering)
{
  switch (ordering) {
  case Ordering::AUTOMATIC:
  case Ordering::COLAMD:
  case Ordering::NATURAL:
    return true;
  case Ordering::AMD:
    return solver == Solver::UMFPACK;
  case Ordering::METIS:
    return solver == Solver::UMFPACK || solver == Solver::UMFPACK_UNSYMMETRIC;
  case Ordering::REVERSE_CUTHILL_MCKEE:
    break;
  }
  return false;
}

Solution
solveAsItIs (const LinearSystem& system, Ordering ordering, const SolverOptions& options,
             const RunContext& run)
{
  switch (options.method) {
  case Solver::UMFPACK:
    return solveWithUmfpack (system, ordering, run);
  case Solver::UMFPACK_UNSYMMETRIC:
    return solveWithUmfpack (system, ordering, run, UmfpackStrategy::UNSYMMETRIC);
  case Solver::SUPERLU:
#ifdef PCL_FLOATER_HAS_SUPERLU
    return solveWithSuperlu (system, ordering);
#else
    break; // checkSolver () has refused it
#endif
  case Solver::EIGEN_SPARSE_LU:
    return solveWithEigenSparseLu (system, ordering, run);
  case Solver::BICGSTAB_ILUT:
    return solveWithBicgstab (system, options, run);
  case Solver::GAUSS_SEIDEL:
    return solveWithGaussSeidel (system, options.tolerance, options.max_iterations, run);
  }
  return {};
}

} // namespace

bool
isAvailable (Solver solver)
{
#ifdef PCL_FLOATER_HAS_SUPERLU
  static_cast<void> (solver);
  return true;
#else
  return solver != Solver::SUPERLU;
#endif
}

Problem
checkSolver (Solver solver, Ordering ordering)
{
  const std::string name = solverName (solver);
  if (ordering == Ordering::COLAMD && solver != Solver::UMFPACK_UNSYMMETRIC &&
      solver != Solver::SUPERLU && solver != Solver::EIGEN_SPARSE_LU)
    return {RunStatus::INVALID_OPTION, name + " does not take the ordering COLAMD, which orders "
                                              "columns alone; choose another ordering"};
  if (!isAvailable (solver))
    return {RunStatus::SOLVER_UNAVAILABLE,
            "this build of pcl_floater does not have " + name +
                "; choose another solver, or build pcl_floater where that library is installed"};
  return {};
}

Solution
solve (const LinearSystem& system, const SolverOptions& options,
       const std::vector<Eigen::Vector3d>* positions, const RunContext& run)
{
  Solution solution;
  if (const Problem problem = checkSolver (options.method, options.ordering)) {
    if (problem.status == RunStatus::SOLVER_UNAVAILABLE)
      solution.outcome = Solution::Outcome::UNAVAILABLE;
    solution.message = problem.message;
    return solution;
  }
  if (system.unknowns () == 0) {
    solution.outcome = Solution::Outcome::OK;
    solution.reciprocal_condition = 1.0;
    return solution;
  }
  if (options.method == Solver::UMFPACK && options.ordering == Ordering::AUTOMATIC &&
      positions != nullptr && system.unknowns () > DISSECTION_UNKNOWNS)
    return solveWithUmfpack (system, dissectUnknowns (system, *positions, run), run);
  if (ordersItself (options.method, options.ordering))
    return solveAsItIs (system, options.ordering, options, run);

  // Any solver can solve the reordered system as it comes.
  const std::vector<int> order = orderUnknowns (system, options.ordering);
  solution = solveAsItIs (permuteSystem (system, order), Ordering::NATURAL, options, run);
  std::vector<Eigen::Vector2d> uv (solution.uv.size ());
  for (std::size_t i = 0; i < uv.size (); ++i)
    uv[static_cast<std::size_t> (order[i])] = solution.uv[i];
  solution.uv = std::move (uv);
  return solution;
}

} // namespace pcl::floater
