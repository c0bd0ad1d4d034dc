// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "attack.h"

#include "options/option_rows.h"
#include "surfaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace pcl::floater::fuzz {
namespace {
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double TURN = 6.283185307179586;

double
real (std::size_t number)
{
  return static_cast<double> (number);
}

double
fraction (std::size_t i, std::size_t n)
{
  return real (i) / real (std::max<std::size_t> (n, 1));
}

std::size_t
rootOf (double number)
{
  return static_cast<std::size_t> (std::sqrt (number));
}

Vector3d
normalVector (RandomStream& random)
{
  return Vector3d (random.normal (), random.normal (), random.normal ());
}

// Points that are made from their numbers.
template <typename Make>
Points
makeEach (std::size_t count, Make&& makePoint)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back (makePoint (i));
  return points;
}

Points
makeLine (std::size_t count, RandomStream& random)
{
  const Vector3d step = normalVector (random);
  const double growth = random.below (2) == 0 ? 1.0 : 1.0 + 0.2 * random.uniform ();
  Points points;
  double at = 0.0, length = 1.0;
  for (std::size_t i = 0; i < count; ++i, at += length, length *= growth)
    points.emplace_back (at * step);
  return points;
}

// Points on a sphere: in circles of latitude, or at random. All stars are co-circular in some way.
Points
makeSphere (std::size_t count, RandomStream& random)
{
  const std::size_t round = random.below (2) == 0 ? 0 : 3 + random.below (30);
  return makeEach (count, [&] (std::size_t i) -> Vector3d {
    const double u = round == 0 ? random.uniform () : fraction (i % round, round);
    const double v = round == 0 ? random.uniform ()
                                : fraction (i / round, std::max<std::size_t> (count / round, 1));
    const double z = 2.0 * v - 1.0;
    const double r = std::sqrt (std::max (0.0, 1.0 - z * z));
    return {r * std::cos (TURN * u), r * std::sin (TURN * u), z};
  });
}

// The faces of a box on a lattice, without its inside.
Points
makeBox (std::size_t count, RandomStream& random)
{
  const std::size_t side = rootOf (fraction (count, 6)) + 2;
  const double thin = random.below (2) == 0 ? 1.0 : 0.02;
  Points points;
  for (std::size_t i = 0; i < side * side * side && points.size () < count; ++i) {
    const std::array<std::size_t, 3> at{i % side, i / side % side, i / side / side};
    if (std::any_of (at.begin (), at.end (),
                     [side] (std::size_t c) { return c == 0 || c == side - 1; }))
      points.emplace_back (real (at[0]), real (at[1]), thin * real (at[2]));
  }
  return points;
}

// Shapes about 1 in size.
constexpr std::size_t SHAPES = 13;

