// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/stars.h"

#include "core/geometry.h"
#include "core/parallel.h"
#include "local/planar_star.h"
#include "local/planes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace pcl::floater {
namespace {
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
             const std::vector<Eigen::Vector3f>& normals, const StarSettings& settings,
             const BeyondNeighbors* beyond)
      : positions_ (positions), neighbors_ (neighbors), normals_ (normals), settings_ (settings),
        beyond_ (beyond)
  {
    if (beyond != nullptr)
      reach_.emplace (positions, normals, beyond->spacing, beyond->tree, settings.limits,
                      beyond->limits);
  }

  /// Makes the star of p; sets `normal` to the normal of its plane. Returns true if the star is
  /// open.
  bool make (Index p, Eigen::Vector3f& normal)
  {
    bool open = makeOfNeighbors (p, normal);
    if (reach_) {
      const Row row = neighbors_.row (p);
      const std::size_t nearest = row.size () - beyond_->beside.neighbors.row (p).size ();
      open = reach_->extend (p, TangentFrame (normal.cast<double> ()), row, nearest, open,
                             star_.candidates, star_.neighbors);
    }
    return open;
  }

  /// Makes the star of p with known far neighbours.
  bool make (Index p, const std::vector<Index>& far, Eigen::Vector3f& normal)
  {
    const bool open = makeOfNeighbors (p, normal);
    if (far.empty ())
      return open;
    const TangentFrame frame (normal.cast<double> ());
    for (const Index q : far)
      addCandidate (p, q, frame, star_);
    star_.neighbors = star_.candidates;
    return planar_star_.make (star_.neighbors);
  }

  const std::vector<PlanarNeighbor>& star () const { return star_.neighbors; }

  /// Far neighbours of the last star.
  const std::vector<Index>& added () const { return reach_->added (); }

private:
  struct Star
  {
    std::vector<PlanarNeighbor> candidates; // input of the triangulation
    std::vector<PlanarNeighbor> neighbors;
  };

  bool makeOfNeighbors (Index p, Eigen::Vector3f& normal)
  {
    normal = normals_[p];
    const TangentFrame frame (normal.cast<double> ());
    if (!settings_.filter_sheets)
      return select (p, frame, Tier::ALL, star_);
    if (!select (p, frame, Tier::EITHER_PLANE, star_))
      return false;
    const Eigen::Vector3d mean = meanNormal (positions_, neighbors_, normals_, p);
    if (!select (p, TangentFrame (mean), Tier::EITHER_PLANE, wider_)) {
      std::swap (star_, wider_);
      normal = mean.cast<float> ();
      return false;
    }
    for (const Tier tier : {Tier::BOTH_PLANES, Tier::ALL})
      if (!select (p, frame, tier, wider_)) {
        std::swap (star_, wider_);
        return false;
      }
    return true; // the star of tier 1, which has the fewest points of other sheets
  }

  bool leavesPlanes (const Eigen::Vector3d& normal, Index q, const Eigen::Vector3d& offset) const
  {
    const double limit = settings_.limits.plane_sine * offset.norm ();
    return std::abs (normal.dot (offset)) > limit &&
           std::abs (normals_[q].cast<double> ().dot (offset)) > limit;
  }

  // Unrolled into the plane: the direction of the projection, the length in space.
  void addCandidate (Index p, Index q, const TangentFrame& frame, Star& star) const
  {
    constexpr double UPRIGHT = 1e-6;
    const Eigen::Vector3d offset = positions_[q] - positions_[p];
    const Eigen::Vector2d projected = frame.project (offset);
    const double planar_length = projected.norm (), length = offset.norm ();
    if (planar_length > UPRIGHT * length)
      star.candidates.push_back ({projected * (length / planar_length), q});
  }

  bool select (Index p, const TangentFrame& frame, Tier tier, Star& star)
  {
    star.candidates.clear ();
    for (const Index q : neighbors_.row (p)) {
      const Eigen::Vector3d offset = positions_[q] - positions_[p];
      if (tier == Tier::ALL ||
          (tier == Tier::EITHER_PLANE
               ? onSameSheet (frame.normal, normals_[q].cast<double> (), offset, settings_.limits)
               : !leavesPlanes (frame.normal, q, offset)))
        addCandidate (p, q, frame, star);
    }
    star.neighbors = star.candidates;
    return settings_.kind == StarKind::DELAUNAY ? planar_star_.make (star.neighbors)
                                                : planar_star_.order (star.neighbors);
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const CsrLists& neighbors_;
  const std::vector<Eigen::Vector3f>& normals_;
  const StarSettings& settings_;
  const BeyondNeighbors* beyond_;
  PlanarStar planar_star_;
  std::optional<StarReach> reach_;
  Star star_, wider_;
};

