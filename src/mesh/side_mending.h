// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Mends the border between two sides of space where it is no manifold.
#pragma once

#include "core/exact.h"
#include "core/order_statistics.h"

namespace pcl::floater {
/// Moves tetrahedra to the other side where a free point does not have one piece of either side
/// around it. What it is given must outlive it.
struct SideMending
{
  using Move = std::vector<Index>; // tetrahedra that are turned together

  struct RatedMove
  {
    long gain;   // flaws that it cures
    double cost; // overlap of the facets that the surface gets, less that of those it loses
    Move move;
  };

  const Tetrahedra& all;
  const Flags& is_free;                              ///< of each point
  const std::vector<std::array<double, 4>>& overlap; ///< across each facet of each tetrahedron, see
                                                     ///< remakePlace ()
  Flags& is_behind;             ///< of each tetrahedron: its side, which changes
  std::vector<Move> chain = {}; // turned one after the other, not again
  // Of each point: flawsAt (), NONE if not known.
  std::vector<Index> flaws = std::vector<Index> (is_free.size (), NONE);
  std::vector<Index> reached = {};        // scratch of flawsAt ()
  Flags is_reached = Flags (all.size ()); // of each tetrahedron: the same
  std::size_t work = 0, most_work = 0;    // tetrahedra that flawsAt () has looked at, and may

  /// Number of free points that are not mended.
  std::size_t flawed ()
  {
    std::size_t count = 0;
    for (Index p = 0; p < is_free.size (); ++p)
      count += isFlawed (p) ? 1 : 0;
    return count;
  }

  /// Turns single tetrahedra, or pieces around a point: those that cure most, of equal ones those
  /// that give the surface the facets of least overlap. Where none cures anything, a chain of them may:
  /// the first makes new flaws, which the next ones cure. It ends early where points are on many
  /// tetrahedra.
  void mend ()
  {
    most_work = work + std::max (LEAST_WORK, WORK * is_free.size ());
    const auto mendAll = [this] (bool by_chains) {
      bool has_changed = false;
      for (Index p = 0; p < is_free.size () && work < most_work; ++p)
        if (isFlawed (p)) {
          has_changed = (by_chains ? mendByChain (p) : mendAt (p) > 0) || has_changed;
          chain.clear ();
        }
      return has_changed;
    };
    for (int round = 0; round < ROUNDS && (mendAll (false) || mendAll (true)); ++round)
      ;
  }

  static constexpr int ROUNDS = 50; // ends it where each change causes another one
  // Tetrahedra around points that may be looked at, for each point: at some 20 nanoseconds. A point
  // on many tetrahedra would take the cube of their number.
  static constexpr std::size_t WORK = 2000, LEAST_WORK = 2'000'000;
  // Moves; with 12, as many of 280 noisy bodies and sheets were right.
  static constexpr std::size_t LONGEST_CHAIN = 6;

  // Pieces of either side around a point, beyond one each; many if there is one side only.
  // \param pieces if not nullptr: the tetrahedra of each piece, where its side has several
  std::size_t flawsAt (Index p, std::vector<std::vector<Index>>* pieces = nullptr)
  {
    constexpr std::size_t ENCLOSED = 100;
    const Row around = all.around.row (p);
    work += around.size ();
    for (const Index t : around)
      is_reached[t] = 0;
    std::array<std::size_t, 2> count{};
    std::vector<std::vector<Index>> found;
    for (const Index start : around) {
      if (is_reached[start]++ != 0)
        continue;
      const std::uint8_t side = is_behind[start];
      reached.assign (1, start);
      for (std::size_t i = 0; i < reached.size (); ++i)
        for (unsigned k = 0; k < 4; ++k) {
          const Index t = reached[i], other = all.neighbors[t][k];
          if (all.corners[t][k] != p && is_behind[other] == side && is_reached[other]++ == 0)
            reached.push_back (other);
        }
      ++count[side];
      if (pieces != nullptr)
        found.push_back (reached);
    }
    if (pieces != nullptr)
      for (std::vector<Index>& piece : found)
        if (count[is_behind[piece.front ()]] > 1)
          pieces->push_back (std::move (piece));
    return count[0] > 0 && count[1] > 0 ? count[0] + count[1] - 2 : ENCLOSED;
  }

  // The same as long as no tetrahedron there is turned.
  std::size_t knownFlawsAt (Index p)
  {
    if (flaws[p] == NONE)
      flaws[p] = static_cast<Index> (flawsAt (p));
    return flaws[p];
  }

  bool isFlawed (Index p) { return is_free[p] != 0 && knownFlawsAt (p) > 0; }

  // Pieces around a point, and single tetrahedra, the best first; none that the chain has turned.
  // \param least flaws that each of them is to cure
  std::vector<RatedMove> movesAt (Index p, long least)
  {
    std::vector<Move> moves;
    flawsAt (p, &moves);
    for (const Index t : all.around.row (p))
      moves.push_back ({t});
    std::vector<RatedMove> rated;
    for (Move& move : moves) {
      if (work >= most_work)
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
    return all.isInfinite (t) || std::any_of (chain.begin (), chain.end (), [t] (const Move& move) {
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
        cost += is_behind[all.neighbors[t][k]] == is_behind[t] ? overlap[t][k] : -overlap[t][k];
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
      for (std::size_t link = 0; link < chain.size () && gain <= 0; ++link)
        for (const Index q : cornersOf (chain[link]))
          for (long more = 1;
               more > 0 && gain <= 0 && isFlawed (q) && chain.size () < LONGEST_CHAIN; gain += more)
            more = mendAt (q);
      if (gain > 0)
        return true;
      for (const Move& move : chain)
        turnForGood (move);
      chain.clear ();
    }
    return false;
  }

  long make (const RatedMove& rated)
  {
    turnForGood (rated.move);
    chain.push_back (rated.move);
    return rated.gain;
  }

  std::vector<Index> cornersOf (const Move& tetrahedra) const
  {
    std::vector<Index> points;
    for (const Index t : tetrahedra)
      for (const Index p : all.corners[t])
        if (p != NONE)
          points.push_back (p);
    sortUnique (points);
    return points;
  }

  void turnForGood (const Move& tetrahedra)
  {
    turn (tetrahedra);
    for (const Index p : cornersOf (tetrahedra))
      flaws[p] = NONE;
  }

  void turn (const Move& tetrahedra)
  {
    for (const Index t : tetrahedra)
      is_behind[t] ^= 1U;
  }
};

} // namespace pcl::floater
