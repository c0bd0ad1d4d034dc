// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/depth_steps.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"

namespace pcl::floater {
namespace {
// Degrees. An edge that is not steep is a step if the surface would bend by this at both ends, in
// opposite directions: two sheets that face the sensor, one behind the other by more than the width
// of the edge.
constexpr double TURN = 45.0;
// A step exceeds this many times the noise (see findDepthSteps). 1 % of Gaussian noise does, but in
// isolated edges.
constexpr double NOISE = 2.0;
// The same for edges that are not steep, nearly all edges: five standard deviations of Gaussian
// noise, one edge of a million.
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
// Edges of about the same depth, among which the noise is measured; their 80 % quantile has an
// error of 3 %.
constexpr std::size_t EDGES_PER_BIN = 2000;
// On either side; the noise is the median over all.
constexpr std::size_t BINS_BESIDE = 4;
// Largest ratio of the noise to that of edges farther away, in units of depth: it does not fall
// with depth in any sensor. 1, and as much as the curvature of near things and the error of each
// may add.
constexpr double NEARER_NOISE = 3.0;
// Of a Gaussian, at 1.3 standard deviations. More than 80 % of the edges of a scene are on surfaces.
constexpr double NOISE_QUANTILE = 0.8;
// Of the depth, or of the span of depths for parallel rays; smaller deviations are rounding, as no
// sensor is so precise.
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

class StepFinder
{
public:
  StepFinder (const TriangleMesh& view, const Rays& rays, const RunContext& run)
      : view_ (view), rays_ (rays), run_ (run)
  {
  }

  Flags find ()
  {
    if (rays_.are_parallel && !rays_.depths.empty ()) {
      const auto [least, most] = std::minmax_element (rays_.depths.begin (), rays_.depths.end ());
      span_ = std::max (*most - *least, std::numeric_limits<double>::min ());
    }
    continueSurfaces ();
    findEdges ();
    Flags is_step (view_.triangles.size (), 0);
    const std::size_t bins = std::max<std::size_t> (1, edges_.size () / EDGES_PER_BIN);
    const auto binBegin = [&] (std::size_t b) { return b * edges_.size () / bins; };
    std::vector<double> noises (bins);
    Flags is_rounded (bins);
    parallelTasks (run_, bins, [&] (std::size_t b) {
      noises[b] = measureNoise (binBegin (b), binBegin (b + 1), is_rounded[b]);
    });
    std::vector<double> usual_noises (bins);
    double farther = std::numeric_limits<double>::infinity (); // least noise, in units of depth
    // Nor do bins between two steps of quantized depths show the size of a step.
    const bool is_smooth = !rays_.are_parallel && std::find (is_rounded.begin (), is_rounded.end (),
                                                             1) == is_rounded.end ();
    for (std::size_t b = bins; b-- > 0;) {
      usual_noises[b] = medianAround (noises, b);
      if (!is_smooth || edges_.empty ())
        continue;
      // Before a background, most edges of near things may be steps.
      const double depth = static_cast<double> (edges_[binBegin (b)].depth);
      usual_noises[b] = std::min (usual_noises[b], NEARER_NOISE * farther / depth);
      farther = std::min (farther, usual_noises[b] * depth);
    }
    Flags is_step_edge (edges_.size (), 0);
    parallelTasks (run_, bins, [&] (std::size_t b) {
      const double noise = usual_noises[b];
      // A bin between two steps of quantized depths does not show the size of a step.
      const double sharp_noise =
          std::max (SHARP_NOISE * noise, is_rounded[b] != 0 ? LARGEST_QUANTUM : 0.0);
      for (std::size_t e = binBegin (b); e < binBegin (b + 1); ++e) {
        const double unit = unitAt (static_cast<double> (edges_[e].depth));
        is_step_edge[e] = isStep (edges_[e].edge, NOISE * noise * unit, sharp_noise * unit) ? 1 : 0;
      }
    });
    for (std::size_t e = 0; e < edges_.size (); ++e) {
      if (is_step_edge[e] == 0)
        continue;
      const MeshEdge edge = edges_[e].edge;
      is_step[edge.triangle] = 1;
      if (const Index other = view_.neighbors[edge.triangle][edge.side]; other != NONE)
        is_step[other] = 1;
    }
    return is_step;
  }

private:
  static std::size_t numberOf (MeshEdge e) { return std::size_t{3} * e.triangle + e.side; }

  void continueSurfaces ()
  {
    continuations_.resize (3 * view_.triangles.size ());
    parallelPoints<std::vector<Index>, std::vector<Index>, std::vector<Vector2d>> (
        run_, view_.triangle_of.size (), [&] (Index p, auto&... scratch) {
          if (view_.triangle_of[p] != NONE)
            continueAround (p, scratch...);
        });
  }

