// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Mends the border between two sides of space where it is no manifold.
#pragma once

#include "core/exact.h"
#include "core/order_statistics.h"

namespace pcl::floater {
/// Moves tetrahedra to the other side where a free point does not have one piece of either side
/// around it. What it is given must outlive it.
class SideMending
{
public:
  /// \param is_free   of each point
  /// \param overlap   across each facet of each tetrahedron, see remakePlace ()
  /// \param is_behind of each tetrahedron: its side, which changes
  SideMending (const Tetrahedra& all, const Flags& is_free,
               const std::vector<std::array<double, 4>>& overlap, Flags& is_behind)
      : all_ (all), is_free_ (is_free), overlap_ (overlap), is_behind_ (is_behind),
        flaws_ (is_free.size (), NONE), is_reached_ (all.size ())
  {
  }

  /// Number of free points that are not mended.
  std::size_t flawed ()
  {
    std::size_t count = 0;
    for (Index p = 0; p < is_free_.size (); ++p)
      count += isFlawed (p) ? 1 : 0;
    return count;
  }

  /// Turns single tetrahedra, or pieces around a point: those that cure most, of equal ones those
  /// that give the surface the facets of least overlap. Where none cures anything, a chain of them may:
  /// the first makes new flaws, which the next ones cure. It ends early where points are on many
  /// tetrahedra.
  void mend ()
  {
    most_work_ = work_ + std::max (LEAST_WORK, WORK * is_free_.size ());
    const auto mendAll = [this] (bool by_chains) {
      bool has_changed = false;
      for (Index p = 0; p < is_free_.size () && work_ < most_work_; ++p)
        if (isFlawed (p)) {
          has_changed = (by_chains ? mendByChain (p) : mendAt (p) > 0) || has_changed;
          chain_.clear ();
        }
      return has_changed;
    };
    for (int round = 0; round < ROUNDS && (mendAll (false) || mendAll (true)); ++round)
      ;
  }

private:
  static constexpr int ROUNDS = 50; // ends it where each change causes another one
  // Tetrahedra around points that may be looked at, for each point: at some 20 nanoseconds. A point
  // on many tetrahedra would take the cube of their number.
  static constexpr std::size_t WORK = 2000, LEAST_WORK = 2'000'000;
  // Moves; with 12, as many of 280 noisy bodies and sheets were right.
  static constexpr std::size_t LONGEST_CHAIN = 6;

  using Move = std::vector<Index>; // tetrahedra that are turned together

  struct RatedMove
  {
    long gain;   // flaws that it cures
    double cost; // overlap of the facets that the surface gets, less that of those it loses
    Move move;
  };

  // Pieces of either side around a point, beyond one each; many if there is one side only.
  // \param pieces if not nullptr: the tetrahedra of each piece, where its side has several
  std::size_t flawsAt (Index p, std::vector<std::vector<Index>>* pieces = nullptr)
  {
    constexpr std::size_t ENCLOSED = 100;
    const Row around = all_.around.row (p);
    work_ += around.size ();
    for (const Index t : around)
      is_reached_[t] = 0;
    std::array<std::size_t, 2> count{};
    std::vector<std::vector<Index>> found;
    for (const Index start : around) {
      if (is_reached_[start]++ != 0)
        continue;
      const std::uint8_t side = is_behind_[start];
      piece_.assign (1, start);
      for (std::size_t i = 0; i < piece_.size (); ++i)
        for (unsigned k = 0; k < 4; ++k) {
          const Index t = piece_[i], other = all_.neighbors[t][k];
          if (all_.corners[t][k] != p && is_behind_[other] == side && is_reached_[other]++ == 0)
            piece_.push_back (other);
        }
      ++count[side];
      if (pieces != nullptr)
        found.push_back (piece_);
    }
    if (pieces != nullptr)
      for (std::vector<Index>& piece : found)
        if (count[is_behind_[piece.front ()]] > 1)
          pieces->push_back (std::move (piece));
    return count[0] > 0 && count[1] > 0 ? count[0] + count[1] - 2 : ENCLOSED;
  }

  // The same as long as no tetrahedron there is turned.
  std::size_t knownFlawsAt (Index p)
  {
    if (flaws_[p] == NONE)
      flaws_[p] = static_cast<Index> (flawsAt (p));
    return flaws_[p];
  }

