// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/solver.h"

#include "core/parallel.h"

#include <Eigen/CholmodSupport>
#include <Eigen/IterativeLinearSolvers>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>

#include <cstdlib>
#include <new>
#include <sstream>

namespace pcl::floater {
namespace {
// The residual of one coordinate, computed from the matrix itself.
struct Residual
{
  Eigen::VectorXd rest;  // b - A u
  double rhs = 0.0;      // |b|
  double rounding = 0.0; // bound of the rounding error of |b - A u|: 4 eps | |A| |u| + |b| |

  // The norm at which an iteration is done: that of the tolerance, or as small as double precision
  // lets it be. Storing u with 16 digits alone gives a large system a relative one above 1e-15.
  double target (double tolerance) const { return std::max (tolerance * rhs, rounding); }
};

// O(entries).
Residual
measureResidual (const LinearSystem& system, Eigen::Index side,
                 const Eigen::Ref<const Eigen::VectorXd>& solution)
{
  constexpr double ROUNDING = 4.0 * std::numeric_limits<double>::epsilon ();
  Residual residual{system.rhs.col (side), system.rhs.col (side).norm (), 0.0};
  Eigen::VectorXd magnitude = residual.rest.cwiseAbs ();
  for (Eigen::Index i = 0; i < system.matrix.rows (); ++i)
    for (SystemMatrix::InnerIterator entry (system.matrix, i); entry; ++entry) {
      const double term = entry.value () * solution[entry.col ()];
      residual.rest[i] -= term;
      magnitude[i] += std::abs (term);
    }
  residual.rounding = ROUNDING * magnitude.norm ();
  return residual;
}

using Order = Eigen::PermutationMatrix<Eigen::Dynamic>;

// Small bandwidth (Cuthill and McKee 1969; George 1971).
Order
reverseCuthillMckee (const SystemMatrix& symmetric)
{
  using Color = boost::property<boost::vertex_color_t, boost::default_color_type>;
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, Color>;
  Graph graph (static_cast<std::size_t> (symmetric.rows ()));
  for (int row = 0; row < symmetric.rows (); ++row)
    for (SystemMatrix::InnerIterator entry (symmetric, row); entry && entry.col () < row; ++entry)
      boost::add_edge (static_cast<std::size_t> (row), static_cast<std::size_t> (entry.col ()),
                       graph);
  Order order (symmetric.rows ());
  int* const end = order.indices ().data () + order.size ();
  boost::cuthill_mckee_ordering (graph, std::make_reverse_iterator (end),
                                 boost::get (boost::vertex_color, graph),
                                 boost::make_degree_map (graph));
  return order;
}

// An order of the unknowns (TW 385, section 4.2 and Figure 4), made from the pattern of A + A^T.
// indices () [i] is the unknown that comes i-th. AMD (approximate minimum degree; Amestoy, Davis and
// Duff 1996) and METIS (nested dissection; Karypis and Kumar 1998) are called through CHOLMOD, and
// follow the elimination tree. METIS draws from rand (), of which it gets a state of its own; another
// thread that draws meanwhile changes the order, so that only one thread is in METIS at a time.
// \param ordering AMD, METIS or REVERSE_CUTHILL_MCKEE
// \throws std::bad_alloc
Order
orderUnknowns (const SystemMatrix& matrix, Ordering ordering)
{
  const SystemMatrix symmetric = matrix + SystemMatrix (matrix.transpose ());
  if (ordering == Ordering::REVERSE_CUTHILL_MCKEE)
    return reverseCuthillMckee (symmetric);
  Order order (symmetric.rows ());
  cholmod_sparse pattern = Eigen::viewAsCholmod (symmetric.selfadjointView<Eigen::Lower> ());
  cholmod_common common{};
  cholmod_start (&common);
  common.print = 0;
  int done = 0;
  if (ordering == Ordering::AMD)
    done = cholmod_amd (&pattern, nullptr, 0, order.indices ().data (), &common);
  else {
    static std::mutex mutex;
    const std::lock_guard<std::mutex> lock (mutex);
    std::array<char, 128> state{}; // as many bytes as rand () has in the beginning
    char* const before = initstate (1, state.data (), state.size ());
    constexpr int POSTORDER = 1;
    done = cholmod_metis (&pattern, nullptr, 0, POSTORDER, order.indices ().data (), &common);
    setstate (before);
  }
  cholmod_finish (&common);
  if (done == 0)
    throw std::bad_alloc (); // the pattern is valid; METIS does not tell what it lacks
  return order;
}

using Vector = Eigen::VectorXd;

struct IncompleteFactors : Eigen::IncompleteLUT<double>
{
  std::size_t nonZeros () const { return static_cast<std::size_t> (m_lu.nonZeros ()); }
};

// The factors as a preconditioner, at whose every use the run is polled for cancellation.
struct Preconditioner : Eigen::IdentityPreconditioner
{
  Vector solve (const Vector& rest) const
  {
    run->poll ();
    return factors->solve (rest);
  }

