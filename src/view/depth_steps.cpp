// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "view/view_flips.h"

namespace pcl::floater {
namespace {
// Degrees. An edge that is not steep is a step if the surface would bend by this at both ends, in
// opposite directions: two sheets that face the sensor, one behind the other.
constexpr double TURN = 45.0;
// A step exceeds this many times the noise. 1 % of Gaussian noise does, but in isolated edges.
constexpr double NOISE = 2.0;
// The same for edges that are not steep: five deviations of Gaussian noise, one edge of a million.
constexpr double SHARP_NOISE = 4.0;
// An edge is on one surface if an extrapolation from one of its ends is as steep, up to this
// factor. At a crease the edge is shorter than the extrapolation from the steeper side: factor 1,
// and as much for curvature.
constexpr double CONTINUED = 2.0;
// Depth over width of an edge, above which a surface is seen at less than 6 degrees, and returns
// hardly any light; and CONTINUED for these: only a plane may be seen so flat. Rings on three
// things at three distances look like a slope.
constexpr double GRAZING = 10.0, CONTINUED_GRAZING = 1.25;
// Largest sum of the weights of an extrapolation. It is 3 on a raster, and up to 7 where rays are
// lost; from three points of one ring to the next ring it is thousands, and tells nothing.
constexpr double MOST_WEIGHT = 20.0;
// Where two surfaces meet: length of an edge over the length to which either is extrapolated;
// above, it is a step. A surface seen at less than 6 degrees returns hardly any light, and is
// sampled ten times more coarsely than one seen face on.
constexpr double JOINT = 10.0;
// Edges of about the same depth, which measure the noise; their 80 % quantile has an error of 3 %.
constexpr std::size_t EDGES_PER_BIN = 2000;
// On either side; the noise is the median over all.
constexpr std::size_t BINS_BESIDE = 4;
// Largest ratio of the noise to that of edges farther away, in units of depth: it does not fall
// with depth in any sensor. 1, and as much as curvature and the errors of both may add.
constexpr double NEARER_NOISE = 3.0;
// Of a Gaussian, at 1.3 standard deviations. More than 80 % of the edges of a scene are on surfaces.
constexpr double NOISE_QUANTILE = 0.8;
// Of the depth, or for parallel rays of the span; no sensor is so precise: below, it is rounding.
constexpr double ROUNDING = 2e-5;
// Quantile of the deviations above rounding that is one quantum.
constexpr double STEP_QUANTILE = 0.2;
// Of the depth; coarsest rounding of sensors.
constexpr double LARGEST_QUANTUM = 0.02;

// Extrapolation of the surface from the first point of an edge to the second.
struct Extension
{
  float change = 0.0F; // of the inverse depth
  float weight = 0.0F; // sum of the weights of its inverse depths; 0: unknown
};

// An edge between two triangles, or of one.
struct StepEdge
{
  MeshEdge edge;
  float depth;     // of the nearer end
  float deviation; // the smaller one of both ends, over the weights; infinity: unknown
};

struct StepFinder
{
  const TriangleMesh& view;
  const Rays& rays;
  const RunContext& run;
  double span = 1.0; // of the depths
  double largest_cosine = std::cos (TURN * DEGREE);
  std::vector<Extension> continuations = {}; // of each edge from its first end, by numberOf ()
  std::vector<StepEdge> edges = {};

  Flags find ()
  {
    if (rays.from.is_far && !rays.depths.empty ()) {
      const auto [least, most] = std::minmax_element (rays.depths.begin (), rays.depths.end ());
      span = std::max (*most - *least, std::numeric_limits<double>::min ());
    }
    continuations.resize (3 * view.triangles.size ());
    parallelPoints<std::vector<Index>, std::vector<Index>, std::vector<Vector2d>> (
        run, view.triangle_of.size (),
        [&] (Index p, auto&... scratch) { continueAround (p, scratch...); });
    findEdges ();
    Flags is_step (view.triangles.size (), 0);
    const std::size_t bins = std::max<std::size_t> (1, edges.size () / EDGES_PER_BIN);
    const auto binBegin = [&] (std::size_t b) { return b * edges.size () / bins; };
    std::vector<double> noises (bins);
    Flags is_rounded (bins);
    parallelTasks (run, bins, [&] (std::size_t b) {
      noises[b] = measureNoise (binBegin (b), binBegin (b + 1), is_rounded[b]);
    });
    std::vector<double> usual_noises (bins);
    double farther = std::numeric_limits<double>::infinity (); // least noise, in units of depth
    // Nor do bins between two steps of quantized depths show the size of a step.
    const bool is_smooth = !rays.from.is_far && std::find (is_rounded.begin (), is_rounded.end (),
                                                           1) == is_rounded.end ();
    for (std::size_t b = bins; b-- > 0;) {
      // Over several bins: the outline of a round body has constant depth, and may fill its bin.
      std::vector<double> window (noises.data () + (b - std::min (b, BINS_BESIDE)),
                                  noises.data () + std::min (bins, b + BINS_BESIDE + 1));
      usual_noises[b] = median (window);
      if (!is_smooth || edges.empty ())
        continue;
      // Before a background, most edges of near things may be steps.
      const double depth = edges[binBegin (b)].depth;
      usual_noises[b] = std::min (usual_noises[b], NEARER_NOISE * farther / depth);
      farther = std::min (farther, usual_noises[b] * depth);
    }
    Flags is_step_edge (edges.size (), 0);
    parallelTasks (run, bins, [&] (std::size_t b) {
      const double noise = usual_noises[b];
      // A bin between two steps of quantized depths does not show the size of a step.
      const double sharp_noise =
          std::max (SHARP_NOISE * noise, is_rounded[b] != 0 ? LARGEST_QUANTUM : 0.0);
      for (std::size_t e = binBegin (b); e < binBegin (b + 1); ++e) {
        const double unit = unitAt (edges[e].depth);
        is_step_edge[e] = isStep (edges[e].edge, NOISE * noise * unit, sharp_noise * unit) ? 1 : 0;
      }
    });
    for (std::size_t e = 0; e < edges.size (); ++e)
      if (is_step_edge[e] != 0)
        for (const Index t : {edges[e].edge.triangle, view.mate (edges[e].edge).triangle})
          if (t != NONE)
            is_step[t] = 1;
    return is_step;
  }

