// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/neighbors.h"

#include "core/parallel.h"

namespace pcl::floater {
namespace {
// Lists of k neighbours, or of all others if there are fewer; not yet filled.
CsrLists
emptyLists (std::size_t points, std::size_t rows, int k)
{
  const std::size_t count =
      std::min (static_cast<std::size_t> (k), std::max<std::size_t> (1, points) - 1);
  requireListed (rows * count);
  CsrLists lists;
  lists.offsets.resize (rows + 1);
  for (std::size_t i = 0; i <= rows; ++i)
    lists.offsets[i] = static_cast<Index> (i * count);
  lists.ids.reserve (rows * count + rows); // far neighbours may be appended, see appendRows
  lists.ids.resize (rows * count);
  return lists;
}

// Searches a tree for the k nearest of the rows, without themselves. NONE for missing ones: points
// whose squared distance underflows may push them out of the results.
void
searchTree (const KdTree& tree, const Positions& positions, const Rows& rows, CsrLists& lists,
            const RunContext& run)
{
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Index> points;
    for (std::size_t i = first; i < last; ++i)
      points.push_back (rows[i]);
    const std::size_t k = lists.offsets[1];
    SequentialSearch (tree, positions, k + 1)
        .search (points, [&] (std::size_t i, const std::vector<Neighbor>& found) {
          tree.looked (positions[points[i]], found.size () > k
                                                 ? std::sqrt (found.back ().sqr_distance)
                                                 : KdTree::EVERYWHERE);
          Index* const row = lists.ids.data () + (first + i) * k;
          std::size_t count = 0;
          for (const Neighbor& neighbor : found)
            if (neighbor.point != points[i] && count < k)
              row[count++] = neighbor.point;
          std::fill (row + count, row + k, NONE);
        });
  });
}

CsrLists
nearestByTree (const KdTree& tree, const Positions& positions, const Rows& rows, int k,
               const RunContext& run)
{
  CsrLists lists = emptyLists (positions.size (), rows.size (), k);
  searchTree (tree, positions, rows, lists, run);
  return lists;
}

constexpr std::size_t MOST_IN_BALL = 200; // beside a jump in density there may be any number

// Radius of the ball around a point, given its nearest others. Widened to the farthest of them if
// needed.
double
ballRadius (const std::vector<Neighbor>& nearest, double radius)
{
  if (nearest.empty ())
    return 0.0;
  double sum = 0.0;
  for (const Neighbor& neighbor : nearest)
    sum += std::sqrt (neighbor.sqr_distance);
  const double spacing = sum / static_cast<double> (nearest.size ());
  constexpr double ROUNDING = 1.0 + 1e-15; // squaring a square root may round down
  return std::max (radius * spacing, ROUNDING * std::sqrt (nearest.back ().sqr_distance));
}

// The caller's search. For one thread.
class CallerSearch
{
public:
  CallerSearch (const Points& points, NeighborSearch& search) : points_ (points), search_ (search)
  {
    std::vector<Index> sorted = points.cloud_index;
    std::sort (sorted.begin (), sorted.end ());
    point_of_.assign (sorted.empty () ? 0 : sorted.back () + std::size_t{1}, NONE);
    for (std::size_t p = 0; p < points.cloud_index.size (); ++p)
      point_of_[points.cloud_index[p]] = static_cast<Index> (p);
    search.build (sorted);
  }

  // See searchEach.
  void operator() (Index p, double radius, std::size_t most, std::vector<Neighbor>& found)
  {
    if (radius == KdTree::EVERYWHERE)
      nearest (p, most, found);
    else
      within (p, radius, found);
    found.resize (std::min (most, found.size ()));
  }

private:
  void nearest (Index p, std::size_t k, std::vector<Neighbor>& found)
  {
    search_.nearest (points_.cloud_index[p], static_cast<int> (k + 1), cloud_indices_);
    translate (p, found);
  }

  void within (Index p, double radius, std::vector<Neighbor>& found)
  {
    // Searches of PCL compute in single precision: search a little farther, then measure.
    constexpr double MORE = 1.0 + 1e-5;
    const auto is_outside = [sqr_radius = radius * radius] (const Neighbor& neighbor) {
      return neighbor.sqr_distance > sqr_radius;
    };
    if (search_.within (points_.cloud_index[p], MORE * points_.scale * radius, cloud_indices_))
      translate (p, found);
    else
      for (std::size_t k = 32;; k *= 2) {
        nearest (p, std::min (k, points_.positions.size ()), found);
        if (found.size () < k || is_outside (found.back ()))
          break;
      }
    found.erase (std::find_if (found.begin (), found.end (), is_outside), found.end ());
  }

  // Measures what was found.
  void translate (Index p, std::vector<Neighbor>& found) const
  {
    const Positions& positions = points_.workingPositions ();
    found.clear ();
    for (const Index cloud_index : cloud_indices_)
      if (cloud_index < point_of_.size () && point_of_[cloud_index] != NONE &&
          point_of_[cloud_index] != p) {
        const Index q = point_of_[cloud_index];
        found.push_back ({(positions[q] - positions[p]).squaredNorm (), q});
      }
    std::sort (found.begin (), found.end ());
    found.erase (
        std::unique (found.begin (), found.end (),
                     [] (const Neighbor& a, const Neighbor& b) { return a.point == b.point; }),
        found.end ());
  }