  const IncompleteFactors* factors = nullptr;
  const RunContext* run = nullptr;
};

// BiCGSTAB (van der Vorst 1992) with Eigen's IncompleteLUT: one incomplete factorization, then each
// coordinate by itself. The residual that BiCGSTAB updates drifts away from the true one. So the true
// one is measured when it stops, and it starts again on what is left until the tolerance is reached,
// the iterations of all rounds are used up, or a round does not halve the residual. Fills `uv` and the
// figures of the solution; conclude () looks at them.
void
solveWithBicgstab (const LinearSystem& system, const SolverOptions& options, const RunContext& run,
                   Solution& solution)
{
  const Eigen::Index n = system.rhs.rows ();
  IncompleteFactors factors;
  // Eigen counts the fill in mean rows of the matrix, so it is rounded up to a multiple of these. Half
  // of it goes to L, and half to U.
  const double mean_row = static_cast<double> (system.nonzeros ()) / static_cast<double> (n);
  const double fill = std::ceil (2.0 * options.ilut_fill / mean_row);
  // Eigen reserves so many entries, and counts them in an int without looking.
  const std::size_t reserved_in_row =
      std::min (system.unknowns (), static_cast<std::size_t> (fill * mean_row) + 1) + 1;
  requireCountable (system.unknowns () * reserved_in_row, MOST_MATRIX_ENTRIES,
                    "the incomplete factorization", "use a smaller fill, or fewer points");
  factors.setFillfactor (static_cast<int> (fill));
  factors.setDroptol (options.ilut_drop);
  factors.compute (system.matrix);
  solution.nnz_factors = factors.nonZeros ();

  solution.uv.resize (n, 2);
  parallelTasks (run, 2, [&] (std::size_t coordinate) {
    const auto side = static_cast<Eigen::Index> (coordinate);
    Eigen::BiCGSTAB<SystemMatrix, Preconditioner> solver;
    solver.preconditioner () = {{}, &factors, &run};
    solver.compute (system.matrix);
    Vector rest = system.rhs.col (side), best = Vector::Zero (n), step;
    double norm = rest.norm (), target = options.tolerance * norm;
    int iterations = 0;
    for (bool goes_on = true; goes_on && norm > target && iterations < options.max_iterations;) {
      solver.setTolerance (target / norm);
      solver.setMaxIterations (options.max_iterations - iterations);
      step = solver.solve (rest);
      iterations += static_cast<int> (solver.iterations ());
      step += best;
      Residual residual = measureResidual (system, side, step);
      const double next_norm = residual.rest.norm ();
      if (!(next_norm < norm))
        break;
      std::swap (best, step);
      rest = std::move (residual.rest);
      goes_on = next_norm <= 0.5 * norm;
      norm = next_norm;
      target = residual.target (options.tolerance);
    }
    solution.uv.col (side) = best;
    (side == 0 ? solution.iterations_u : solution.iterations_v) =
        static_cast<std::size_t> (iterations);
  });
}

// Above this number, memory counts: METIS's factors are smaller than AMD's by a quarter to a third,
// and solving takes as long, or up to 1.6 times as long (four discs of 300,000 points).
constexpr std::size_t METIS_UNKNOWNS = 100'000;

// Pivots on the diagonal: a system counts as singular if its reciprocal condition is below this.
// Floating unknowns leave a pivot of rounding errors that is seldom exactly 0 (up to 3e-14 with
// 5000 unknowns). Unknowns that depend on the loop by the smallest of weights (SMALLEST_WEIGHT)
// stay above.
constexpr double SINGULAR_RECIPROCAL_CONDITION = 1e-12;

// Looks for a problem in the pivots and the residual of solution.uv, which stays only without.
void
conclude (const LinearSystem& system, const SolverOptions& options, Solution& solution)
{
  bool is_finite = true, is_within = true;
  for (Eigen::Index side = 0; side < 2; ++side) {
    const Residual residual = measureResidual (system, side, solution.uv.col (side));
    const double norm = residual.rest.norm ();
    solution.residual = std::max (solution.residual, residual.rest.cwiseAbs ().maxCoeff ());
    if (norm != 0.0)
      solution.relative_residual = std::max (solution.relative_residual, norm / residual.rhs);
    is_finite = is_finite && std::isfinite (norm);
    is_within = is_within && norm <= residual.target (options.tolerance);
  }
  const bool is_iterative = options.method == Solver::BICGSTAB_ILUT;
  if (!is_iterative && !(solution.reciprocal_condition >= SINGULAR_RECIPROCAL_CONDITION))
    solution.problem =
        notSolved (RunStatus::SINGULAR, "factorization: a pivot consists of rounding errors only");
  else if (!is_finite)
    solution.problem = notSolved (RunStatus::INTERNAL_ERROR, "the solution is not finite");
  else if (is_iterative && !is_within) {
    std::ostringstream message;
    const std::size_t iterations = std::max (solution.iterations_u, solution.iterations_v);
    message << "BiCGSTAB reached a relative residual of " << solution.relative_residual << " in "
            << iterations << (iterations == 1 ? " iteration" : " iterations") << ", not "
            << options.tolerance;
    solution.problem = notSolved (RunStatus::NOT_CONVERGED, message.str ());
  }
  if (solution.problem)
    solution.uv.resize (0, 2);
}

} // namespace

LinearSystem
assembleSystem (const CsrLists& neighbors, const std::vector<double>& weights,
                const std::vector<Index>& loop, const std::vector<Vector2d>& loop_uv,
                const Flags& reachable, std::size_t most_entries)
{
  LinearSystem system;
  std::vector<Index> place_in_loop (neighbors.rows (), NONE), unknown_of_point = place_in_loop;
  for (std::size_t i = 0; i < loop.size (); ++i)
    place_in_loop[loop[i]] = static_cast<Index> (i);
  for (std::size_t p = 0; p < neighbors.rows (); ++p)
    if (place_in_loop[p] == NONE && reachable[p] != 0) {
      unknown_of_point[p] = static_cast<Index> (system.point_of_unknown.size ());
      system.point_of_unknown.push_back (static_cast<Index> (p));
    }
  const auto unknowns = static_cast<Eigen::Index> (system.point_of_unknown.size ());
  std::size_t entries = 0;
  system.matrix.resize (unknowns, unknowns);
  system.matrix.reserve (unknowns + static_cast<Eigen::Index> (neighbors.ids.size ()));
  system.rhs.setZero (unknowns, 2);
  std::vector<std::pair<Eigen::Index, double>> row;
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    row.assign (1, {i, 0.0});
    const Index p = system.point_of_unknown[static_cast<std::size_t> (i)];
    for (std::size_t entry = neighbors.offsets[p]; entry < neighbors.offsets[p + 1]; ++entry) {
      const Index q = neighbors.ids[entry];
      const double weight = weights[entry];
      if (unknown_of_point[q] != NONE)
        row.emplace_back (unknown_of_point[q], -weight);
      else if (place_in_loop[q] != NONE)
        system.rhs.row (i) += weight * loop_uv[place_in_loop[q]].transpose ();
      else
        continue;
      row.front ().second += weight;
    }
    requireCountable (entries += row.size (), most_entries, "the linear system",
                      "use fewer points or fewer neighbours, or make a surface instead of a disc");
    std::sort (row.begin (), row.end ());
    system.matrix.startVec (i);
    for (const auto& [column, value] : row)
      system.matrix.insertBack (i, column) = value;
  }
  system.matrix.finalize ();
  return system;
}

