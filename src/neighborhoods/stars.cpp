// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighborhoods/stars.h"

#include "common/parallel.h"
#include "neighborhoods/mean_normals.h"
#include "neighborhoods/planar_star.h"
#include "neighborhoods/tangent_frame.h"

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double LEAVES_PLANE = 0.75; // sine of the angle between a neighbour and a tangent plane
constexpr double SAME_SIDE = 0.3;     // cosine between the normals of neighbours

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
  StarMaker (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
             const std::vector<Eigen::Vector3f>& normals, StarKind kind)
      : positions_ (positions), near_ (near), normals_ (normals), kind_ (kind)
  {
  }

  /// Makes the star of p; `normal` becomes that of the plane in which it lies. Returns true if the
  /// star is open.
  bool make (Index p, bool filter_sheets, Eigen::Vector3f& normal)
  {
    normal = normals_[p];
    const TangentFrame frame (normal.cast<double> ());
    if (!filter_sheets)
      return select (p, frame, Tier::ALL, star_);
    if (!select (p, frame, Tier::EITHER_PLANE, star_))
      return false;
    const Eigen::Vector3d mean = meanNormal (positions_, near_, normals_, p);
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
    for (Index q : near_.row (p)) {
      const Eigen::Vector3d offset = positions_[q] - positions_[p];
      const double length = offset.norm ();
      if (tier != Tier::ALL) {
        const Eigen::Vector3d other_normal = normals_[q].cast<double> ();
        const bool leaves_own = std::abs (frame.normal.dot (offset)) > LEAVES_PLANE * length;
        const bool leaves_other = std::abs (other_normal.dot (offset)) > LEAVES_PLANE * length;
        const bool turned = std::abs (frame.normal.dot (other_normal)) < SAME_SIDE;
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
    return kind_ == StarKind::DELAUNAY ? planar_star_.make (star) : planar_star_.order (star);
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const FlatLists& near_;
  const std::vector<Eigen::Vector3f>& normals_;
  StarKind kind_;
  PlanarStar planar_star_;
  std::vector<PlanarNeighbor> star_, wider_;
};

Stars
makeSomeStars (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
               const std::vector<Eigen::Vector3f>& normals, const Selection& rows,
               bool filter_sheets, int threads, StarKind kind, bool with_offsets)
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
  std::vector<Range> ranges ((rows.size () + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (rows.size (), threads, [&] (std::size_t first, std::size_t last) {
    StarMaker maker (positions, near, normals, kind);
    Range& range = ranges[first / RANGE_LENGTH];
    range.ids.reserve (7 * (last - first));
    for (std::size_t i = first; i < last; ++i) {
      const Index p = rows[i];
      stars.open[p] = maker.make (p, filter_sheets, stars.normals[p]) ? 1 : 0;
      stars.neighbors.offsets[p + 1] = static_cast<Index> (maker.star ().size ());
      for (const PlanarNeighbor& neighbor : maker.star ()) {
        range.ids.push_back (neighbor.point);
        if (with_offsets)
          range.offsets.push_back (neighbor.offset);
      }
    }
  });
  for (std::size_t p = 0; p < n; ++p)
    stars.neighbors.offsets[p + 1] += stars.neighbors.offsets[p];
  stars.neighbors.ids.reserve (stars.neighbors.offsets[n]);
  stars.offsets_in_plane.reserve (with_offsets ? stars.neighbors.offsets[n] : 0);
  for (Range& range : ranges) {
    stars.neighbors.ids.insert (stars.neighbors.ids.end (), range.ids.begin (), range.ids.end ());
    stars.offsets_in_plane.insert (stars.offsets_in_plane.end (), range.offsets.begin (),
                                   range.offsets.end ());
    range = {};
  }
  return stars;
}

} // namespace

Stars
makeStars (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
           const std::vector<Eigen::Vector3f>& normals, bool filter_sheets, int threads,
           StarKind kind)
{
  return makeSomeStars (positions, near, normals, Selection::all (positions.size ()), filter_sheets,
                        threads, kind, true);
}

Stars
makeStarsOf (const Selection& rows, const std::vector<Eigen::Vector3d>& positions,
             const FlatLists& near, const std::vector<Eigen::Vector3f>& normals, bool filter_sheets,
             int threads)
{
  return makeSomeStars (positions, near, normals, rows, filter_sheets, threads, StarKind::DELAUNAY,
                        false);
}

std::vector<float>
localSpacing (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near, int threads)
{
  return localSpacing (Selection::all (positions.size ()), positions, near, threads);
}

std::vector<float>
localSpacing (const Selection& rows, const std::vector<Eigen::Vector3d>& positions,
              const FlatLists& near, int threads)
{
  constexpr std::size_t NEAREST = 6;
  std::vector<float> spacing (positions.size ());
  parallelRanges (rows.size (), threads, [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Index p = rows[i];
      const Row row = near.row (p);
      const std::size_t count = std::min (NEAREST, row.size ());
      double sum = 0.0;
      for (std::size_t j = 0; j < count; ++j)
        sum += (positions[row[j]] - positions[p]).norm ();
      spacing[p] =
          static_cast<float> (sum / static_cast<double> (std::max<std::size_t> (1, count)));
    }
  });
  return spacing;
}

} // namespace floater
} // namespace pcl
