// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_sets.h"

#include "core/geometry.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace pcl::floater::facing_cases {
namespace {
// The level set of a field by tetrahedra (Kuhn's six of each cube). A closed oriented manifold if
// the field is positive on the border of the box.
class LevelSet
{
public:
  LevelSet (const Field& field, double half, int cells)
      : side_ (cells + 1), half_ (half), step_ (2.0 * half / cells)
  {
    values_.resize (static_cast<std::size_t> (side_) * side_ * side_);
    for (std::size_t v = 0; v < values_.size (); ++v)
      values_[v] = field (at (v));
    for (int z = 0; z < cells; ++z)
      for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x)
          addCube (x, y, z);
  }

  Soup take () { return std::move (soup_); }

private:
  std::size_t index (int x, int y, int z) const
  {
    return (static_cast<std::size_t> (z) * side_ + y) * side_ + x;
  }

  Vector at (std::size_t v) const
  {
    const auto side = static_cast<std::size_t> (side_);
    return Vector::Constant (-half_) + step_ * Vector (static_cast<double> (v % side),
                                                       static_cast<double> (v / side % side),
                                                       static_cast<double> (v / side / side));
  }

  void addCube (int x, int y, int z)
  {
    static constexpr std::array<std::array<int, 3>, 6> ORDERS{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (const std::array<int, 3>& order : ORDERS) {
      std::array<int, 3> corner{x, y, z};
      std::array<std::size_t, 4> tetrahedron{};
      for (std::size_t i = 0; i < 4; ++i) {
        tetrahedron[i] = index (corner[0], corner[1], corner[2]);
        if (i < 3)
          ++corner[static_cast<std::size_t> (order[i])];
      }
      addTetrahedron (tetrahedron);
    }
  }

  void addTetrahedron (const std::array<std::size_t, 4>& corners)
  {
    std::vector<std::size_t> in, out;
    for (const std::size_t v : corners)
      (values_[v] < 0.0 ? in : out).push_back (v);
    if (in.empty () || out.empty ())
      return;
    Vector outwards = Vector::Zero ();
    for (const std::size_t v : out)
      outwards += at (v) / static_cast<double> (out.size ());
    for (const std::size_t v : in)
      outwards -= at (v) / static_cast<double> (in.size ());
    if (in.size () == 2) {
      const std::array<Index, 4> q{cut (in[0], out[0]), cut (in[0], out[1]), cut (in[1], out[1]),
                                   cut (in[1], out[0])};
      add ({q[0], q[1], q[2]}, outwards);
      add ({q[0], q[2], q[3]}, outwards);
    }
    else if (in.size () == 1)
      add ({cut (in[0], out[0]), cut (in[0], out[1]), cut (in[0], out[2])}, outwards);
    else
      add ({cut (in[0], out[0]), cut (in[1], out[0]), cut (in[2], out[0])}, outwards);
  }

  void add (Triangle t, const Vector& outwards)
  {
    const std::vector<Vector>& p = soup_.positions;
    if (areaVector (p[t[0]], p[t[1]], p[t[2]]).dot (outwards) < 0.0)
      std::swap (t[1], t[2]);
    soup_.triangles.push_back (t);
  }

  Index cut (std::size_t a, std::size_t b)
  {
    const auto [first, last] = std::minmax (a, b);
    const auto [place, is_new] = points_.try_emplace (first * values_.size () + last,
                                                      static_cast<Index> (soup_.positions.size ()));
    if (is_new) {
      // Not so near the ends that triangles have no area.
      const double share =
          std::clamp (values_[first] / (values_[first] - values_[last]), 0.05, 0.95);
      soup_.positions.emplace_back ((1.0 - share) * at (first) + share * at (last));
    }
    return place->second;
  }

  int side_;
  double half_, step_;
  std::vector<double> values_;
  std::unordered_map<std::size_t, Index> points_;
  Soup soup_;
};
} // namespace

Field
ellipsoid (const Vector& centre, const Vector& radii)
{
  return [centre, radii] (const Vector& p) {
    const Vector q = (p - centre).cwiseQuotient (radii);
    return (q.norm () - 1.0) * radii.minCoeff ();
  };
}

Field
slab (const Vector& centre, const Vector& half, const Eigen::Matrix3d& axes)
{
  return [centre, half, axes] (const Vector& p) {
    const Vector q = (axes.transpose () * (p - centre)).cwiseAbs () - half;
    return q.cwiseMax (0.0).norm () + std::min (0.0, q.maxCoeff ());
  };
}

Field
ring (const Vector& centre, double radius, double tube, const Eigen::Matrix3d& axes)
{
  return [centre, radius, tube, axes] (const Vector& p) {
    const Vector q = axes.transpose () * (p - centre);
    return std::hypot (q.head<2> ().norm () - radius, q.z ()) - tube;
  };
}

Field
unite (std::vector<Field> parts)
{
  return [parts = std::move (parts)] (const Vector& p) {
    double least = parts.front () (p);
    for (const Field& part : parts)
      least = std::min (least, part (p));
    return least;
  };
}

Soup
levelSet (const Field& field)
{
  constexpr int CELLS = 40;
  return LevelSet (field, 1.3, CELLS).take ();
}

} // namespace pcl::floater::facing_cases