  // All edges that leave p, each with the triangle of p on its opposite side.
  void continueAround (Index p, std::vector<Index>& fan, std::vector<Index>& around,
                       std::vector<Vector2d>& places)
  {
    view_.fan (p, fan, around);
    places.clear ();
    for (const Index q : around)
      places.push_back (rays_.placeBeside (p, q));
    for (std::size_t e = 0; e < fan.size (); ++e) {
      const Vector2d back = -places[e];
      for (std::size_t t = 0; t < fan.size (); ++t) {
        const std::size_t next = (t + 1) % around.size ();
        const double area = cross (places[t], places[next]);
        const double a = cross (back, places[next]) / area, b = cross (places[t], back) / area;
        if (!(a >= 0.0 && b >= 0.0 && area > 0.0))
          continue;
        const auto level = [&] (std::size_t i) {
          return rays_.levels[around[i]] - rays_.levels[p];
        };
        if (1.0 + a + b > MOST_WEIGHT)
          break;
        const std::uint8_t side = TriangleMesh::previous (view_.sideOf (fan[e], p));
        continuations_[numberOf ({fan[e], side})] = {
            static_cast<float> (-(a * level (t) + b * level (next))),
            static_cast<float> (1.0 + a + b)};
        break;
      }
    }
  }

  double changeOf (MeshEdge e) const
  {
    return rays_.levels[view_.to (e)] - rays_.levels[view_.from (e)];
  }

  // The extrapolations along the edge from its first and from its second end.
  std::array<Extension, 2> continuationsOf (MeshEdge e) const
  {
    std::array<Extension, 2> both{continuations_[numberOf (e)], {}};
    if (const MeshEdge mate = view_.mate (e); mate.triangle != NONE) {
      both[1] = continuations_[numberOf (mate)];
      both[1].change = -both[1].change;
    }
    return both;
  }