  bool isFlawed (Index p) { return is_free_[p] != 0 && knownFlawsAt (p) > 0; }

  // Pieces around a point, and single tetrahedra, the best first; none that the chain has turned.
  // \param least flaws that each of them is to cure
  std::vector<RatedMove> movesAt (Index p, long least)
  {
    std::vector<Move> moves;
    flawsAt (p, &moves);
    for (const Index t : all_.around.row (p))
      moves.push_back ({t});
    std::vector<RatedMove> rated;
    for (Move& move : moves) {
      if (work_ >= most_work_)
        return {};
      if (std::any_of (move.begin (), move.end (), [this] (Index t) { return isFixed (t); }))
        continue;
      if (const long gain = gainOf (move, least); gain >= least)
        rated.push_back ({gain, costOf (move), std::move (move)});
    }
    std::stable_sort (
        rated.begin (), rated.end (), [] (const RatedMove& one, const RatedMove& other) {
          return one.gain != other.gain ? one.gain > other.gain : one.cost < other.cost;
        });
    return rated;
  }

  bool isFixed (Index t) const
  {
    return all_.isInfinite (t) ||
           std::any_of (chain_.begin (), chain_.end (), [t] (const Move& move) {
             return std::find (move.begin (), move.end (), t) != move.end ();
           });
  }

  // Exact from `least` on; otherwise any number below.
  long gainOf (const Move& move, long least)
  {
    const std::vector<Index> points = cornersOf (move);
    long gain = 0;
    for (const Index q : points)
      gain += static_cast<long> (knownFlawsAt (q));
    turn (move);
    for (auto q = points.begin (); q != points.end () && gain >= least; ++q)
      gain -= static_cast<long> (flawsAt (*q));
    turn (move);
    return gain;
  }

  double costOf (const Move& move) const
  {
    double cost = 0.0;
    for (const Index t : move)
      for (unsigned k = 0; k < 4; ++k)
        cost +=
            is_behind_[all_.neighbors[t][k]] == is_behind_[t] ? overlap_[t][k] : -overlap_[t][k];
    return cost;
  }

  // Makes the best move at a point, unless it cures nothing.
  // \return how many flaws it cures
  long mendAt (Index p)
  {
    const std::vector<RatedMove> rated = movesAt (p, 1);
    return rated.empty () ? 0 : make (rated.front ());
  }

  // Begins with any move, and goes on with the best one at each flaw that comes of it.
  bool mendByChain (Index p)
  {
    for (const RatedMove& first : movesAt (p, std::numeric_limits<long>::min ())) {
      long gain = make (first);
      for (std::size_t link = 0; link < chain_.size () && gain <= 0; ++link)
        for (const Index q : cornersOf (chain_[link]))
          for (long more = 1;
               more > 0 && gain <= 0 && isFlawed (q) && chain_.size () < LONGEST_CHAIN;
               gain += more)
            more = mendAt (q);
      if (gain > 0)
        return true;
      for (const Move& move : chain_)
        turnForGood (move);
      chain_.clear ();
    }
    return false;
  }

  long make (const RatedMove& rated)
  {
    turnForGood (rated.move);
    chain_.push_back (rated.move);
    return rated.gain;
  }

  std::vector<Index> cornersOf (const Move& tetrahedra) const
  {
    std::vector<Index> points;
    for (const Index t : tetrahedra)
      for (const Index p : all_.corners[t])
        if (p != NONE)
          points.push_back (p);
    sortUnique (points);
    return points;
  }

  void turnForGood (const Move& tetrahedra)
  {
    turn (tetrahedra);
    for (const Index p : cornersOf (tetrahedra))
      flaws_[p] = NONE;
  }

  void turn (const Move& tetrahedra)
  {
    for (const Index t : tetrahedra)
      is_behind_[t] ^= 1U;
  }

  const Tetrahedra& all_;
  const Flags& is_free_;
  const std::vector<std::array<double, 4>>& overlap_;
  Flags& is_behind_;
  std::vector<Move> chain_;              // turned one after the other, not again
  std::vector<Index> flaws_;             // of each point: flawsAt (), NONE if not known
  std::vector<Index> piece_;             // scratch of flawsAt ()
  Flags is_reached_;                     // of each tetrahedron: the same
  std::size_t work_ = 0, most_work_ = 0; // tetrahedra that flawsAt () has looked at, and may
};

} // namespace pcl::floater