Points
makeShape (std::size_t kind, std::size_t count, RandomStream& random)
{
  const auto isOneOfTwo = [&random] { return random.below (2) == 0; };
  const auto randomPoint = [&random] (std::size_t /*i*/) -> Vector3d {
    return Vector3d (random.uniform (), random.uniform (), random.uniform ());
  };
  switch (kind) {
  case 0: { // a grid
    const std::size_t width = 1 + random.below (rootOf (real (count)) + 1);
    const double aspect = isOneOfTwo () ? 1.0 : std::pow (10.0, 4.0 * random.uniform ());
    return makeEach (count, [&] (std::size_t i) -> Vector3d {
      const std::size_t row = i / width;
      return {aspect * real (row), real (i % width), 0.0};
    });
  }
  case 1: { // a disc, flat or bent
    const double bend = isOneOfTwo () ? 0.0 : 3.0 * random.uniform ();
    return makeEach (count, [&] (std::size_t) -> Vector3d {
      const double r = std::sqrt (random.uniform ());
      const double angle = TURN * random.uniform ();
      return {r * std::cos (angle), r * std::sin (angle), bend * r * r};
    });
  }
  case 2:
    return makeSphere (count, random);
  case 3:
    return makeLine (count, random);
  case 4: { // circles, one over the other
    const std::size_t rings = 1 + random.below (4);
    return makeEach (count, [&] (std::size_t i) -> Vector3d {
      const double angle = TURN * fraction (i / rings, count / rings);
      return {std::cos (angle), std::sin (angle), 0.1 * real (i % rings)};
    });
  }
  case 5:
    return makeEach (count, randomPoint);
  case 6: { // few places with many points: equal, or apart by the last bits only
    const Points places = makeEach (1 + random.below (12), randomPoint);
    const double apart = isOneOfTwo () ? 0.0 : std::pow (10.0, -17.0 + 6.0 * random.uniform ());
    return makeEach (count, [&] (std::size_t) -> Vector3d {
      return places[random.below (places.size ())] + apart * normalVector (random);
    });
  }
  case 7: { // a hub with all others around it
    const double height = isOneOfTwo () ? 0.0 : random.normal ();
    return makeEach (std::max<std::size_t> (count, 1), [&] (std::size_t i) -> Vector3d {
      const double angle = i == 0 ? 0.0 : TURN * fraction (i - 1, count - 1);
      return i == 0 ? Vector3d (0.0, 0.0, height)
                    : Vector3d (std::cos (angle), std::sin (angle), 0.0);
    });
  }
  case 8: { // sheets that touch, cross, or lie closer together than their points
    const std::size_t sheets = 2 + random.below (3);
    const double gap =
        random.below (3) == 0 ? 0.0 : std::pow (10.0, -3.0 + 4.0 * random.uniform ());
    const double tilt = isOneOfTwo () ? 0.0 : random.uniform ();
    const std::size_t width = 1 + rootOf (fraction (count, sheets));
    return makeEach (count, [&] (std::size_t i) -> Vector3d {
      const double x = real (i / sheets % width);
      const std::size_t row = i / sheets / width;
      return {x, real (row), real (i % sheets) * (gap + tilt * x)};
    });
  }
  case 9:
    return makeBox (count, random);
  case 10: { // a spike: circles that become smaller towards a tip, down to the last bits
    const std::size_t round = 3 + random.below (10);
    const double shrink = 0.3 + 0.65 * random.uniform ();
    return makeEach (count, [&] (std::size_t i) -> Vector3d {
      const double ring = real (i / round), radius = std::pow (shrink, ring);
      const double angle = TURN * fraction (i % round, round);
      return {radius * std::cos (angle), radius * std::sin (angle), ring};
    });
  }
  case 11: { // a one-sided strip
    const std::size_t across = 2 + random.below (6);
    const std::size_t along = std::max<std::size_t> (count / across, 1);
    return makeEach (count, [&] (std::size_t i) -> Vector3d {
      const double u = TURN * fraction (i / across, along);
      const double v = fraction (i % across, across - 1) - 0.5;
      const double r = 1.0 + 0.5 * v * std::cos (0.5 * u);
      return {r * std::cos (u), r * std::sin (u), 0.5 * v * std::sin (0.5 * u)};
    });
  }
  default: { // what a depth camera at the origin sees: rays in rows, coarse depths, steps
    const std::size_t width = 2 + rootOf (real (count));
    const double step = isOneOfTwo () ? 1e-4 : 0.05;
    const double edge = random.uniform () - 0.5;
    return makeEach (count, [&] (std::size_t i) -> Vector3d {
      const double x = fraction (i % width, width) - 0.5, y = fraction (i / width, width) - 0.5;
      const double depth = (x + 0.3 * y > edge ? 3.0 : 1.0 + 0.2 * x) + 0.01 * random.normal ();
      const double z = std::max (step, step * std::round (depth / step));
      return {x * z, y * z, z};
    });
  }
  }
}

Points
makePart (std::size_t count, ByteSource& bytes)
{
  const std::size_t kind = bytes.below (SHAPES + 1);
  Points points;
  if (kind == SHAPES) { // raw coordinates
    for (std::size_t i = 0; i < count && !bytes.isEmpty (); ++i) {
      const double x = bytes.anyDouble ();
      const double y = bytes.anyDouble ();
      points.emplace_back (x, y, bytes.anyDouble ());
    }
    return points;
  }
  RandomStream random (bytes.byte ());
  points = makeShape (kind, count, random);
  const std::size_t jitter = bytes.below (8);
  if (jitter > 3)
    for (Vector3d& p : points)
      p += std::pow (10.0, -real (jitter - 3)) * normalVector (random);
  // Placed along the axes as often as not, so that coordinates tie.
  const std::size_t place = bytes.below (4);
  const double scale = bytes.isOneIn (4) ? std::pow (10.0, 8.0 * random.uniform () - 4.0) : 1.0;
  Vector3d shift = Vector3d::Zero ();
  if ((place & 1U) != 0U)
    shift = Vector3d (3.0 * random.normal (), 3.0 * random.normal (), random.normal ());
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity ();
  if ((place & 2U) != 0U)
    turn = Eigen::Quaterniond (random.normal (), random.normal (), random.normal (), 1.0)
               .normalized ();
  for (Vector3d& p : points)
    p = scale * (turn * p) + shift;
  return points;
}

