// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exact.h"
#include "core/order_statistics.h"
#include "texture/chart_layout.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

namespace pcl::floater {
namespace {
// Not CHOLMOD's, which starts threads of OpenMP. info () tells if rounding has made it indefinite.
using Cholesky = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

// One row for each vertex, as in a list of coordinates.
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

constexpr double MEAN_WEIGHT = 1e-8; // of all vertices in the Laplacian: it must not be singular
constexpr double SUFFICIENT = 1e-4;  // of the decrease predicted by the slope (Armijo)
constexpr double SHORTEST = 1e-6;    // useful step
constexpr int STEPS_PER_LOOK = 8;    // between tests of the boundary
constexpr double SAFE_SHARE = 0.8;   // of the step to the first triangle without area
constexpr double ENOUGH = 4.3; // distortion above which Newton's method follows; the minimum is 4
constexpr double LEAST_NEWTON_PROGRESS = 0.02; // as DescentLimits::least_progress
// Initial relative increase of the diagonal of a Hessian if rounding leaves no useful step
// (Levenberg). Just above the rounding of a double; increased up to 1.
constexpr double LEAST_DAMPING = 1e-15;
constexpr double MORE_DAMPING = 1000.0; // factor of each increase

Eigen::Matrix2d
edgesOf (const Coordinates& x, const Triangle& c)
{
  Eigen::Matrix2d edges;
  edges.col (0) = (x.row (c[1]) - x.row (c[0])).transpose ();
  edges.col (1) = (x.row (c[2]) - x.row (c[0])).transpose ();
  return edges;
}

using Entries = std::vector<Eigen::Triplet<double>>; // of the lower triangle of a symmetric matrix

template <std::size_t N>
void
addBlock (const std::array<Index, N>& rows, const Eigen::Matrix<double, N, N>& block,
          Entries& entries)
{
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j)
      if (rows[i] >= rows[j])
        entries.emplace_back (static_cast<int> (rows[i]), static_cast<int> (rows[j]),
                              block (static_cast<Eigen::Index> (i), static_cast<Eigen::Index> (j)));
}

Eigen::SparseMatrix<double>
makeMatrix (Entries& entries, Eigen::Index size)
{
  for (int i = 0; i < size; ++i)
    entries.emplace_back (i, i, MEAN_WEIGHT);
  Eigen::SparseMatrix<double> matrix (size, size);
  matrix.setFromTriplets (entries.begin (), entries.end ());
  return matrix;
}

struct Descent
{
  const MeshPiece& chart;
  const RestShapes& rest;

  // A step along a direction that lowers the energy enough. Returns false if there is none.
  // \param[in,out] x, energy set to the end of the step
  bool goAlong (const Coordinates& direction, const Coordinates& gradient, Coordinates& x,
                double& energy) const
  {
    const double slope = gradient.cwiseProduct (direction).sum ();
    if (!(slope < 0.0))
      return false;
    double length = std::min (1.0, SAFE_SHARE * reach (x, direction));
    for (; length > SHORTEST; length *= 0.5) {
      Coordinates next = x + length * direction;
      const double next_energy = energyOf (next);
      if (next_energy <= energy + SUFFICIENT * length * slope && next_energy < energy) {
        x = std::move (next);
        energy = next_energy;
        return true;
      }
    }
    return false;
  }

  // Newton's method, with the Hessian of each triangle made positive by its known eigenvectors
  // (Smith, de Goes, Kim 2019). Slower per step, but for triangles too compressed for the Laplacian.
  void newton (int steps, const RunContext& run, Coordinates& x, double& energy) const
  {
    Cholesky solver;
    for (int step = 0; step < steps; ++step) {
      run.poll ();
      Eigen::SparseMatrix<double> hessian = hessianOf (x);
      if (step == 0)
        solver.analyzePattern (hessian);
      const Coordinates gradient = gradientOf (x);
      const double last_energy = energy;
      const auto goByHessian = [&] {
        solver.factorize (hessian);
        if (solver.info () != Eigen::Success)
          return false;
        const Eigen::Map<const Eigen::VectorXd> slopes (gradient.data (), gradient.size ());
        const Eigen::VectorXd down = -solver.solve (slopes);
        return goAlong (Eigen::Map<const Coordinates> (down.data (), x.rows (), 2), gradient, x,
                        energy);
      };
      double damping = 0.0;
      while (!goByHessian ()) {
        const double more = std::max (LEAST_DAMPING, MORE_DAMPING * damping);
        if (more > 1.0)
          return;
        hessian.diagonal () *= (1.0 + more) / (1.0 + damping);
        damping = more;
      }
      if (energy < ENOUGH || last_energy - energy <= LEAST_NEWTON_PROGRESS * (energy - 4.0))
        return;
    }
  }