// The stars of a range of the rows.
struct StarRange
{
  std::vector<Index> ids;
  std::vector<Eigen::Vector2d> offsets;
  std::vector<std::pair<std::size_t, std::vector<Index>>> far; // rows with far neighbours

  void append (const std::vector<PlanarNeighbor>& star, bool with_offsets)
  {
    for (const PlanarNeighbor& neighbor : star) {
      ids.push_back (neighbor.point);
      if (with_offsets)
        offsets.push_back (neighbor.offset);
    }
  }
};

// Removes far neighbours across holes. Returns whether there were any.
bool
leaveOutAcross (const std::vector<Eigen::Vector3d>& positions, const std::vector<float>& reach,
                double gap_ratio, Index p, std::vector<Index>& far)
{
  const std::size_t count = far.size ();
  far.erase (std::remove_if (far.begin (), far.end (),
                             [&] (Index q) {
                               const double longest =
                                   gap_ratio * static_cast<double> (std::max (reach[p], reach[q]));
                               return (positions[q] - positions[p]).norm () > longest;
                             }),
             far.end ());
  return far.size () < count;
}

// Makes the stars of a range again from which far neighbours were removed.
void
makeAgain (StarMaker& maker, const std::vector<Eigen::Vector3d>& positions, double gap_ratio,
           std::size_t first, bool with_offsets, Stars& stars, StarRange& range)
{
  StarRange renewed;
  renewed.ids.reserve (range.ids.size ());
  Index begin = 0;
  std::size_t row = first;
  const auto copyUpTo = [&] (std::size_t end) {
    for (; row < end; ++row) {
      const Index length = stars.neighbors.offsets[row + 1];
      renewed.ids.insert (renewed.ids.end (), range.ids.begin () + begin,
                          range.ids.begin () + begin + length);
      if (with_offsets)
        renewed.offsets.insert (renewed.offsets.end (), range.offsets.begin () + begin,
                                range.offsets.begin () + begin + length);
      begin += length;
    }
  };
  for (auto& [far_row, far] : range.far) {
    copyUpTo (far_row);
    const auto p = static_cast<Index> (far_row);
    if (!leaveOutAcross (positions, stars.reach, gap_ratio, p, far))
      continue;
    begin += stars.neighbors.offsets[p + 1];
    stars.open[p] = maker.make (p, far, stars.normals[p]) ? 1 : 0;
    stars.neighbors.offsets[p + 1] = static_cast<Index> (maker.star ().size ());
    renewed.append (maker.star (), with_offsets);
    ++row;
  }
  copyUpTo (std::min (first + RANGE_LENGTH, stars.open.size ()));
  range.ids.swap (renewed.ids);
  range.offsets.swap (renewed.offsets);
}

// Maximum over each point and its nearest neighbours: in a noisy row of points, some stars are
// narrow.
std::vector<float>
largestAround (const std::vector<float>& values, const CsrLists& neighbors, const RunContext& run)
{
  constexpr std::size_t NEAREST = 6;
  std::vector<float> largest = values;
  parallelRanges (run, values.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
      for (const Index q : neighbors.first (p, NEAREST))
        largest[p] = std::max (largest[p], values[q]);
  });
  return largest;
}