// What goes wrong with coordinates on their way from a sensor.
void
spoil (Points& points, ByteSource& bytes, RandomStream& random)
{
  if (points.empty ())
    return;
  const auto any = [&] () -> Vector3d& { return points[random.below (points.size ())]; };
  const auto anyOf = [&] (Vector3d& p) -> double& {
    return p[static_cast<Eigen::Index> (random.below (3))];
  };
  const std::size_t spikes = 1 + random.below (1 + points.size () / 4);
  switch (bytes.below (16)) {
  case 8:
    for (std::size_t i = 0; i < spikes; ++i)
      anyOf (any ()) = std::numeric_limits<double>::quiet_NaN ();
    break;
  case 9:
    for (std::size_t i = 0; i < spikes; ++i)
      anyOf (any ()) = (i % 2 == 0 ? 1.0 : -1.0) * std::numeric_limits<double>::infinity ();
    break;
  case 10:
    for (std::size_t i = 0; i < spikes; ++i) {
      const Vector3d copy = any ();
      any () = copy;
    }
    break;
  case 11: // outliers, near and far
    for (std::size_t i = 0; i < 3; ++i)
      anyOf (any ()) = std::pow (10.0, 300.0 * random.uniform ());
    break;
  case 12: // coordinates in 32 bits, far from the origin
    for (Vector3d& p : points)
      p = (p + Vector3d::Constant (1e5)).cast<float> ().cast<double> ();
    break;
  case 13: // whole numbers
    for (Vector3d& p : points)
      p = (16.0 * p).array ().round ();
    break;
  case 14: { // the whole range of double
    const double scale = std::pow (10.0, 600.0 * random.uniform () - 300.0);
    for (Vector3d& p : points)
      p *= scale;
    break;
  }
  case 15: // flat, or on one line
    for (Vector3d& p : points) {
      p.z () = random.below (2) == 0 ? 0.0 : 1e-17 * random.normal ();
      if (spikes % 3 == 0)
        p.y () = p.x ();
    }
    break;
  default:
    break;
  }
}

template <typename Enum>
Enum
decodeEnum (ByteSource& bytes, Enum last)
{
  return static_cast<Enum> (bytes.below (static_cast<std::size_t> (last) + 1));
}

// A limit of any size, mostly a sensible one.
double
decodeLimit (ByteSource& bytes)
{
  const std::size_t kind = bytes.below (16);
  return kind == 15 ? bytes.anyDouble () : 0.5 * static_cast<double> (kind * kind);
}

DiscOptions
decodeDiscOptions (ByteSource& bytes, std::size_t points)
{
  DiscOptions disc;
  disc.boundary.method = decodeEnum (bytes, BoundaryMethod::TWO_SEGMENTS);
  disc.domain.curve = decodeEnum (bytes, Domain::POLYGON);
  disc.domain.polygon_sides = static_cast<int> (bytes.below (20));
  disc.domain.loop_spacing = decodeEnum (bytes, LoopSpacing::UNIFORM);
  disc.weighting = decodeEnum (bytes, Weighting::MEAN_VALUE);
  disc.solver.method = SOLVER_CHOICES[bytes.below (std::size (SOLVER_CHOICES))].second;
  disc.solver.ordering = ORDERING_CHOICES[bytes.below (std::size (ORDERING_CHOICES))].second;
  disc.boundary.cluster_k = static_cast<int> (bytes.below (40));
  disc.boundary.opening_angle = 2.0 * static_cast<double> (bytes.byte ());
  disc.boundary.cluster_tolerance = static_cast<double> (bytes.byte ()) / 250.0;
  if (bytes.isOneIn (4)) {
    const std::size_t length = bytes.below (24);
    for (std::size_t i = 0; i < length; ++i)
      disc.boundary.loop.push_back (static_cast<std::uint32_t> (bytes.below (points + 2)));
  }
  return disc;
}