  Eigen::SparseMatrix<double> hessianOf (const Coordinates& x) const
  {
    Entries entries;
    constexpr std::size_t PER_TRIANGLE = 21;
    entries.reserve (PER_TRIANGLE * rest.shapes.size () + 2 * static_cast<std::size_t> (x.rows ()));
    for (std::size_t t = 0; t < rest.shapes.size (); ++t) {
      const RestShape& shape = rest.shapes[t];
      const Triangle& c = chart.mesh.triangles[t];
      const Eigen::JacobiSVD<Eigen::Matrix2d> svd (edgesOf (x, c) * shape.to_unit,
                                                   Eigen::ComputeFullU | Eigen::ComputeFullV);
      const Eigen::Matrix2d &u = svd.matrixU (), &v = svd.matrixV ();
      const double p = svd.singularValues ()[0], q = svd.singularValues ()[1];
      const auto slopeOf = [] (double s) { return 2.0 * s - 2.0 / (s * s * s); };
      const auto curvatureOf = [] (double s) { return 2.0 + 6.0 / (s * s * s * s); };
      const double half = std::sqrt (0.5), cube = p * q * p * q * p * q;
      const std::array<double, 4> values{curvatureOf (p), curvatureOf (q),
                                         std::max (0.0, (slopeOf (p) + slopeOf (q)) / (p + q)),
                                         2.0 + 2.0 * (p * p + p * q + q * q) / cube};
      using Mode = Eigen::Matrix2d;
      const std::array<Mode, 4> modes{Mode{{1.0, 0.0}, {0.0, 0.0}}, Mode{{0.0, 0.0}, {0.0, 1.0}},
                                      Mode{{0.0, -half}, {half, 0.0}},
                                      Mode{{0.0, half}, {half, 0.0}}};
      Eigen::Matrix<double, 6, 6> block = Eigen::Matrix<double, 6, 6>::Zero ();
      const Eigen::Matrix<double, 3, 2> slopes = slopesOf (shape);
      for (std::size_t m = 0; m < 4; ++m) {
        // Derivative of the energy's argument in this mode by each coordinate of the corners.
        const Eigen::Matrix<double, 2, 3> change =
            u * modes[m] * v.transpose () * slopes.transpose ();
        const Eigen::Map<const Eigen::Matrix<double, 6, 1>> change_of (change.data ());
        block += shape.area * values[m] * change_of * change_of.transpose ();
      }
      addBlock<6> ({2 * c[0], 2 * c[0] + 1, 2 * c[1], 2 * c[1] + 1, 2 * c[2], 2 * c[2] + 1}, block,
                   entries);
    }
    return makeMatrix (entries, 2 * x.rows ());
  }

  // Gradients of the three hat functions of a triangle, in rows.
  static Eigen::Matrix<double, 3, 2> slopesOf (const RestShape& shape)
  {
    Eigen::Matrix<double, 3, 2> slopes;
    slopes.bottomRows<2> () = shape.to_unit;
    slopes.row (0) = -slopes.row (1) - slopes.row (2);
    return slopes;
  }

  // The Laplacian of the shapes: proportional to the Hessian of the energy near its minimum.
  Eigen::SparseMatrix<double> laplacian () const
  {
    Entries entries;
    entries.reserve (9 * rest.shapes.size () + chart.positions.size ());
    for (std::size_t t = 0; t < rest.shapes.size (); ++t) {
      const Eigen::Matrix<double, 3, 2> slopes = slopesOf (rest.shapes[t]);
      addBlock<3> (chart.mesh.triangles[t], rest.shapes[t].area * slopes * slopes.transpose (),
                   entries);
    }
    return makeMatrix (entries, static_cast<Eigen::Index> (chart.positions.size ()));
  }

  // Infinite if a triangle has no area.
  double energyOf (const Coordinates& x) const
  {
    double energy = 0.0;
    for (std::size_t t = 0; t < rest.shapes.size (); ++t) {
      const Eigen::Matrix2d map = edgesOf (x, chart.mesh.triangles[t]) * rest.shapes[t].to_unit;
      const double determinant = map.determinant ();
      if (!(determinant > 0.0))
        return std::numeric_limits<double>::infinity ();
      energy +=
          rest.shapes[t].area * map.squaredNorm () * (1.0 + 1.0 / (determinant * determinant));
    }
    return energy;
  }

