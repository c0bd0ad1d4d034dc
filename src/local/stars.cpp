// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/stars.h"

#include "core/parallel.h"
#include "core/tangent_frame.h"
#include "local/planar_star.h"
#include "local/smoothed_normals.h"

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
enum class Tier
{
  EITHER_PLANE,
  BOTH_PLANES,
  ALL
};

// Makes the star of one point; scratch is reused from point to point.
class StarMaker
{
public:
  StarMaker (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
             const std::vector<Eigen::Vector3f>& normals, const StarSettings& settings)
      : positions_ (positions), neighbors_ (neighbors), normals_ (normals), settings_ (settings)
  {
  }

  /// Makes the star of p; `normal` becomes that of the plane in which it lies. Returns true if the
  /// star is open.
  bool make (Index p, Eigen::Vector3f& normal)
  {
    normal = normals_[p];
    const TangentFrame frame (normal.cast<double> ());
    if (!settings_.filter_sheets)
      return select (p, frame, Tier::ALL, star_);
    if (!select (p, frame, Tier::EITHER_PLANE, star_))
      return false;
    const Eigen::Vector3d mean = meanNormal (positions_, neighbors_, normals_, p);
    if (!select (p, TangentFrame (mean), Tier::EITHER_PLANE, wider_)) {
      star_.swap (wider_);
      normal = mean.cast<float> ();
      return false;
    }
    for (const Tier tier : {Tier::BOTH_PLANES, Tier::ALL})
      if (!select (p, frame, tier, wider_)) {
        star_.swap (wider_);
        return false;
      }
    return true; // that of the first tier, which has the fewest strays
  }

  const std::vector<PlanarNeighbor>& star () const { return star_; }

private:
  bool select (Index p, const TangentFrame& frame, Tier tier, std::vector<PlanarNeighbor>& star)
  {
    star.clear ();
    for (Index q : neighbors_.row (p)) {
      const Eigen::Vector3d offset = positions_[q] - positions_[p];
      const double length = offset.norm ();
      if (tier != Tier::ALL) {
        const Eigen::Vector3d other_normal = normals_[q].cast<double> ();
        const bool leaves_own =
            std::abs (frame.normal.dot (offset)) > settings_.limits.plane_sine * length;
        const bool leaves_other =
            std::abs (other_normal.dot (offset)) > settings_.limits.plane_sine * length;
        const bool turned =
            std::abs (frame.normal.dot (other_normal)) < settings_.limits.normal_cosine;
        if (tier == Tier::EITHER_PLANE ? leaves_own || leaves_other || turned
                                       : leaves_own && leaves_other)
          continue;
      }
      // Unrolled into the plane: the direction of the projection, the length in space.
      const Eigen::Vector2d projected = frame.project (offset);
      const double planar_length = projected.norm ();
      if (planar_length > 1e-6 * length)
        star.push_back ({projected * (length / planar_length), q});
    }
    return settings_.kind == StarKind::DELAUNAY ? planar_star_.make (star)
                                                : planar_star_.order (star);
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const CsrLists& neighbors_;
  const std::vector<Eigen::Vector3f>& normals_;
  const StarSettings& settings_;
  PlanarStar planar_star_;
  std::vector<PlanarNeighbor> star_, wider_;
};

} // namespace

Stars
makeStars (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
           const std::vector<Eigen::Vector3f>& normals, const StarSettings& settings,
           const RunContext& run)
{
  const std::size_t n = positions.size ();
  Stars stars;
  stars.open.resize (n);
  stars.normals.resize (n);
  stars.neighbors.offsets.assign (n + 1, 0);

  // Each range collects its stars; then they are packed.
  struct Range
  {
    std::vector<Index> ids;
    std::vector<Eigen::Vector2d> offsets;
  };
  std::vector<Range> ranges ((n + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (run, n, [&] (std::size_t first, std::size_t last) {
    StarMaker maker (positions, neighbors, normals, settings);
    Range& range = ranges[first / RANGE_LENGTH];
    range.ids.reserve (7 * (last - first));
    for (std::size_t point = first; point < last; ++point) {
      const auto p = static_cast<Index> (point);
      stars.open[p] = maker.make (p, stars.normals[p]) ? 1 : 0;
      stars.neighbors.offsets[p + 1] = static_cast<Index> (maker.star ().size ());
      for (const PlanarNeighbor& neighbor : maker.star ()) {
        range.ids.push_back (neighbor.point);
        if (settings.with_offsets)
          range.offsets.push_back (neighbor.offset);
      }
    }
  });
  sumRowLengths (stars.neighbors.offsets);
  stars.neighbors.ids.reserve (stars.neighbors.offsets[n]);
  stars.offsets_in_plane.reserve (settings.with_offsets ? stars.neighbors.offsets[n] : 0);
  for (Range& range : ranges) {
    stars.neighbors.ids.insert (stars.neighbors.ids.end (), range.ids.begin (), range.ids.end ());
    stars.offsets_in_plane.insert (stars.offsets_in_plane.end (), range.offsets.begin (),
                                   range.offsets.end ());
    range = {};
  }
  return stars;
}

} // namespace floater
} // namespace pcl