  static std::size_t numberOf (MeshEdge e) { return std::size_t{3} * e.triangle + e.side; }

  // Where the ray of q meets a plane across the ray of p, from that point of p.
  Vector2d placeBeside (Index p, Index q) const
  {
    if (rays.from.is_far)
      return rays.places[q] - rays.places[p];
    const Vector3d &across = rays.directions[p], &direction = rays.directions[q];
    const Vector3d x = across.unitOrthogonal ();
    const Vector3d y = x.cross (across); // towards the sensor, x to y is anti-clockwise
    return Vector2d (x.dot (direction), y.dot (direction)) / across.dot (direction);
  }

  // All edges that leave p, each with the triangle of p on its opposite side.
  void continueAround (Index p, std::vector<Index>& fan, std::vector<Index>& around,
                       std::vector<Vector2d>& places)
  {
    view.fan (p, fan, around);
    places.clear ();
    for (const Index q : around)
      places.push_back (placeBeside (p, q));
    for (std::size_t e = 0; e < fan.size (); ++e) {
      const Vector2d back = -places[e];
      for (std::size_t t = 0; t < fan.size (); ++t) {
        const std::size_t next = (t + 1) % around.size ();
        const double area = cross (places[t], places[next]);
        const double a = cross (back, places[next]) / area, b = cross (places[t], back) / area;
        if (!(a >= 0.0 && b >= 0.0 && area > 0.0))
          continue;
        const auto level = [&] (std::size_t i) { return rays.levels[around[i]] - rays.levels[p]; };
        if (1.0 + a + b > MOST_WEIGHT)
          break;
        const std::uint8_t side = TriangleMesh::previous (view.sideOf (fan[e], p));
        continuations[numberOf ({fan[e], side})] = {
            static_cast<float> (-(a * level (t) + b * level (next))),
            static_cast<float> (1.0 + a + b)};
        break;
      }
    }
  }

  double changeOf (MeshEdge e) const
  {
    return rays.levels[view.to (e)] - rays.levels[view.from (e)];
  }

  // The extrapolations along the edge from its first and from its second end.
  std::array<Extension, 2> continuationsOf (MeshEdge e) const
  {
    std::array<Extension, 2> both{continuations[numberOf (e)], {}};
    if (const MeshEdge mate = view.mate (e); mate.triangle != NONE) {
      both[1] = continuations[numberOf (mate)];
      both[1].change = -both[1].change;
    }
    return both;
  }