  Coordinates gradientOf (const Coordinates& x) const
  {
    Coordinates gradient = Coordinates::Zero (x.rows (), 2);
    for (std::size_t t = 0; t < rest.shapes.size (); ++t) {
      const RestShape& shape = rest.shapes[t];
      const Triangle& c = chart.mesh.triangles[t];
      const Eigen::Matrix2d map = edgesOf (x, c) * shape.to_unit;
      const double determinant = map.determinant (), squares = map.squaredNorm ();
      const double inverse = 1.0 / (determinant * determinant);
      Eigen::Matrix2d cofactors;
      cofactors << map (1, 1), -map (1, 0), -map (0, 1), map (0, 0);
      const Eigen::Matrix2d of_map =
          shape.area *
          (2.0 * (1.0 + inverse) * map - (2.0 * squares * inverse / determinant) * cofactors);
      const Eigen::Matrix2d of_edges = of_map * shape.to_unit.transpose ();
      gradient.row (c[1]) += of_edges.col (0).transpose ();
      gradient.row (c[2]) += of_edges.col (1).transpose ();
      gradient.row (c[0]) -= (of_edges.col (0) + of_edges.col (1)).transpose ();
    }
    return gradient;
  }

  // Largest multiple of the direction before a triangle has no area.
  double reach (const Coordinates& x, const Coordinates& direction) const
  {
    double least = std::numeric_limits<double>::infinity ();
    for (const Triangle& triangle : chart.mesh.triangles) {
      const Eigen::Matrix2d e = edgesOf (x, triangle), d = edgesOf (direction, triangle);
      // Area a t^2 + b t + c, positive at 0.
      const double a = d.determinant (), c = e.determinant ();
      const double b = cross (Vector2d (e.col (0)), Vector2d (d.col (1))) +
                       cross (Vector2d (d.col (0)), Vector2d (e.col (1)));
      const double discriminant = b * b - 4.0 * a * c;
      if (discriminant < 0.0)
        continue;
      const double root = std::sqrt (discriminant);
      // The smaller positive root, without cancellation.
      const double q = -0.5 * (b + (b < 0.0 ? -root : root));
      for (const double t : {q / a, c / q})
        if (t > 0.0)
          least = std::min (least, t);
    }
    return least;
  }
};

// Exact arithmetic has no NaN.
bool
areFinite (const std::vector<Vector2d>& uv)
{
  return std::all_of (uv.begin (), uv.end (), [] (const auto& p) { return p.allFinite (); });
}

} // namespace

void
descendDistortion (const MeshPiece& chart, const RestShapes& rest, const DescentLimits& limits,
                   const RunContext& run, std::vector<Vector2d>& uv)
{
  const Descent descent{chart, rest};
  const auto vertices = static_cast<Eigen::Index> (uv.size ());
  Coordinates x = Eigen::Map<const Coordinates> (uv.front ().data (), vertices, 2);
  // Scales to least energy.
  double direct = 0.0, inverse = 0.0;
  for (std::size_t t = 0; t < rest.shapes.size (); ++t) {
    const Eigen::Matrix2d map = edgesOf (x, chart.mesh.triangles[t]) * rest.shapes[t].to_unit;
    const double squares = map.squaredNorm (), determinant = map.determinant ();
    direct += rest.shapes[t].area * squares;
    inverse += rest.shapes[t].area * squares / (determinant * determinant);
  }
  const double factor = std::sqrt (std::sqrt (inverse / direct));
  if (std::isfinite (factor) && factor > 0.0)
    x *= factor;
  const auto accept = [&] {
    std::vector<Vector2d> next (uv.size ());
    Eigen::Map<Coordinates> (next.front ().data (), vertices, 2) = x;
    if (!isSimple (chart.loop, next))
      return false;
    uv = std::move (next);
    return true;
  };
  if (!accept ())
    return;
  const Cholesky laplacian (descent.laplacian ());
  if (laplacian.info () != Eigen::Success)
    return;
  double energy = descent.energyOf (x);
  // Steps along the gradient with regard to the Laplacian. Ends if the boundary crosses itself.
  const auto descend = [&] {
    for (int step = 1; step <= limits.steps; ++step) {
      run.poll ();
      const Coordinates gradient = descent.gradientOf (x), direction = -laplacian.solve (gradient);
      const double last_energy = energy;
      if (!descent.goAlong (direction, gradient, x, energy) ||
          last_energy - energy <= limits.least_progress * (energy - 4.0) ||
          (step % STEPS_PER_LOOK == 0 && !accept ()))
        return;
    }
  };
  descend ();
  if (energy > ENOUGH) {
    descent.newton (limits.newton_steps, run, x, energy);
    if (accept ())
      descend ();
  }
  accept ();
}

bool
isSimple (const std::vector<Index>& loop, const std::vector<Vector2d>& uv)
{
  const std::vector<Vector2d> polygon = valuesAt (uv, loop);
  return areFinite (polygon) && isSimplePolygon (polygon);
}

bool
isUpright (const std::vector<Triangle>& triangles, const std::vector<Vector2d>& uv)
{
  return areFinite (uv) && flippedTriangles (triangles, uv).empty ();
}

} // namespace pcl::floater