Problem
notSolved (RunStatus status, const std::string& why)
{
  if (status == RunStatus::SINGULAR)
    return {status, "the linear system is singular (" + why + "); use more neighbours"};
  if (status == RunStatus::NOT_CONVERGED)
    return {status, why + "; allow more iterations, or use a direct solver"};
  if (status == RunStatus::OUT_OF_MEMORY)
    return {status, "not enough memory for the factorization (" + why +
                        "): use fewer points, or a machine with more memory"};
  return {RunStatus::INTERNAL_ERROR, "the linear system was not solved (" + why + ")"};
}

Solution
solve (const LinearSystem& system, const SolverOptions& options, const RunContext& run)
{
  Solution solution;
  solution.unknowns = system.unknowns ();
  solution.nnz_matrix = system.nonzeros ();
  if (system.unknowns () == 0) {
    solution.reciprocal_condition = 1.0;
    return solution;
  }
  // Solves a system as it comes.
  const auto solveAsItIs = [&] (const LinearSystem& as_it_is, Ordering ordering) {
    if (options.method == Solver::BICGSTAB_ILUT)
      solveWithBicgstab (as_it_is, options, run, solution);
    else
      solveWithUmfpack (as_it_is, ordering, run, solution);
    if (solution.uv.rows () > 0)
      conclude (as_it_is, options, solution);
  };
  Ordering ordering = options.ordering;
  if (options.method == Solver::UMFPACK && ordering == Ordering::AUTOMATIC)
    ordering = system.unknowns () > METIS_UNKNOWNS ? Ordering::METIS : Ordering::AMD;
  if (ordering == Ordering::AUTOMATIC || ordering == Ordering::NATURAL ||
      (options.method == Solver::UMFPACK && ordering == Ordering::AMD)) {
    solveAsItIs (system, ordering);
    return solution;
  }
  const Order order = orderUnknowns (system.matrix, ordering);
  const Order place = order.inverse ();
  LinearSystem ordered;
  ordered.matrix = system.matrix.twistedBy (place);
  ordered.rhs = place * system.rhs;
  solveAsItIs (ordered, Ordering::NATURAL);
  if (!solution.problem)
    solution.uv = order * Eigen::MatrixX2d (solution.uv);
  return solution;
}

} // namespace pcl::floater