// Plain defaults are what users have, so they come most often.
Options
decodeOptions (ByteSource& bytes, std::size_t points)
{
  Options options;
  const std::size_t kind = bytes.below (8);
  options.topology = kind < 4 ? Topology::AUTO : kind < 6 ? Topology::SURFACE : Topology::DISC;
  options.threads = static_cast<int> (1 + bytes.below (2));
  if (options.topology == Topology::DISC)
    options.disc = decodeDiscOptions (bytes, points);
  if (kind < 3)
    return options;
  const std::uint8_t switches = bytes.byte ();
  options.remove_outliers = (switches & 1U) == 0;
  options.denoise = (switches & 2U) == 0;
  options.filter_sheets = (switches & 4U) == 0;
  options.flip_edges = (switches & 8U) == 0;
  options.remove_self_intersections = (switches & 16U) == 0;
  if ((switches & 128U) != 0) {
    options.scatter = ScatterPolicy::DROP;
    options.trimming.open_self_intersections = true;
  }
  if ((switches & 64U) != 0) {
    options.neighbors.kind = decodeEnum (bytes, Neighborhood::BALL);
    options.neighbors.k = static_cast<int> (4 + bytes.below (60));
    options.neighbors.ball_radius = 1.0 + 0.1 * static_cast<double> (bytes.below (40));
  }
  if ((switches & 128U) == 0)
    return options;
  if (options.topology != Topology::DISC) {
    options.holes.policy = decodeEnum (bytes, HolePolicy::BY_SIZE);
    options.holes.kept_loops = static_cast<int> (bytes.below (6));
    options.holes.largest_hole = decodeLimit (bytes);
    options.holes.unit = decodeEnum (bytes, LengthUnit::CLOUD);
    options.view.use = decodeEnum (bytes, ViewUse::NEVER);
    for (double& coordinate : options.view.viewpoint)
      coordinate = 3.0 - decodeLimit (bytes);
  }
  options.trimming.maximum_edge_length = decodeLimit (bytes);
  options.trimming.maximum_edge_ratio = decodeLimit (bytes);
  options.trimming.minimum_component_size = static_cast<int> (bytes.below (12));
  options.facing = static_cast<Facing> (switches % 5U);
  return options;
}

} // namespace

Attack
decodeAttack (ByteSource& bytes, std::size_t most)
{
  RandomStream random (bytes.byte ());
  const std::size_t parts = 1 + bytes.below (bytes.isOneIn (2) ? 6 : 1);
  // The options come first, so that they stay the same when a fuzzer makes the cloud longer.
  Attack attack;
  attack.options = decodeOptions (bytes, most);
  Points& points = attack.input.positions;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t left = most - std::min (most, points.size ());
    const std::size_t count =
        std::min (left, 1 + bytes.below (std::min<std::size_t> (most, 65536)));
    const Points more = makePart (count, bytes);
    const auto end = more.begin () + static_cast<std::ptrdiff_t> (std::min (left, more.size ()));
    points.insert (points.end (), more.begin (), end);
  }
  spoil (points, bytes, random);
  if (bytes.isOneIn (2))
    for (std::size_t i = points.size (); i > 1; --i)
      std::swap (points[i - 1], points[random.below (i)]);
  attack.input.cloud_index.resize (points.size ());
  std::iota (attack.input.cloud_index.begin (), attack.input.cloud_index.end (), 0U);
  attack.input.cloud_size = points.size ();
  if (bytes.isOneIn (4)) { // a selection of a larger cloud, backwards
    attack.input.cloud_size = 2 * points.size () + 1;
    for (std::uint32_t& index : attack.input.cloud_index)
      index = static_cast<std::uint32_t> (2 * points.size ()) - 2 * index;
  }
  if (bytes.isOneIn (4))
    for (double& coordinate : attack.input.sensor_origin)
      coordinate = decodeLimit (bytes);
  if (attack.options.facing == Facing::NORMALS || bytes.isOneIn (8))
    for (std::size_t p = 0; p < attack.input.cloud_size; ++p)
      attack.input.facing_normals.push_back (
          points.empty () ? Eigen::Vector3f (Eigen::Vector3f::UnitZ ())
                          : Eigen::Vector3f (points[p % points.size ()].cast<float> ()));
  return attack;
}

} // namespace pcl::floater::fuzz
