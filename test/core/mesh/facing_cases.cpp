// SPDX-License-Identifier: GPL-3.0-or-later
#include "facing_cases.h"

#include "core/geometry.h"
#include "mesh/triangle_rays.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace pcl
{
namespace floater
{
namespace facing_cases
{
namespace
{
using Positions = std::vector<Eigen::Vector3d>;
using Vector = Eigen::Vector3d;
using Field = std::function<double (const Vector&)>; // below zero inside

struct Soup
{
  Positions positions;
  std::vector<Triangle> triangles;
};

// ---- random numbers

double
between (RandomStream& random, double low, double high)
{
  return low + (high - low) * random.uniform ();
}

Vector
randomDirection (RandomStream& random)
{
  return Vector (random.normal (), random.normal (), random.normal ()).normalized ();
}

Eigen::Matrix3d
randomRotation (RandomStream& random)
{
  return Eigen::Quaterniond (random.normal (), random.normal (), random.normal (), random.normal ())
      .normalized ()
      .toRotationMatrix ();
}

// Around z by any angle, then tilted by up to some degrees.
Eigen::Matrix3d
randomTilt (RandomStream& random, double degrees)
{
  const Eigen::AngleAxisd around (between (random, 0.0, 2.0 * PI), Vector::UnitZ ());
  const Eigen::AngleAxisd tilt (between (random, 0.0, degrees * DEGREE),
                                Vector (random.normal (), random.normal (), 0.0).normalized ());
  return (tilt * around).toRotationMatrix ();
}

// ---- fields

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
    const Positions& p = soup_.positions;
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

// ---- meshes

// Takes out triangles, and all around points that have several fans left, until there are none.
void
cutOut (Soup& soup, std::vector<std::uint8_t> is_out)
{
  for (;;) {
    std::vector<Triangle> left;
    for (std::size_t t = 0; t < soup.triangles.size (); ++t)
      if (is_out[t] == 0)
        left.push_back (soup.triangles[t]);
    soup.triangles = std::move (left);
    // A fan has as many beginnings, corners with no triangle before them, as it has ends: one or 0.
    std::vector<std::map<Index, int>> ends (soup.positions.size ());
    std::vector<int> degree (soup.positions.size (), 0);
    for (const Triangle& t : soup.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        ++ends[t[i]][t[(i + 1) % 3]];
        --ends[t[i]][t[(i + 2) % 3]];
        ++degree[t[i]];
      }
    std::vector<std::uint8_t> is_pinched (soup.positions.size (), 0);
    bool any = false;
    for (std::size_t p = 0; p < ends.size (); ++p) {
      const auto begins = std::count_if (ends[p].begin (), ends[p].end (),
                                         [] (const auto& end) { return end.second > 0; });
      is_pinched[p] = begins > 1 ? 1 : 0;
      any = any || begins > 1;
    }
    if (!any)
      return;
    is_out.assign (soup.triangles.size (), 0);
    for (std::size_t t = 0; t < soup.triangles.size (); ++t)
      for (const Index p : soup.triangles[t])
        is_out[t] |= is_pinched[p];
  }
}

FacingCase
asCase (Soup soup)
{
  FacingCase one;
  one.positions = std::move (soup.positions);
  one.mesh.triangles = std::move (soup.triangles);
  if (!one.mesh.connect (one.positions.size (), 1))
    throw std::logic_error ("a generated mesh is no oriented manifold");
  return one;
}

double
areaOf (const Soup& soup, const Triangle& t)
{
  return areaVector (soup.positions[t[0]], soup.positions[t[1]], soup.positions[t[2]]).norm ();
}

// Removes the components but those of at least this many triangles, or all but the largest.
void
dropSmall (Soup& soup, std::size_t least)
{
  const FacingCase one = asCase (soup);
  const MeshComponents components = findComponents (one.mesh, 1);
  std::vector<std::size_t> sizes (components.count, 0);
  for (const Index c : components.of_triangle)
    ++sizes[c];
  if (least == 0)
    least = sizes.empty () ? 0 : *std::max_element (sizes.begin (), sizes.end ());
  std::vector<std::uint8_t> is_out;
  for (const Index c : components.of_triangle)
    is_out.push_back (sizes[c] < least ? 1 : 0);
  cutOut (soup, is_out);
}

// Round windows about random triangles. \param share of the area, of all windows together
void
cutWindows (Soup& soup, int windows, double share, RandomStream& random)
{
  const FacingCase one = asCase (soup);
  double area = 0.0;
  for (const Triangle& t : soup.triangles)
    area += areaOf (soup, t);
  std::vector<std::uint8_t> is_out (soup.triangles.size (), 0);
  for (int w = 0; w < windows; ++w) {
    const auto seed = static_cast<Index> (random.below (soup.triangles.size ()));
    std::vector<std::uint8_t> is_seen (soup.triangles.size (), 0);
    std::vector<Index> ring{seed};
    is_seen[seed] = 1;
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size () && sum < share * area / windows; ++i) {
      is_out[ring[i]] = 1;
      sum += areaOf (soup, soup.triangles[ring[i]]);
      for (const Index u : one.mesh.neighbors[ring[i]])
        if (u != NONE && is_seen[u] == 0) {
          is_seen[u] = 1;
          ring.push_back (u);
        }
    }
  }
  cutOut (soup, is_out);
  dropSmall (soup, 0);
}

void
transform (Soup& soup, const Eigen::Matrix3d& matrix)
{
  for (Vector& p : soup.positions)
    p = matrix * p;
}

void
turnRound (Soup& soup)
{
  for (Triangle& t : soup.triangles)
    std::swap (t[1], t[2]);
}

void
append (Soup& soup, const Soup& more)
{
  const auto offset = static_cast<Index> (soup.positions.size ());
  soup.positions.insert (soup.positions.end (), more.positions.begin (), more.positions.end ());
  for (const Triangle& t : more.triangles)
    soup.triangles.push_back ({t[0] + offset, t[1] + offset, t[2] + offset});
}

// A grid of u and v from 0 to 1, the front where u, v and the normal are right-handed.
Soup
grid (const std::function<Vector (double, double)>& shape, int columns, int rows, bool wraps)
{
  Soup soup;
  const int width = wraps ? columns : columns + 1;
  for (int v = 0; v <= rows; ++v)
    for (int u = 0; u < width; ++u)
      soup.positions.push_back (
          shape (static_cast<double> (u) / columns, static_cast<double> (v) / rows));
  const auto at = [&] (int u, int v) { return static_cast<Index> (v * width + u % width); };
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u) {
      soup.triangles.push_back ({at (u, v), at (u + 1, v), at (u + 1, v + 1)});
      soup.triangles.push_back ({at (u, v), at (u + 1, v + 1), at (u, v + 1)});
    }
  return soup;
}

// ---- shapes

constexpr int CELLS = 40, CAP_SIDE = 30;

Field
randomBlob (RandomStream& random, int most_parts)
{
  std::vector<Field> parts{
      ellipsoid (Vector::Zero (), {between (random, 0.4, 0.7), between (random, 0.4, 0.7),
                                   between (random, 0.4, 0.7)})};
  for (auto i = random.below (static_cast<std::size_t> (most_parts) + 1); i > 0; --i)
    parts.push_back (ellipsoid (
        0.5 * randomDirection (random),
        {between (random, 0.15, 0.4), between (random, 0.15, 0.4), between (random, 0.15, 0.4)}));
  return unite (std::move (parts));
}

Field
randomWingedBody (RandomStream& random)
{
  const double size = between (random, 0.15, 0.6);
  std::vector<Field> parts{ellipsoid (Vector::Zero (), {between (random, 0.7, 1.0) * size,
                                                        between (random, 0.7, 1.0) * size, size})};
  for (auto i = random.below (5); i > 0; --i) {
    const Eigen::Matrix3d axes = randomRotation (random);
    parts.push_back (slab (between (random, 0.1, 0.5) * axes.col (0),
                           {between (random, 0.2, 0.5), between (random, 0.15, 0.5), 0.07}, axes));
  }
  for (auto i = random.below (3); i > 0; --i)
    parts.push_back (ring (0.6 * randomDirection (random), between (random, 0.2, 0.35), 0.08,
                           randomRotation (random)));
  return unite (std::move (parts));
}

Soup
levelSet (const Field& field)
{
  return LevelSet (field, 1.3, CELLS).take ();
}

// Flattened along one axis, which makes all parts thinner.
Eigen::Matrix3d
flattening (RandomStream& random, double least)
{
  const Eigen::Matrix3d axes = randomRotation (random);
  const Vector scale (1.0, between (random, 0.6, 1.0), between (random, least, 1.0));
  return axes * scale.asDiagonal () * axes.transpose ();
}

using Height = std::function<double (double, double)>;

// Heights on the unit square, of a root mean square slope up to 45 degrees.
Height
randomHeights (RandomStream& random)
{
  struct Wave
  {
    double x, y, phase, height;
  };
  std::vector<Wave> waves;
  const double roughness = between (random, 0.5, 1.5);
  for (int i = 0; i < 12; ++i) {
    const double frequency = std::pow (2.0, between (random, 0.0, 3.5));
    const double angle = between (random, 0.0, 2.0 * PI);
    waves.push_back ({2.0 * PI * frequency * std::cos (angle),
                      2.0 * PI * frequency * std::sin (angle), between (random, 0.0, 2.0 * PI),
                      std::pow (frequency, -roughness)});
  }
  double sqr_slope = 0.0;
  for (const Wave& w : waves)
    sqr_slope += 0.5 * w.height * w.height * (w.x * w.x + w.y * w.y);
  const double scale =
      std::tan (between (random, 0.0, 45.0) * DEGREE) / std::max (1e-9, std::sqrt (sqr_slope));
  const bool has_steps = random.below (4) == 0;
  // A pit or hill with a flat floor, of slopes up to 45 degrees.
  const double floor = between (random, 0.0, 0.3), rim = between (random, floor + 0.05, 0.5);
  const double depth = random.below (2) == 0
                           ? std::tan (between (random, -45.0, 45.0) * DEGREE) * (rim - floor)
                           : 0.0;
  return [=] (double x, double y) {
    double z = 0.0;
    for (const Wave& w : waves)
      z += scale * w.height * std::sin (w.x * x + w.y * y + w.phase);
    if (has_steps) {
      const double step = 0.05, rest = z / step - std::floor (z / step);
      z = step * (std::floor (z / step) + std::min (1.0, 3.0 * rest));
    }
    const double r = std::hypot (x - 0.5, y - 0.5);
    return (depth != 0.0 ? 0.3 * z : z) + depth * std::clamp ((rim - r) / (rim - floor), 0.0, 1.0);
  };
}

Soup
heightField (const Height& height, double aspect, int side)
{
  return grid ([&] (double u, double v) { return Vector (u, aspect * v, height (u, aspect * v)); },
               side, std::max (4, static_cast<int> (aspect * side)), false);
}

// A cap around -z, its concave side up; the front is outside.
Soup
cap (double share, int side)
{
  const double end = std::acos (1.0 - 2.0 * share);
  return grid (
      [end] (double u, double v) {
        const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
        const Eigen::Vector2d disc (y * std::sqrt (1.0 - 0.5 * x * x),
                                    x * std::sqrt (1.0 - 0.5 * y * y));
        const double angle = end * disc.norm ();
        const Eigen::Vector2d around = disc.norm () > 0.0 ? disc.normalized () : disc;
        return Vector (around.x () * std::sin (angle), around.y () * std::sin (angle),
                       -std::cos (angle));
      },
      side, side, false);
}

// What is seen of a closed surface from far away along -direction.
void
keepSeen (Soup& soup, const Vector& direction)
{
  const TriangleRays rays (soup.triangles, soup.positions, 1);
  std::vector<std::uint8_t> is_out (soup.triangles.size (), 0);
  for (Index t = 0; t < soup.triangles.size (); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const Positions& p = soup.positions;
    const Vector normal = areaVector (p[a], p[b], p[c]).normalized ();
    const Vector middle = (p[a] + p[b] + p[c]) / 3.0;
    bool is_hidden = normal.dot (direction) < 0.1; // grazing rays return nothing
    if (!is_hidden)
      rays.forHits (middle, direction,
                    [&] (Index other, double) { return is_hidden = other != t; });
    is_out[t] = is_hidden ? 1 : 0;
  }
  cutOut (soup, is_out);
  dropSmall (soup, 0);
}

void
cutBelow (Soup& soup, const Vector& direction, double level)
{
  std::vector<std::uint8_t> is_out;
  for (const Triangle& t : soup.triangles) {
    const bool is_below = std::any_of (
        t.begin (), t.end (), [&] (Index p) { return soup.positions[p].dot (direction) < level; });
    is_out.push_back (is_below ? 1 : 0);
  }
  cutOut (soup, is_out);
  dropSmall (soup, 0);
}

// Takes out bands along planes.
void
tear (Soup& soup, int cuts, double width, RandomStream& random)
{
  Eigen::AlignedBox3d box;
  for (const Triangle& t : soup.triangles)
    for (const Index p : t)
      box.extend (soup.positions[p]);
  std::vector<std::uint8_t> is_out (soup.triangles.size (), 0);
  for (int i = 0; i < cuts; ++i) {
    const Vector normal = randomDirection (random);
    const Vector place =
        box.center () + 0.3 * box.sizes ().cwiseProduct (Vector (between (random, -1.0, 1.0),
                                                                 between (random, -1.0, 1.0), 0.0));
    for (std::size_t t = 0; t < soup.triangles.size (); ++t)
      for (const Index p : soup.triangles[t])
        if (std::abs (normal.dot (soup.positions[p] - place)) < 0.5 * width)
          is_out[t] = 1;
  }
  cutOut (soup, is_out);
  dropSmall (soup, 10);
}

FacingCase
wingedBody (RandomStream& random)
{
  Soup soup = levelSet (randomWingedBody (random));
  dropSmall (soup, 0);
  transform (soup, flattening (random, 0.3));
  const int windows = 1 + static_cast<int> (random.below (10));
  cutWindows (soup, windows, between (random, 0.01, windows == 1 ? 0.3 : 0.5), random);
  transform (soup, randomRotation (random));
  return asCase (std::move (soup));
}

// The same round windows through all walls, as cones from the middle.
void
cutCones (const std::vector<Soup*>& walls, int windows, RandomStream& random)
{
  std::vector<Vector> axes;
  for (int i = 0; i < windows; ++i)
    axes.push_back (randomDirection (random));
  const double cosine = std::cos (between (random, 5.0, 25.0) * DEGREE);
  for (Soup* wall : walls) {
    std::vector<std::uint8_t> is_out;
    for (const Triangle& t : wall->triangles) {
      const Vector middle = wall->positions[t[0]].normalized ();
      const bool is_cut = std::any_of (axes.begin (), axes.end (),
                                       [&] (const Vector& a) { return a.dot (middle) > cosine; });
      is_out.push_back (is_cut ? 1 : 0);
    }
    cutOut (*wall, is_out);
    dropSmall (*wall, 0);
  }
}

FacingCase
hollowShell (RandomStream& random)
{
  const Field body = randomBlob (random, 2);
  Soup outer = levelSet (body);
  const double thickness = between (random, 0.02, 0.15);
  Soup inner = levelSet ([&] (const Vector& p) { return body (p) + thickness; });
  dropSmall (outer, 0);
  dropSmall (inner, 0);
  const int windows = static_cast<int> (random.below (6));
  if (windows > 0)
    cutCones ({&outer, &inner}, windows, random);
  turnRound (inner);
  append (outer, inner);
  transform (outer, randomRotation (random));
  return asCase (std::move (outer));
}

FacingCase
bodyInShell (RandomStream& random)
{
  Soup outer = levelSet (randomBlob (random, 2));
  Soup inner = levelSet (randomBlob (random, 0)); // radii differ by at most 0.4 / 0.7
  transform (inner, between (random, 0.2, 0.5) * randomRotation (random));
  dropSmall (outer, 0);
  cutCones ({&outer}, 1 + static_cast<int> (random.below (5)), random);
  append (outer, inner);
  transform (outer, randomRotation (random));
  return asCase (std::move (outer));
}

FacingCase
nestedBodies (RandomStream& random)
{
  Soup all;
  double size = 1.0;
  const auto depth = 2 + random.below (3);
  for (std::size_t i = 0; i < depth; ++i) {
    Soup soup = levelSet (randomBlob (random, 0));
    if (i % 2 == 1)
      turnRound (soup);
    transform (soup, size * randomRotation (random));
    append (all, soup);
    size *= between (random, 0.3, 0.55); // radii differ by at most 0.4 / 0.7
  }
  Soup beside = levelSet (randomBlob (random, 2));
  dropSmall (beside, 0);
  for (Vector& p : beside.positions)
    p += 3.0 * Vector::UnitX ();
  append (all, beside);
  transform (all, randomRotation (random));
  return asCase (std::move (all));
}

FacingCase
tube (RandomStream& random)
{
  const double length = std::exp (between (random, std::log (0.2), std::log (10.0)));
  const double cone = between (random, -0.3, 0.3) * std::min (length, 1.0),
               bend = between (random, 0.0, 0.3);
  Soup soup = grid (
      [=] (double u, double v) {
        const double radius = 1.0 + cone * (v - 0.5);
        return Vector (radius * std::cos (2.0 * PI * u) + bend * length * v * v,
                       radius * std::sin (2.0 * PI * u), length * v);
      },
      40, std::max (3, static_cast<int> (6.0 * length)), true);
  transform (soup, randomRotation (random));
  return asCase (std::move (soup));
}

FacingCase
torus (RandomStream& random)
{
  Soup soup = levelSet (
      ring (Vector::Zero (), 0.8, between (random, 0.12, 0.4), Eigen::Matrix3d::Identity ()));
  const int windows = 1 + static_cast<int> (random.below (10));
  cutWindows (soup, windows, between (random, 0.01, windows == 1 ? 0.3 : 0.5), random);
  transform (soup, randomRotation (random));
  return asCase (std::move (soup));
}

FacingCase
randomCap (double low, double high, bool is_sheet, RandomStream& random)
{
  const double share = between (random, low, high);
  Soup soup = cap (share, CAP_SIDE);
  if (!is_sheet)
    transform (soup, randomRotation (random));
  else {
    if (random.below (2) == 0)
      turnRound (soup); // a valley; its front is up
    else
      transform (soup, Eigen::AngleAxisd (PI, Vector::UnitX ()).toRotationMatrix ());
    transform (soup, randomTilt (random, 30.0));
  }
  FacingCase one = asCase (std::move (soup));
  one.parameter = share;
  return one;
}

FacingCase
terrain (RandomStream& random)
{
  Soup soup = heightField (randomHeights (random), between (random, 0.2, 1.0), 70);
  if (random.below (2) == 0)
    cutWindows (soup, 1 + static_cast<int> (random.below (5)), between (random, 0.01, 0.3), random);
  transform (soup, randomTilt (random, 20.0));
  return asCase (std::move (soup));
}

FacingCase
halfStatue (RandomStream& random)
{
  Soup soup = levelSet (randomBlob (random, 4));
  keepSeen (soup, randomDirection (random));
  return asCase (std::move (soup));
}

FacingCase
cutStatue (RandomStream& random)
{
  Soup soup = levelSet (randomWingedBody (random));
  dropSmall (soup, 0);
  const Vector down = randomDirection (random);
  double low = 0.0;
  for (const Vector& p : soup.positions)
    low = std::min (low, p.dot (down));
  cutBelow (soup, down, between (random, 0.2, 0.95) * low);
  return asCase (std::move (soup));
}

FacingCase
tornSheet (RandomStream& random)
{
  Soup soup;
  if (random.below (2) == 0)
    soup = heightField (randomHeights (random), between (random, 0.4, 1.0), 60);
  else {
    // A sheet in tall folds, each side of which is nearly upright.
    const double height = between (random, 0.05, 0.4), folds = between (random, 1.0, 3.0);
    soup = heightField (
        [=] (double x, double y) {
          return height * std::sin (2.0 * PI * folds * x) + 0.02 * std::sin (9.0 * y);
        },
        1.0, 60);
  }
  tear (soup, 1 + static_cast<int> (random.below (4)), between (random, 0.01, 0.06), random);
  transform (soup, randomTilt (random, 10.0));
  return asCase (std::move (soup));
}

FacingCase
tornBody (RandomStream& random)
{
  Soup soup = levelSet (randomBlob (random, 3));
  dropSmall (soup, 0);
  tear (soup, 1 + static_cast<int> (random.below (4)), between (random, 0.02, 0.2), random);
  transform (soup, randomRotation (random));
  return asCase (std::move (soup));
}

// A surface of which all is seen from the sensor, from any side.
FacingCase
scanWithSensor (RandomStream& random)
{
  Soup soup;
  Vector sensor;
  switch (random.below (3)) {
  case 0: { // a sheet, seen from above or below
    soup = heightField ([] (double x, double y) { return 0.05 * std::sin (9.0 * x) * y; }, 1.0, 50);
    const bool is_above = random.below (2) == 0;
    sensor = {0.5, 0.5, is_above ? 2.0 : -2.0};
    if (!is_above)
      turnRound (soup);
    break;
  }
  case 1: // a room or bowl, seen from inside
    soup = cap (between (random, 0.1, 0.95), CAP_SIDE);
    turnRound (soup);
    sensor = 0.2 * randomDirection (random) - 0.5 * Vector::UnitZ ();
    break;
  default: // a statue, seen from outside
    soup = levelSet (randomBlob (random, 4));
    sensor = 10.0 * randomDirection (random);
    keepSeen (soup, sensor.normalized ());
  }
  const Eigen::Matrix3d rotation = randomRotation (random);
  transform (soup, rotation);
  FacingCase one = asCase (std::move (soup));
  one.hints.sensor = rotation * sensor;
  return one;
}

} // namespace

const char*
familyName (Family family)
{
  static constexpr std::array<const char*, static_cast<std::size_t> (Family::COUNT)> NAMES{
      "winged body",        "hollow shell", "nested bodies", "body in shell",   "tube",
      "torus with windows", "deep cap",     "shallow cap",   "terrain",         "half statue",
      "cut statue",         "torn sheet",   "torn body",     "scan with sensor"};
  return NAMES[static_cast<std::size_t> (family)];
}

FacingCase
makeFacingCase (Family family, std::uint64_t seed)
{
  RandomStream random (seed * static_cast<std::uint64_t> (Family::COUNT) +
                       static_cast<std::uint64_t> (family) + 1);
  switch (family) {
  case Family::WINGED_BODY:
    return wingedBody (random);
  case Family::HOLLOW_SHELL:
    return hollowShell (random);
  case Family::NESTED_BODIES:
    return nestedBodies (random);
  case Family::BODY_IN_SHELL:
    return bodyInShell (random);
  case Family::TUBE:
    return tube (random);
  case Family::TORUS:
    return torus (random);
  case Family::DEEP_CAP:
    return randomCap (0.3, 0.98, false, random);
  case Family::SHALLOW_CAP:
    return randomCap (0.01, 0.2, true, random);
  case Family::TERRAIN:
    return terrain (random);
  case Family::HALF_STATUE:
    return halfStatue (random);
  case Family::CUT_STATUE:
    return cutStatue (random);
  case Family::TORN_SHEET:
    return tornSheet (random);
  case Family::TORN_BODY:
    return tornBody (random);
  default:
    return scanWithSensor (random);
  }
}

FacingCase
makeBowl (double share_of_area, int side)
{
  return asCase (cap (share_of_area, side));
}

TriangleMesh
turnAtRandom (const FacingCase& one, RandomStream& random)
{
  const MeshComponents components = findComponents (one.mesh, 1);
  std::vector<std::uint8_t> is_turned;
  for (Index c = 0; c < components.count; ++c)
    is_turned.push_back (static_cast<std::uint8_t> (random.below (2)));
  TriangleMesh mesh = one.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t)
    if (is_turned[components.of_triangle[t]] != 0)
      std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
  mesh.connect (one.positions.size (), 1);
  return mesh;
}

double
wrongShare (const FacingCase& one, const TriangleMesh& mesh)
{
  double wrong = 0.0, all = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    const auto& [a, b, c] = one.mesh.triangles[t];
    const double area = areaVector (one.positions[a], one.positions[b], one.positions[c]).norm ();
    all += area;
    if (mesh.triangles[t] != one.mesh.triangles[t])
      wrong += area;
  }
  return all > 0.0 ? wrong / all : 0.0;
}

} // namespace facing_cases
} // namespace floater
} // namespace pcl
