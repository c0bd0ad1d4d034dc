// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_recipe.h"

#include "hard_shapes.h"
#include "random_stream.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl::floater::fuzz {
namespace {
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Points
makeRaw (std::size_t count, ByteSource& bytes)
{
  Points points;
  for (std::size_t i = 0; i < count && !bytes.isEmpty (); ++i) {
    const double x = bytes.anyDouble ();
    const double y = bytes.anyDouble ();
    points.emplace_back (x, y, bytes.anyDouble ());
  }
  return points;
}

Points
makePart (std::size_t count, ByteSource& bytes)
{
  const std::size_t kind = bytes.below (HARD_SHAPES + 1);
  if (kind == HARD_SHAPES)
    return makeRaw (count, bytes);
  RandomStream random (bytes.byte ());
  Points points = makeHardShape (kind, count, random);
  const std::size_t jitter = bytes.below (8);
  if (jitter > 3) {
    const double size = std::pow (10.0, -static_cast<double> (jitter - 3));
    for (Vector3d& p : points)
      p += size * Vector3d (random.normal (), random.normal (), random.normal ());
  }
  // Placed along the axes as often as not, so that coordinates tie.
  const std::size_t place = bytes.below (4);
  const double scale = bytes.isOneIn (4) ? std::pow (10.0, 8.0 * random.uniform () - 4.0) : 1.0;
  const Vector3d shift = (place & 1U) != 0U ? Vector3d (3.0 * random.normal (),
                                                        3.0 * random.normal (), random.normal ())
                                            : Vector3d::Zero ();
  const Eigen::Quaterniond turn =
      (place & 2U) != 0U
          ? Eigen::Quaterniond (random.normal (), random.normal (), random.normal (), 1.0)
                .normalized ()
          : Eigen::Quaterniond::Identity ();
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

void
decodeDiscOptions (ByteSource& bytes, std::size_t points, Options& options)
{
  options.disc.boundary.method = decodeEnum (bytes, BoundaryMethod::TWO_SEGMENTS);
  options.disc.domain.curve = decodeEnum (bytes, Domain::OWN_SHAPE);
  options.disc.domain.polygon_sides = static_cast<int> (bytes.below (20));
  options.disc.domain.loop_spacing = decodeEnum (bytes, LoopSpacing::UNIFORM);
  options.disc.weighting = decodeEnum (bytes, Weighting::MEAN_VALUE);
  constexpr std::array<Solver, 4> SOLVERS{Solver::UMFPACK, Solver::SUPERLU, Solver::BICGSTAB_ILUT,
                                          Solver::GAUSS_SEIDEL};
  constexpr std::array<Ordering, 5> ORDERINGS{Ordering::AUTOMATIC, Ordering::AMD, Ordering::METIS,
                                              Ordering::REVERSE_CUTHILL_MCKEE, Ordering::NATURAL};
  options.disc.solver.method = SOLVERS[bytes.below (SOLVERS.size ())];
  options.disc.solver.ordering = ORDERINGS[bytes.below (ORDERINGS.size ())];
  options.disc.boundary.cluster_k = static_cast<int> (bytes.below (40));
  options.disc.boundary.opening_angle = 2.0 * static_cast<double> (bytes.byte ());
  options.disc.boundary.cluster_tolerance = static_cast<double> (bytes.byte ()) / 250.0;
  if (bytes.isOneIn (4)) {
    const std::size_t length = bytes.below (24);
    for (std::size_t i = 0; i < length; ++i)
      options.disc.boundary.loop.push_back (static_cast<std::uint32_t> (bytes.below (points + 2)));
  }
}

} // namespace

Options
decodeOptions (ByteSource& bytes, std::size_t points)
{
  Options options;
  // Plain defaults are what users have, so they come most often.
  const std::size_t kind = bytes.below (8);
  options.topology = kind < 4 ? Topology::AUTO : kind < 6 ? Topology::SURFACE : Topology::DISC;
  options.threads = static_cast<int> (1 + bytes.below (2));
  if (options.topology == Topology::DISC)
    decodeDiscOptions (bytes, points, options);
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
  options.blocks = (switches & 32U) == 0 ? 0 : static_cast<int> (bytes.below (9));
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

Attack
decodeAttack (ByteSource& bytes, std::size_t most)
{
  const std::uint64_t seed = bytes.byte ();
  RandomStream random (seed);
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
