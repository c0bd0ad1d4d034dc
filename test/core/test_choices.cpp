// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Combinations of neighbourhoods, weights, domains, solvers and orderings on one small sheet.
#include <pcl/surface/floater/reconstruct.h>

#include "floater/solvers/solver.h"
#include "random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace pcl::floater {
namespace {
constexpr Neighborhood ALL_NEIGHBORHOODS[] = {Neighborhood::NEAREST_DELAUNAY, Neighborhood::NEAREST,
                                              Neighborhood::BALL_DELAUNAY, Neighborhood::BALL};
constexpr Weighting ALL_WEIGHTINGS[] = {Weighting::UNIFORM, Weighting::INVERSE_DISTANCE,
                                        Weighting::SHAPE_PRESERVING, Weighting::MEAN_VALUE};
constexpr Solver ALL_SOLVERS[] = {Solver::UMFPACK, Solver::SUPERLU, Solver::BICGSTAB_ILUT,
                                  Solver::GAUSS_SEIDEL};
constexpr Ordering ALL_ORDERINGS[] = {Ordering::AUTOMATIC, Ordering::AMD, Ordering::METIS,
                                      Ordering::NATURAL, Ordering::REVERSE_CUTHILL_MCKEE};
constexpr std::size_t BORDER = 36;

// A round sheet: the first BORDER points are its border, in order; about 180 in all. `height`
// lifts its middle.
Input
sheet (double height)
{
  constexpr double PI = 3.14159265358979323846;
  constexpr double STEP = 2.0 * PI / static_cast<double> (BORDER);
  Input input;
  const auto add = [&] (double x, double y) {
    input.positions.emplace_back (x, y, height * (1.0 - x * x - y * y));
  };
  for (std::size_t i = 0; i < BORDER; ++i)
    add (std::cos (STEP * static_cast<double> (i)), std::sin (STEP * static_cast<double> (i)));
  RandomStream random (1);
  constexpr int REACH = 8;
  for (int row = -REACH; row <= REACH; ++row)
    for (int column = -REACH; column <= REACH; ++column) {
      const double x = 0.8 * STEP * (column + 0.6 * (random.uniform () - 0.5));
      const double y = 0.8 * STEP * (row + 0.6 * (random.uniform () - 0.5));
      if (std::hypot (x, y) < 1.0 - 0.6 * STEP)
        add (x, y);
    }
  input.cloud_size = input.positions.size ();
  input.cloud_index.resize (input.cloud_size);
  std::iota (input.cloud_index.begin (), input.cloud_index.end (), 0U);
  return input;
}

std::vector<std::uint32_t>
border ()
{
  std::vector<std::uint32_t> loop (BORDER);
  std::iota (loop.begin (), loop.end (), 0U);
  return loop;
}

// Triangles without their order and orientation.
std::set<std::array<std::uint32_t, 3>>
unordered (const Result& result)
{
  std::set<std::array<std::uint32_t, 3>> triangles;
  for (std::array<std::uint32_t, 3> triangle : result.triangles) {
    std::sort (triangle.begin (), triangle.end ());
    triangles.insert (triangle);
  }
  return triangles;
}

double
farthest (const Result& a, const Result& b)
{
  double distance = 0.0;
  for (std::size_t i = 0; i < a.report.parameters.size (); ++i)
    distance = std::max (distance, (a.report.parameters[i] - b.report.parameters[i]).norm ());
  return distance;
}

// Flips lead to a triangulation whose circumcircles are empty. For points in a plane there is only
// one, whatever the mesh before the flips.
TEST (Choices, MakeTheSameMeshOfAFlatSheet)
{
  const Input input = sheet (0.0);
  Options options;
  options.topology = Topology::DISC;
  options.threads = 1;
  options.disc.boundary.loop = border ();
  const Result expected = reconstruct (input, options);
  ASSERT_EQ (expected.report.status, RunStatus::SUCCESS) << expected.report.message;
  ASSERT_EQ (expected.triangles.size (), 2 * input.positions.size () - 2 - BORDER);
  for (const Neighborhood neighborhood : ALL_NEIGHBORHOODS)
    for (const Weighting weighting : ALL_WEIGHTINGS)
      for (const Domain domain : {Domain::CIRCLE, Domain::OWN_SHAPE}) {
        SCOPED_TRACE (testing::Message () << "neighborhood " << static_cast<int> (neighborhood)
                                          << " weighting " << static_cast<int> (weighting));
        options.neighbors.kind = neighborhood;
        options.disc.weighting = weighting;
        options.disc.domain.curve = domain;
        const Result result = reconstruct (input, options);
        ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
        EXPECT_EQ (unordered (result), unordered (expected));
      }
}

// A flat sheet in its own border is reproduced by any neighbours, and by all weights that reproduce
// their centre.
TEST (Choices, ReproduceAFlatSheetFromAnyNeighborhood)
{
  const Input input = sheet (0.0);
  Options options;
  options.topology = Topology::DISC;
  options.threads = 1;
  options.disc.boundary.loop = border ();
  for (const Neighborhood neighborhood : ALL_NEIGHBORHOODS)
    for (const Weighting weighting : {Weighting::SHAPE_PRESERVING, Weighting::MEAN_VALUE}) {
      options.neighbors.kind = neighborhood;
      options.disc.weighting = weighting;
      const Result result = reconstruct (input, options);
      ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
      // A loop may be laid out in either direction and from any point on: compare distances.
      const std::vector<Eigen::Vector2d>& uv = result.report.parameters;
      double worst = 0.0;
      for (std::size_t i = 0; i < uv.size (); ++i)
        for (const std::size_t corner : {0, 9, 20})
          worst =
              std::max (worst, std::abs ((uv[i] - uv[corner]).norm () -
                                         (input.positions[i] - input.positions[corner]).norm ()));
      EXPECT_LT (worst, 1e-7) << "neighborhood " << static_cast<int> (neighborhood) << " weighting "
                              << static_cast<int> (weighting);
    }
}

TEST (Choices, OfSolverAndOrderingDoNotChangeTheResult)
{
  constexpr double SAME = 1e-12;
  const Input input = sheet (0.7);
  for (const Neighborhood neighborhood : ALL_NEIGHBORHOODS)
    for (const Weighting weighting : ALL_WEIGHTINGS) {
      Options options;
      options.topology = Topology::DISC;
      options.threads = 1;
      options.neighbors.kind = neighborhood;
      options.disc.weighting = weighting;
      options.disc.solver.max_iterations = 100000;
      const Result expected = reconstruct (input, options);
      ASSERT_EQ (expected.report.status, RunStatus::SUCCESS) << expected.report.message;
      for (const Solver solver : ALL_SOLVERS)
        for (const Ordering ordering : ALL_ORDERINGS) {
          if (checkSolver (solver, ordering))
            continue;
          SCOPED_TRACE (testing::Message ()
                        << "neighborhood " << static_cast<int> (neighborhood) << " weighting "
                        << static_cast<int> (weighting) << " solver " << static_cast<int> (solver)
                        << " ordering " << static_cast<int> (ordering));
          options.disc.solver.method = solver;
          options.disc.solver.ordering = ordering;
          const Result result = reconstruct (input, options);
          ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
          EXPECT_LT (farthest (result, expected), SAME);
          EXPECT_EQ (result.triangles, expected.triangles);
          EXPECT_EQ (result.report.statistics.nnz_matrix, expected.report.statistics.nnz_matrix);
          EXPECT_LT (result.report.statistics.relative_residual, 1e-14);
        }
    }
}

TEST (Choices, OfNeighborhoodShowInTheMatrix)
{
  const Input input = sheet (0.7);
  const auto nonzeros = [&input] (Neighborhood neighborhood, double radius) {
    Options options;
    options.topology = Topology::DISC;
    options.disc.boundary.loop = border ();
    options.neighbors.kind = neighborhood;
    options.neighbors.ball_radius = radius;
    const Statistics statistics = reconstruct (input, options).report.statistics;
    return static_cast<double> (statistics.nnz_matrix) / static_cast<double> (statistics.unknowns);
  };
  const double ball = nonzeros (Neighborhood::BALL, 2.5);
  EXPECT_GT (nonzeros (Neighborhood::NEAREST, 2.5),
             2.0 * nonzeros (Neighborhood::NEAREST_DELAUNAY, 2.5));
  EXPECT_GT (ball, 2.0 * nonzeros (Neighborhood::BALL_DELAUNAY, 2.5));
  EXPECT_GT (nonzeros (Neighborhood::BALL, 3.5), 1.2 * ball);
}

TEST (Choices, OfALimitThatIsTooLowAreReported)
{
  Options options;
  options.topology = Topology::DISC;
  options.disc.solver.method = Solver::GAUSS_SEIDEL;
  options.disc.solver.max_iterations = 10;
  const Result result = reconstruct (sheet (0.7), options);
  EXPECT_EQ (result.report.status, RunStatus::NOT_CONVERGED);
  EXPECT_TRUE (result.triangles.empty ());
  EXPECT_NE (result.report.message.find ("Gauss-Seidel"), std::string::npos);
  EXPECT_EQ (result.report.statistics.iterations_u, 10U);
  EXPECT_EQ (result.report.statistics.iterations_v, 10U);
  EXPECT_GT (result.report.statistics.relative_residual, options.disc.solver.tolerance);
}

TEST (Choices, ThatCannotBeAreRefused)
{
  const auto status = [] (const std::function<void (Options&)>& change) {
    Options options;
    options.topology = Topology::DISC;
    change (options);
    return reconstruct (sheet (0.0), options).report.status;
  };
  EXPECT_EQ (status ([] (Options& o) { o.disc.solver.ordering = Ordering::COLAMD; }),
             RunStatus::INVALID_OPTION);
  EXPECT_EQ (status ([] (Options& o) { o.neighbors.ball_radius = 0.9; }),
             RunStatus::INVALID_OPTION);
  EXPECT_EQ (status ([] (Options& o) { o.disc.solver.tolerance = 0.0; }),
             RunStatus::INVALID_OPTION);
  EXPECT_EQ (status ([] (Options& o) { o.disc.solver.max_iterations = 0; }),
             RunStatus::INVALID_OPTION);
  EXPECT_EQ (status ([] (Options& o) { o.disc.solver.ilut_fill = 0; }), RunStatus::INVALID_OPTION);
  EXPECT_EQ (status ([] (Options& o) { o.disc.solver.ilut_drop = -1.0; }),
             RunStatus::INVALID_OPTION);
  EXPECT_EQ (status ([] (Options& o) { o.disc.solver.method = Solver::EIGEN_SPARSE_LU; }),
             RunStatus::SOLVER_UNAVAILABLE);
}

} // namespace
} // namespace pcl::floater