  const Points& points_;
  NeighborSearch& search_;
  std::vector<Index> point_of_;      // by cloud index
  std::vector<Index> cloud_indices_; // the answer of the search
};

// \param search (p, radius, most, found) finds other points, nearest first
template <typename Search>
CsrLists
searchEach (const Rows& rows, const NeighborOptions& options, Search&& search,
            const RunContext& run)
{
  const bool in_balls = isInBalls (options.kind);
  RangeRows lists (rows.size (), rows.size ());
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Neighbor> found;
    for (std::size_t i = first; i < last; ++i) {
      search (rows[i], KdTree::EVERYWHERE,
              in_balls ? SPACING_NEIGHBORS : static_cast<std::size_t> (options.k), found);
      if (in_balls)
        search (rows[i], ballRadius (found, options.ball_radius), MOST_IN_BALL, found);
      for (const Neighbor& neighbor : found)
        lists.add (first, i, neighbor.point);
    }
  });
  return lists.join ();
}

CsrLists
findNeighborsOf (const Rows& rows, const Points& points, const NeighborSettings& settings,
                 const RunContext& run, std::optional<KdTree>* tree = nullptr)
{
  const Positions& positions = points.workingPositions ();
  if (settings.search != nullptr)
    return searchEach (rows, settings.options, CallerSearch (points, *settings.search),
                       run.withThreads (1));
  std::optional<KdTree> own;
  std::optional<KdTree>& used = tree != nullptr ? *tree : own;
  const bool in_balls = isInBalls (settings.options.kind);
  used.emplace (positions, run, in_balls ? PointOrder::ANY : PointOrder::ALONG_CURVE);
  if (!in_balls)
    return nearestByTree (*used, positions, rows, settings.options.k, run);
  const auto search = [&] (Index p, double radius, std::size_t most, std::vector<Neighbor>& found) {
    const auto isOther = [p] (const Neighbor& other, const auto&) { return other.point != p; };
    used->nearestIf (positions[p], Vector3d::Zero (), radius, most, isOther, found);
  };
  return searchEach (rows, settings.options, search, run);
}

} // namespace

CsrLists
findNearestNeighbors (const Positions& positions, const Rows& rows, int k, const RunContext& run)
{
  return nearestByTree (KdTree (positions, run), positions, rows, k, run);
}

CsrLists
findNearestOfBlock (BlockSearch& search, std::size_t points, int k, const RunContext& run)
{
  CsrLists lists = emptyLists (points, search.ownLast () - search.ownFirst (), k);
  do
    searchTree (search.makeTree (run), search.positions (),
                Rows::range (search.ownFirst (), search.ownLast ()), lists, run);
  while (search.widen ());
  for (Index& place : lists.ids)
    place = place == NONE ? NONE : search.points ()[place];
  return lists;
}

double
spacingOf (const Positions& positions, Index p, const Row& row)
{
  const std::size_t count = std::min<std::size_t> (SPACING_NEIGHBORS, row.size ());
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    sum += (positions[row[i]] - positions[p]).norm ();
  return count > 0 ? sum / static_cast<double> (count) : 0.0;
}

std::vector<float>
localSpacing (const Positions& positions, const CsrLists& neighbors, const RunContext& run)
{
  std::vector<float> spacing (positions.size ());
  parallelPoints (run, spacing.size (), [&] (Index p) {
    spacing[p] = static_cast<float> (spacingOf (positions, p, neighbors.row (p)));
  });
  return spacing;
}

CsrLists
findNeighbors (const Points& points, const NeighborSettings& settings, const RunContext& run,
               std::optional<KdTree>* tree)
{
  if (tree != nullptr)
    tree->reset ();
  return findNeighborsOf (Rows::all (points.size ()), points, settings, run, tree);
}

CsrLists
renewNeighbors (const Points& points, const std::vector<Index>& removed, const CsrLists& neighbors,
                const NeighborSettings& settings, const RunContext& run)
{
  std::vector<Index> number (neighbors.rows (), NONE); // of each point among those that remain
  Index kept = 0;
  for (Index p = 0; p < number.size (); ++p)
    if (p - kept == removed.size () || removed[p - kept] != p)
      number[p] = kept++;
  const auto isGone = [&number] (Index p) { return number[p] == NONE; };
  std::vector<Index> changed; // points that lost a neighbour
  for (Index p = 0; p < number.size (); ++p)
    if (const Row row = neighbors.row (p);
        !isGone (p) && std::any_of (row.begin (), row.end (), isGone))
      changed.push_back (number[p]);
  const CsrLists renewed = findNeighborsOf (Rows::of (changed), points, settings, run);
  return makeCsrLists (kept, [&] (const auto& emit) {
    std::size_t next = 0; // among the changed
    for (Index p = 0; p < number.size (); ++p) {
      if (isGone (p))
        continue;
      const bool is_changed = next < changed.size () && changed[next] == number[p];
      for (const Index q : is_changed ? renewed.row (next++) : neighbors.row (p))
        emit (number[p], is_changed ? q : number[q]);
    }
  });
}

} // namespace pcl::floater
