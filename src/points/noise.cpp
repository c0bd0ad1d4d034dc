// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/noise.h"

#include "core/parallel.h"
#include "core/plane_fit.h"
#include "core/tangent_frame.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t SAMPLES = 2048;    // points to measure at: the median is then good to 2 %
constexpr std::size_t LOOKED_AT = 20;    // nearest neighbours, however many there are
constexpr std::size_t CORE = 8;          // nearest points of the small plane
constexpr std::size_t SPACING_OF = 6;    // nearest points whose mean distance is the local spacing
constexpr double PLANE_UNKNOWNS = 3.0;   // of a plane over a plane
constexpr double QUADRIC_UNKNOWNS = 6.0; // of a quadric over a plane

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// The point itself (the origin) and its neighbours, in local spacings.
void
localOffsets (const std::vector<Eigen::Vector3d>& positions, Index p, Row neighbors,
              std::vector<Eigen::Vector3d>& offsets)
{
  offsets.assign (1, Eigen::Vector3d::Zero ());
  double sum = 0.0;
  for (std::size_t i = 0; i < neighbors.size (); ++i) {
    offsets.emplace_back (positions[neighbors[i]] - positions[p]);
    sum += i < SPACING_OF ? offsets.back ().norm () : 0.0;
  }
  const double spacing = sum / static_cast<double> (std::min (SPACING_OF, neighbors.size ()));
  for (Eigen::Vector3d& offset : offsets)
    offset /= spacing;
}

// Root mean square distance to the plane of the first `count` points, for the unknowns it takes.
double
planeResidual (const std::vector<Eigen::Vector3d>& offsets, std::size_t count)
{
  PlaneFit fit;
  for (std::size_t i = 0; i < count; ++i)
    fit.add (offsets[i]);
  const double points = static_cast<double> (count);
  return std::sqrt (fit.plane ().mean_square * points / (points - PLANE_UNKNOWNS));
}

// The same to the quadric z = a + b x + c y + d x^2 + e x y + f y^2 over the plane of all points.
double
quadricResidual (const std::vector<Eigen::Vector3d>& offsets)
{
  PlaneFit fit;
  for (const Eigen::Vector3d& offset : offsets)
    fit.add (offset);
  const TangentFrame frame (fit.plane ().normal);
  Matrix6d normal_matrix = Matrix6d::Zero ();
  Vector6d right_side = Vector6d::Zero ();
  double sqr_heights = 0.0;
  for (const Eigen::Vector3d& offset : offsets) {
    const Eigen::Vector2d q = frame.project (offset);
    const double height = frame.normal.dot (offset);
    Vector6d terms;
    terms << 1.0, q.x (), q.y (), q.x () * q.x (), q.x () * q.y (), q.y () * q.y ();
    normal_matrix.noalias () += terms * terms.transpose ();
    right_side += height * terms;
    sqr_heights += height * height;
  }
  const double explained = right_side.dot (normal_matrix.ldlt ().solve (right_side));
  const double points = static_cast<double> (offsets.size ());
  return std::sqrt (std::max (0.0, sqr_heights - explained) / (points - QUADRIC_UNKNOWNS));
}

double
medianOf (std::vector<double>& values)
{
  const auto middle = values.begin () + static_cast<std::ptrdiff_t> (values.size () / 2);
  std::nth_element (values.begin (), middle, values.end ());
  return *middle;
}

// Projects one point; scratch is reused from point to point.
class Projector
{
public:
  Projector (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors)
      : positions_ (positions), neighbors_ (neighbors)
  {
  }

  // Tukey's weights, which vanish at WIDTH median distances: 3 standard deviations if normal.
  Eigen::Vector3d project (Index p)
  {
    constexpr int PASSES = 3;
    constexpr double WIDTH = 4.5;
    constexpr double NARROWNESS = 4.0;
    const Row row = neighbors_.first (p, LOOKED_AT);
    if (row.size () < 3)
      return positions_[p];
    offsets_.assign (1, Eigen::Vector3d::Zero ());
    for (Index q : row)
      offsets_.emplace_back (positions_[q] - positions_[p]);
    // Begin with what is near: another sheet is not.
    const double sqr_reach = offsets_.back ().squaredNorm ();
    weights_.clear ();
    for (const Eigen::Vector3d& offset : offsets_)
      weights_.push_back (std::exp (-NARROWNESS * offset.squaredNorm () / sqr_reach));
    distances_.resize (offsets_.size ());
    Plane plane;
    for (int pass = 0; pass < PASSES; ++pass) {
      PlaneFit fit;
      for (std::size_t i = 0; i < offsets_.size (); ++i)
        fit.add (offsets_[i], weights_[i]);
      plane = fit.plane ();
      for (std::size_t i = 0; i < offsets_.size (); ++i)
        distances_[i] = std::abs (plane.height (offsets_[i]));
      sorted_ = distances_;
      const double width = WIDTH * medianOf (sorted_);
      if (width <= 0.0)
        break; // most lie exactly in the plane
      for (std::size_t i = 0; i < offsets_.size (); ++i) {
        const double share = std::min (1.0, distances_[i] / width);
        weights_[i] = (1.0 - share * share) * (1.0 - share * share);
      }
    }
    return positions_[p] - plane.normal * plane.height (Eigen::Vector3d::Zero ());
  }

private:
  const std::vector<Eigen::Vector3d>& positions_;
  const CsrLists& neighbors_;
  std::vector<Eigen::Vector3d> offsets_;
  std::vector<double> weights_, distances_, sorted_;
};

} // namespace

bool
isStrongNoise (double noise, std::size_t points, const NoiseLimits& limits)
{
  return noise >= limits.strong && points >= limits.fewest_points;
}

double
measureNoise (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const RunContext& run)
{
  const std::size_t n = positions.size ();
  const std::size_t step = std::max<std::size_t> (1, n / SAMPLES);
  std::vector<double> residuals (n / step, -1.0);
  parallelRanges (run, residuals.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Eigen::Vector3d> offsets;
    for (std::size_t sample = first; sample < last; ++sample) {
      const Index p = static_cast<Index> (sample * step);
      if (neighbors.first (p, LOOKED_AT).size () <= static_cast<std::size_t> (PLANE_UNKNOWNS))
        continue;
      localOffsets (positions, p, neighbors.first (p, LOOKED_AT), offsets);
      residuals[sample] = planeResidual (offsets, std::min (CORE + 1, offsets.size ()));
      if (offsets.size () > CORE + 1) {
        const double quadric = quadricResidual (offsets);
        if (quadric < residuals[sample]) // not if the points do not determine one
          residuals[sample] = quadric;
      }
    }
  });
  residuals.erase (std::remove (residuals.begin (), residuals.end (), -1.0), residuals.end ());
  return residuals.empty () ? 0.0 : medianOf (residuals);
}

std::vector<Eigen::Vector3d>
projectOntoPlanes (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                   const RunContext& run)
{
  std::vector<Eigen::Vector3d> projected (positions.size ());
  parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
    Projector projector (positions, neighbors);
    for (std::size_t p = first; p < last; ++p)
      projected[p] = projector.project (static_cast<Index> (p));
  });
  return projected;
}

} // namespace floater
} // namespace pcl
