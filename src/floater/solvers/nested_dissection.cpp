// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/nested_dissection.h"

#include "core/parallel.h"
#include "floater/solvers/vertex_cut.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl::floater {
namespace {
// Sets of so few unknowns are not dissected: their fronts are small in any order.
constexpr std::size_t SMALLEST_SET = 8;
// Half the width of the band: as a share of the set, or in rows of unknowns if that is less. A
// wider band gives smaller cuts and takes longer: twice as many rows save 2 % of the factors and
// take one and a half times as long.
constexpr double BAND_SHARE = 0.1;
constexpr double BAND_ROWS = 5.0;

// A set of unknowns by its places in the order.
struct Set
{
  std::size_t begin, end;
  std::size_t size () const { return end - begin; }
};

// Calls visit (i, j) for all i and j in the pattern of A + A^T, without the diagonal.
template <typename Visit>
void
visitPairs (const LinearSystem& system, Visit&& visit)
{
  const auto row = [&system] (std::size_t i) {
    const int* columns = system.columns.data ();
    return std::make_pair (columns + system.row_offsets[i], columns + system.row_offsets[i + 1]);
  };
  for (std::size_t i = 0; i < system.unknowns (); ++i) {
    const auto [first, last] = row (i);
    for (const int* column = first; column != last; ++column) {
      const auto j = static_cast<std::size_t> (*column);
      if (i == j)
        continue;
      visit (i, j);
      const auto [mate_first, mate_last] = row (j);
      if (!std::binary_search (mate_first, mate_last, static_cast<int> (i)))
        visit (j, i);
    }
  }
}

// Parts the sets of one level. It reads places as they were when the level began, and writes only
// to the places of its own set, so that several of them may work at the same time.
class Dissector
{
public:
  Dissector (const CsrLists& graph, const std::vector<Index>& points,
             const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& places)
      : graph_ (graph), points_ (points), positions_ (positions), places_ (places)
  {
  }

  // Reorders a set: the first half, the second half, the cut. Both halves keep the order they had.
  // \return the halves
  std::array<Set, 2> part (const Set& set, std::vector<int>& order)
  {
    unknowns_.assign (order.begin () + static_cast<std::ptrdiff_t> (set.begin),
                      order.begin () + static_cast<std::ptrdiff_t> (set.end));
    findBand ();
    widenBand (set);
    joinBand (set);
    const std::vector<CutPart>& parts = cut_.find (band_graph_, ends_);
    const auto partOf = [&] (std::size_t i) {
      return where_[i] == BELOW   ? CutPart::FIRST
             : where_[i] == ABOVE ? CutPart::SECOND
                                  : parts[where_[i]];
    };
    std::size_t next = set.begin;
    std::array<Set, 2> halves{};
    for (const CutPart part : {CutPart::FIRST, CutPart::SECOND, CutPart::CUT}) {
      const std::size_t begin = next;
      for (std::size_t i = 0; i < unknowns_.size (); ++i)
        if (partOf (i) == part)
          order[next++] = unknowns_[i];
      if (part != CutPart::CUT)
        halves[static_cast<std::size_t> (part)] = {begin, next};
    }
    return halves;
  }

private:
  // Instead of a place in the band: the side of an unknown outside of it, or that it is within but
  // has no place yet.
  static constexpr Index BELOW = NONE, ABOVE = NONE - 1, WITHIN = NONE - 2;

  const Eigen::Vector3d& positionOf (std::size_t i) const
  {
    return positions_[points_[static_cast<std::size_t> (unknowns_[i])]];
  }

  int widestCoordinate () const
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero (), squares = sum;
    const Eigen::Vector3d& origin = positionOf (0);
    for (std::size_t i = 0; i < unknowns_.size (); ++i) {
      const Eigen::Vector3d offset = positionOf (i) - origin;
      sum += offset;
      squares += offset.cwiseAbs2 ();
    }
    int widest = 0;
    (squares - sum.cwiseAbs2 () / static_cast<double> (unknowns_.size ())).maxCoeff (&widest);
    return widest;
  }

  void findBand ()
  {
    const std::size_t count = unknowns_.size ();
    const int coordinate = widestCoordinate ();
    keys_.resize (count);
    for (std::size_t i = 0; i < count; ++i)
      keys_[i] = {static_cast<float> (positionOf (i)[coordinate]), static_cast<Index> (i)};
    const auto size = static_cast<double> (count);
    const double half = std::min (BAND_SHARE * size, BAND_ROWS * std::sqrt (size));
    const auto low = static_cast<std::ptrdiff_t> (0.5 * size - half);
    const auto high = static_cast<std::ptrdiff_t> (0.5 * size + half);
    std::nth_element (keys_.begin (), keys_.begin () + low, keys_.end ());
    std::nth_element (keys_.begin () + low, keys_.begin () + high, keys_.end ());
    where_.resize (count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto rank = static_cast<std::ptrdiff_t> (i);
      where_[keys_[i].second] = rank < low ? BELOW : rank < high ? WITHIN : ABOVE;
    }
  }