// Packs the lists of far neighbours.
CsrLists
packFar (std::size_t points, const Rows& rows, const std::vector<StarRange>& ranges)
{
  return makeCsrLists (points, [&] (const auto& emit) {
    for (const StarRange& range : ranges)
      for (const auto& [row, far] : range.far)
        for (const Index q : far)
          emit (rows[row], q);
  });
}

// Joins the stars of all ranges, whose lengths are in the offsets. Empties the ranges.
void
pack (std::vector<StarRange>& ranges, bool with_offsets, Stars& stars)
{
  sumRowLengths (stars.neighbors.offsets);
  const std::size_t entries = stars.neighbors.offsets.back ();
  stars.neighbors.ids.reserve (entries);
  stars.offsets_in_plane.reserve (with_offsets ? entries : 0);
  for (StarRange& range : ranges) {
    stars.neighbors.ids.insert (stars.neighbors.ids.end (), range.ids.begin (), range.ids.end ());
    stars.offsets_in_plane.insert (stars.offsets_in_plane.end (), range.offsets.begin (),
                                   range.offsets.end ());
    range = {};
  }
}

// Stars whose lists are not yet packed.
struct StarsInMaking
{
  Stars stars; // without the lists; `offsets` has the length of each row instead
  std::vector<StarRange> ranges;
};

// Stars of some points, each by itself.
StarsInMaking
makeEach (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
          const std::vector<Eigen::Vector3f>& normals, const Rows& rows,
          const StarSettings& settings, const RunContext& run, const BeyondNeighbors* beyond)
{
  const std::size_t n = positions.size ();
  StarsInMaking made;
  Stars& stars = made.stars;
  stars.open.resize (n);
  stars.normals.resize (n);
  stars.neighbors.offsets.assign (n + 1, 0);
  stars.reach.resize (beyond != nullptr ? n : 0);

  // Each range collects its stars; then they are packed.
  made.ranges.resize ((rows.size () + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    StarMaker maker (positions, neighbors, normals, settings, beyond);
    StarRange& range = made.ranges[first / RANGE_LENGTH];
    range.ids.reserve (7 * (last - first));
    for (std::size_t row = first; row < last; ++row) {
      const Index p = rows[row];
      stars.open[p] = maker.make (p, stars.normals[p]) ? 1 : 0;
      stars.neighbors.offsets[p + 1] = static_cast<Index> (maker.star ().size ());
      range.append (maker.star (), settings.with_offsets);
      if (beyond == nullptr)
        continue;
      stars.reach[p] = std::max (beyond->beside.reach[p],
                                 static_cast<float> (reachOf (maker.star (), stars.open[p] != 0)));
      if (!maker.added ().empty ())
        range.far.emplace_back (row, maker.added ());
    }
  });
  return made;
}

// Sets each reach to the maximum around, then removes far neighbours across holes.
void
leaveOutAcrossHoles (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                     const std::vector<Eigen::Vector3f>& normals, const StarSettings& settings,
                     StarsInMaking& made, const RunContext& run)
{
  made.stars.reach = largestAround (made.stars.reach, neighbors, run);
  parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t) {
    StarMaker maker (positions, neighbors, normals, settings, nullptr);
    StarRange& range = made.ranges[first / RANGE_LENGTH];
    if (!range.far.empty ())
      makeAgain (maker, positions, settings.reach.gap_ratio, first, settings.with_offsets,
                 made.stars, range);
  });
}

// Packs the lists.
Stars
packStars (StarsInMaking made, const Rows& rows, const StarSettings& settings)
{
  Stars stars = std::move (made.stars);
  if (!stars.reach.empty ())
    stars.far_neighbors = packFar (stars.open.size (), rows, made.ranges);
  pack (made.ranges, settings.with_offsets, stars);
  return stars;
}

} // namespace

Stars
beginStars (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, const Rows& rows,
            const StarSettings& settings, const RunContext& run, const BeyondNeighbors& beyond)
{
  return packStars (makeEach (positions, neighbors, normals, rows, settings, run, &beyond), rows,
                    settings);
}