  // By the depth of their nearer ends.
  void findEdges ()
  {
    edges_.reserve (view_.triangles.size () * 3 / 2 + 3);
    for (Index t = 0; t < view_.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (const Index other = view_.neighbors[t][side]; other == NONE || t < other) {
          const MeshEdge e{t, side};
          edges_.push_back ({e,
                             static_cast<float> (std::min (rays_.depths[view_.from (e)],
                                                           rays_.depths[view_.to (e)])),
                             0.0F});
        }
    parallelPoints (run_, edges_.size (), [&] (Index i) {
      StepEdge& edge = edges_[i];
      const double change = changeOf (edge.edge);
      double least = std::numeric_limits<double>::infinity ();
      for (const Extension& c : continuationsOf (edge.edge))
        if (c.weight > 0.0F)
          least = std::min (least, std::abs (change - static_cast<double> (c.change)) /
                                       static_cast<double> (c.weight));
      edge.deviation = static_cast<float> (least);
    });
    const auto isNearer = [] (const StepEdge& a, const StepEdge& b) {
      return a.depth != b.depth ? a.depth < b.depth : numberOf (a.edge) < numberOf (b.edge);
    };
    sortInParallel (edges_.begin (), edges_.end (), isNearer, run_);
  }

  // Change of the inverse depth for a relative change of depth.
  double unitAt (double depth) const { return rays_.are_parallel ? span_ : 1.0 / depth; }

  // Median over a bin and those beside it. The outline of a round body has constant depth, and most
  // edges of its bin may be steps.
  double medianAround (const std::vector<double>& noises, std::size_t bin) const
  {
    const std::size_t first = bin - std::min (bin, BINS_BESIDE);
    const std::size_t last = std::min (noises.size (), bin + BINS_BESIDE + 1);
    std::vector<double> window (noises.begin () + static_cast<std::ptrdiff_t> (first),
                                noises.begin () + static_cast<std::ptrdiff_t> (last));
    return median (window);
  }

  // Noise of edges of about the same depth, relative to the depth.
  double measureNoise (std::size_t first, std::size_t last, std::uint8_t& is_rounded) const
  {
    std::vector<float> deviations;
    for (std::size_t e = first; e < last; ++e)
      if (std::isfinite (edges_[e].deviation))
        deviations.push_back (edges_[e].deviation);
    if (deviations.empty ())
      return 0.0;
    const auto noise = static_cast<double> (quantile (deviations, NOISE_QUANTILE));
    // Inverse depth per relative depth.
    const double unit = unitAt (static_cast<double> (edges_[first].depth));
    const double usual = static_cast<double> (median (deviations));
    is_rounded = usual > ROUNDING * unit ? 0 : 1;
    if (is_rounded == 0)
      return noise / unit;
    constexpr double ABOVE = 20.0; // times the median: more is not rounding
    constexpr std::size_t FEWEST = 20;
    deviations.erase (std::remove_if (deviations.begin (), deviations.end (),
                                      [usual] (float deviation) {
                                        return static_cast<double> (deviation) <= ABOVE * usual;
                                      }),
                      deviations.end ());
    if (deviations.size () < FEWEST)
      return noise / unit;
    // The weights of a step are 2 or more.
    const auto step = static_cast<double> (quantile (deviations, STEP_QUANTILE));
    return std::max (noise / unit, std::min (step / unit, 0.5 * LARGEST_QUANTUM));
  }

  // Position on a ray at an inverse depth, from the sensor. Non-positive ones are far away.
  Vector3d placeAt (Index ray, double level) const
  {
    if (rays_.are_parallel)
      return rays_.directions[ray] + level * rays_.parallel;
    constexpr double FAR_AWAY = 1e-3; // of the inverse depths around
    return rays_.directions[ray] / std::max (level, FAR_AWAY * rays_.levels[ray]);
  }

  // An edge from one end, and the straight extrapolation of the surface from there to the ray of
  // the other end.
  struct EdgeVectors
  {
    Vector3d edge, straight;
  };

  EdgeVectors vectorsFrom (Index p, Index q, double told) const
  {
    const Vector3d from = placeAt (p, rays_.levels[p]);
    return {placeAt (q, rays_.levels[q]) - from, placeAt (q, told) - from};
  }

  // Change of the depth from a ray on, for a change of its inverse depth.
  double riseTo (Index ray, double change) const
  {
    const double level = rays_.levels[ray] + change;
    if (rays_.are_parallel)
      return std::abs (change);
    return level > 0.0 ? std::abs (1.0 / level - rays_.depths[ray])
                       : std::numeric_limits<double>::infinity ();
  }

  // Whether the surface would bend sharply at the edge.
  bool turnsSharply (const EdgeVectors& v) const
  {
    return v.straight.dot (v.edge) < largest_cosine_ * v.straight.norm () * v.edge.norm ();
  }

  bool isStep (MeshEdge e, double steep_noise, double sharp_noise) const
  {
    const Index p = view_.from (e), q = view_.to (e);
    const double change = changeOf (e);
    const std::array<Extension, 2> both = continuationsOf (e);
    const double width = rays_.distance (p, q) *
                         (rays_.are_parallel ? 1.0 : std::min (rays_.depths[p], rays_.depths[q]));
    const double rise = std::abs (rays_.depths[p] - rays_.depths[q]);
    const bool is_steep = rise > STEEP * width;
    const double continued = rise > GRAZING * width ? CONTINUED_GRAZING : CONTINUED;
    const double least = is_steep ? steep_noise : sharp_noise;
    const auto isNoise = [&] (const Extension& c) {
      return c.weight > 0.0F && std::abs (change - static_cast<double> (c.change)) <=
                                    least * static_cast<double> (c.weight);
    };
    if (isNoise (both[0]) || isNoise (both[1]))
      return false;
    const auto told = [&] (std::size_t end) { return static_cast<double> (both[end].change); };
    const auto goesOn = [&] (std::size_t end) {
      return both[end].weight > 0.0F && told (end) * change >= 0.0 &&
             std::abs (change) <= continued * std::abs (told (end));
    };
    const auto isKnown = [&] (std::size_t end) { return both[end].weight > 0.0F; };
    // Whether the surface goes steeply towards the other end, as far as it is known.
    const auto mayRecede = [&] (std::size_t end) {
      return !isKnown (end) ||
             (told (end) * change > 0.0 &&
              std::abs (told (end)) >=
                  steep_noise / NOISE * static_cast<double> (both[end].weight) &&
              riseTo (end == 0 ? p : q, end == 0 ? told (0) : -told (1)) > STEEP * width);
    };
    if (is_steep && !goesOn (0) && !goesOn (1))
      return !(mayRecede (0) && mayRecede (1) && (isKnown (0) || isKnown (1)));
    if (!isKnown (0) || !isKnown (1))
      return false;
    const EdgeVectors from_p = vectorsFrom (p, q, rays_.levels[p] + told (0));
    const EdgeVectors from_q = vectorsFrom (q, p, rays_.levels[q] - told (1));
    if (is_steep)
      return from_p.edge.norm () >
             JOINT * std::min (from_p.straight.norm (), from_q.straight.norm ());
    const bool meet_between = (change > told (0)) != (change > told (1));
    return !meet_between && turnsSharply (from_p) && turnsSharply (from_q);
  }

  const TriangleMesh& view_;
  const Rays& rays_;
  RunContext run_;
  double span_ = 1.0; // of the depths
  double largest_cosine_ = std::cos (TURN * DEGREE);
  std::vector<Extension> continuations_; // of each edge, by 3 triangle + side, from its first end
  std::vector<StepEdge> edges_;
};

} // namespace

Flags
findDepthSteps (const TriangleMesh& view, const Rays& rays, const RunContext& run)
{
  return StepFinder (view, rays, run).find ();
}

} // namespace pcl::floater