  // Calls visit (j) for each neighbour j of unknown i within the set; both are numbered in the set.
  template <typename Visit>
  void visitNeighbors (const Set& set, std::size_t i, Visit&& visit) const
  {
    for (const Index neighbor : graph_.row (static_cast<std::size_t> (unknowns_[i])))
      if (places_[neighbor] >= set.begin && places_[neighbor] < set.end)
        visit (places_[neighbor] - set.begin);
  }

  // Adds the unknowns below the band that have a neighbour above it, since no pair may bypass the
  // band. Then gives all unknowns of the band their places.
  void widenBand (const Set& set)
  {
    for (std::size_t i = 0; i < unknowns_.size (); ++i)
      if (where_[i] == BELOW)
        visitNeighbors (set, i, [&] (std::size_t j) {
          if (where_[j] == ABOVE)
            where_[i] = WITHIN;
        });
    band_.clear ();
    for (std::size_t i = 0; i < unknowns_.size (); ++i)
      if (where_[i] == WITHIN) {
        where_[i] = static_cast<Index> (band_.size ());
        band_.push_back (static_cast<Index> (i));
      }
  }

  void joinBand (const Set& set)
  {
    band_graph_.offsets.assign (1, 0);
    band_graph_.ids.clear ();
    ends_.assign (band_.size (), INSIDE);
    for (std::size_t b = 0; b < band_.size (); ++b) {
      visitNeighbors (set, band_[b], [&] (std::size_t i) {
        if (where_[i] == BELOW)
          ends_[b] |= NEXT_TO_FIRST;
        else if (where_[i] == ABOVE)
          ends_[b] |= NEXT_TO_SECOND;
        else
          band_graph_.ids.push_back (where_[i]);
      });
      band_graph_.offsets.push_back (static_cast<Index> (band_graph_.ids.size ()));
    }
  }

  const CsrLists& graph_;
  const std::vector<Index>& points_;
  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Index>& places_;

  std::vector<int> unknowns_; // of the set
  std::vector<std::pair<float, Index>> keys_;
  std::vector<Index> where_; // per unknown of the set: place in the band, or side of it
  std::vector<Index> band_;  // unknowns of the set that are in the band
  CsrLists band_graph_;
  std::vector<std::uint8_t> ends_;
  VertexCut cut_;
};

// Adds the halves of a set to the sets, and to `next` if they are to be parted.
void
addHalves (Index whole, const std::array<Set, 2>& halves, std::vector<DissectedSet>& sets,
           std::vector<Index>& next)
{
  const std::size_t size = sets[whole].end - sets[whole].begin;
  if (halves[0].size () == size || halves[1].size () == size)
    return; // all unknowns are in one place
  sets[whole].cut = static_cast<Index> (halves[1].end);
  for (std::size_t side = 0; side < 2; ++side) {
    const Set& half = halves[side];
    if (half.size () == 0)
      continue;
    const auto begin = static_cast<Index> (half.begin), end = static_cast<Index> (half.end);
    sets[whole].halves[side] = static_cast<Index> (sets.size ());
    if (half.size () > SMALLEST_SET)
      next.push_back (static_cast<Index> (sets.size ()));
    sets.push_back ({begin, begin, end, {NONE, NONE}});
  }
}

} // namespace

CsrLists
symmetricPattern (const LinearSystem& system)
{
  return makeCsrLists (system.unknowns (), [&] (const auto& emit) {
    visitPairs (system, [&] (std::size_t i, std::size_t j) { emit (i, static_cast<Index> (j)); });
  });
}

Dissection
dissect (const CsrLists& pattern, const std::vector<Index>& points,
         const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
{
  const std::size_t count = pattern.rows ();
  Dissection result;
  result.order.resize (count);
  std::iota (result.order.begin (), result.order.end (), 0);
  std::vector<Index> places (count);
  std::iota (places.begin (), places.end (), Index{0});
  result.sets.push_back ({0, 0, static_cast<Index> (count), {NONE, NONE}});
  std::vector<Index> level; // sets to be parted
  if (count > SMALLEST_SET)
    level.push_back (0);
  for (std::vector<std::array<Set, 2>> halves; !level.empty ();) {
    halves.resize (level.size ());
    constexpr std::size_t CHUNKS = 64; // tasks, each with working memory of its own
    const std::size_t length = level.size () / CHUNKS + 1;
    parallelTasks (run, (level.size () + length - 1) / length, [&] (std::size_t chunk) {
      Dissector dissector (pattern, points, positions, places);
      for (std::size_t s = chunk * length; s < std::min (level.size (), (chunk + 1) * length);
           ++s) {
        const DissectedSet& set = result.sets[level[s]];
        halves[s] = dissector.part ({set.begin, set.end}, result.order);
      }
    });
    parallelRanges (run, count, [&] (std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        places[static_cast<std::size_t> (result.order[i])] = static_cast<Index> (i);
    });
    std::vector<Index> next;
    for (std::size_t s = 0; s < level.size (); ++s)
      addHalves (level[s], halves[s], result.sets, next);
    level = std::move (next);
  }
  return result;
}

std::vector<int>
dissectUnknowns (const LinearSystem& system, const std::vector<Eigen::Vector3d>& positions,
                 const RunContext& run)
{
  return dissect (symmetricPattern (system), system.point_of_unknown, positions, run).order;
}

} // namespace pcl::floater