Stars
finishStars (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
             const std::vector<Eigen::Vector3f>& normals, Stars begun, const StarSettings& settings,
             const RunContext& run)
{
  const std::size_t n = positions.size ();
  StarsInMaking made;
  made.ranges.resize ((n + RANGE_LENGTH - 1) / RANGE_LENGTH);
  for (std::size_t p = 0; p < n; ++p) {
    StarRange& range = made.ranges[p / RANGE_LENGTH];
    const Row star = begun.neighbors.row (p), far = begun.far_neighbors.row (p);
    range.ids.insert (range.ids.end (), star.begin (), star.end ());
    if (far.size () > 0)
      range.far.emplace_back (p, std::vector<Index> (far.begin (), far.end ()));
  }
  for (std::size_t p = n; p > 0; --p)
    begun.neighbors.offsets[p] -= begun.neighbors.offsets[p - 1]; // back to row lengths
  begun.neighbors.ids = {};
  begun.far_neighbors = {};
  made.stars = std::move (begun);
  leaveOutAcrossHoles (positions, neighbors, normals, settings, made, run);
  return packStars (std::move (made), Rows::all (n), settings);
}

Stars
makeStars (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
           const std::vector<Eigen::Vector3f>& normals, const StarSettings& settings,
           const RunContext& run, const BeyondNeighbors* beyond)
{
  const Rows all = Rows::all (positions.size ());
  StarsInMaking made = makeEach (positions, neighbors, normals, all, settings, run, beyond);
  if (beyond != nullptr)
    leaveOutAcrossHoles (positions, neighbors, normals, settings, made, run);
  return packStars (std::move (made), all, settings);
}

Stars
makeStarsOf (const std::vector<Index>& centres, const std::vector<Eigen::Vector3d>& positions,
             const CsrLists& neighbors, const std::vector<Eigen::Vector3f>& normals,
             const StarSettings& settings, const RunContext& run, const BeyondNeighbors* beyond)
{
  const std::size_t n = centres.size ();
  Stars stars;
  stars.open.resize (n);
  stars.normals.resize (n);
  stars.neighbors.offsets.assign (n + 1, 0);
  std::vector<StarRange> ranges ((n + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (run, n, [&] (std::size_t first, std::size_t last) {
    StarMaker maker (positions, neighbors, normals, settings, beyond);
    for (std::size_t i = first; i < last; ++i) {
      stars.open[i] = maker.make (centres[i], stars.normals[i]) ? 1 : 0;
      stars.neighbors.offsets[i + 1] = static_cast<Index> (maker.star ().size ());
      ranges[first / RANGE_LENGTH].append (maker.star (), settings.with_offsets);
    }
  });
  pack (ranges, settings.with_offsets, stars);
  return stars;
}

bool
hasTriangle (const Stars& stars, Index p, Index q, Index r)
{
  const Row row = stars.neighbors.row (p);
  const std::size_t count = row.size ();
  for (std::size_t i = 0; i < count; ++i) {
    if (row[i] != q)
      continue;
    const bool last = i + 1 == count;
    if (!(last && stars.open[p] != 0) && row[last ? 0 : i + 1] == r)
      return true;
    return !(i == 0 && stars.open[p] != 0) && row[i == 0 ? count - 1 : i - 1] == r;
  }
  return false;
}

std::vector<float>
starAgreement (const Stars& stars, const RunContext& run)
{
  std::vector<float> agreement (stars.open.size (), 0.0F);
  parallelRanges (run, agreement.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t point = first; point < last; ++point) {
      const auto p = static_cast<Index> (point);
      const Row row = stars.neighbors.row (p);
      std::size_t mutual = 0;
      for (const Index q : row) {
        const Row other = stars.neighbors.row (q);
        mutual += std::find (other.begin (), other.end (), p) != other.end () ? 1 : 0;
      }
      if (row.size () > 0)
        agreement[p] = static_cast<float> (mutual) / static_cast<float> (row.size ());
    }
  });
  return agreement;
}

} // namespace pcl::floater