  // By the depth of their nearer ends.
  void findEdges ()
  {
    edges.reserve (view.triangles.size () * 3 / 2 + 3);
    for (Index t = 0; t < view.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (const Index other = view.neighbors[t][side]; other == NONE || t < other) {
          const MeshEdge e{t, side};
          const double depth = std::min (rays.depths[view.from (e)], rays.depths[view.to (e)]);
          edges.push_back ({e, static_cast<float> (depth), 0.0F});
        }
    parallelPoints (run, edges.size (), [&] (Index i) {
      StepEdge& edge = edges[i];
      const double change = changeOf (edge.edge);
      double least = std::numeric_limits<double>::infinity ();
      for (const Extension& c : continuationsOf (edge.edge))
        if (c.weight > 0.0F)
          least = std::min (least, std::abs (change - c.change) / c.weight);
      edge.deviation = static_cast<float> (least);
    });
    const auto isNearer = [] (const StepEdge& a, const StepEdge& b) {
      return a.depth != b.depth ? a.depth < b.depth : numberOf (a.edge) < numberOf (b.edge);
    };
    sortInParallel (edges.begin (), edges.end (), isNearer, run);
  }

  // Change of the inverse depth for a relative change of depth.
  double unitAt (double depth) const { return rays.from.is_far ? span : 1.0 / depth; }

  // Noise of edges of about the same depth, relative to the depth.
  double measureNoise (std::size_t first, std::size_t last, std::uint8_t& is_rounded) const
  {
    std::vector<float> deviations;
    for (std::size_t e = first; e < last; ++e)
      if (std::isfinite (edges[e].deviation))
        deviations.push_back (edges[e].deviation);
    if (deviations.empty ())
      return 0.0;
    const double noise = quantile (deviations, NOISE_QUANTILE);
    // Inverse depth per relative depth.
    const double unit = unitAt (edges[first].depth);
    const double usual = median (deviations);
    is_rounded = usual > ROUNDING * unit ? 0 : 1;
    if (is_rounded == 0)
      return noise / unit;
    constexpr double ABOVE = 20.0; // times the median: more is not rounding
    constexpr std::size_t FEWEST = 20;
    deviations.erase (std::remove_if (deviations.begin (), deviations.end (),
                                      [usual] (float one) { return one <= ABOVE * usual; }),
                      deviations.end ());
    if (deviations.size () < FEWEST)
      return noise / unit;
    // The weights of a step are 2 or more.
    const double step = quantile (deviations, STEP_QUANTILE);
    return std::max (noise / unit, std::min (step / unit, 0.5 * LARGEST_QUANTUM));
  }

  // Position on a ray at an inverse depth, from the sensor. Non-positive ones are far away.
  Vector3d placeAt (Index ray, double level) const
  {
    if (rays.from.is_far)
      return rays.directions[ray] + level * rays.from.place;
    constexpr double FAR_AWAY = 1e-3; // of the inverse depths around
    return rays.directions[ray] / std::max (level, FAR_AWAY * rays.levels[ray]);
  }

  bool isStep (MeshEdge e, double steep_noise, double sharp_noise) const
  {
    const Index p = view.from (e), q = view.to (e);
    const std::array<Index, 2> ends{p, q}; // their rays
    const double change = changeOf (e);
    const std::array<Extension, 2> both = continuationsOf (e);
    const double width = (rays.directions[p] - rays.directions[q]).norm () *
                         (rays.from.is_far ? 1.0 : std::min (rays.depths[p], rays.depths[q]));
    const double rise = std::abs (rays.depths[p] - rays.depths[q]);
    const bool is_steep = rise > STEEP * width;
    const double continued = rise > GRAZING * width ? CONTINUED_GRAZING : CONTINUED;
    const double least = is_steep ? steep_noise : sharp_noise;
    const auto isKnown = [&] (std::size_t end) { return both[end].weight > 0.0F; };
    for (const std::size_t end : {0, 1})
      if (isKnown (end) && std::abs (change - both[end].change) <= least * both[end].weight)
        return false;
    const auto told = [&] (std::size_t end) -> double { return both[end].change; };
    // The inverse depth that is told from an end for the other one.
    const auto levelFrom = [&] (std::size_t end) {
      return end == 0 ? rays.levels[p] + told (0) : rays.levels[q] - told (1);
    };
    const auto goesOn = [&] (std::size_t end) {
      return isKnown (end) && told (end) * change >= 0.0 &&
             std::abs (change) <= continued * std::abs (told (end));
    };
    // Whether the surface goes steeply towards the other end, as far as it is known.
    const auto mayRecede = [&] (std::size_t end) {
      if (!isKnown (end))
        return true;
      const double level = levelFrom (end);
      const double told_rise = rays.from.is_far ? std::abs (told (end))
                               : level > 0.0    ? std::abs (1.0 / level - rays.depths[ends[end]])
                                                : std::numeric_limits<double>::infinity ();
      return told (end) * change > 0.0 &&
             std::abs (told (end)) >= steep_noise / NOISE * both[end].weight &&
             told_rise > STEEP * width;
    };
    if (is_steep && !goesOn (0) && !goesOn (1))
      return !(mayRecede (0) && mayRecede (1) && (isKnown (0) || isKnown (1)));
    if (!isKnown (0) || !isKnown (1))
      return false;
    // From either end: the edge, and the straight extrapolation of the surface to the ray of the other.
    std::array<Vector3d, 2> edge, straight;
    for (const std::size_t end : {0, 1}) {
      const Index ray = ends[end], other = ends[1 - end];
      const Vector3d from = placeAt (ray, rays.levels[ray]);
      edge[end] = placeAt (other, rays.levels[other]) - from;
      straight[end] = placeAt (other, levelFrom (end)) - from;
    }
    if (is_steep)
      return edge[0].norm () > JOINT * std::min (straight[0].norm (), straight[1].norm ());
    const bool meet_between = (change > told (0)) != (change > told (1));
    const auto turnsSharply = [&] (std::size_t end) {
      return straight[end].dot (edge[end]) <
             largest_cosine * straight[end].norm () * edge[end].norm ();
    };
    return !meet_between && turnsSharply (0) && turnsSharply (1);
  }
};

} // namespace

Flags
findDepthSteps (const TriangleMesh& view, const Rays& rays, const RunContext& run)
{
  return StepFinder{view, rays, run}.find ();
}

} // namespace pcl::floater
