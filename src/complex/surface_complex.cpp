// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/surface_complex.h"

#include "complex/signed_sets.h"
#include "neighborhoods/tangent_frame.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <tuple>
#include <unordered_set>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t CLASSES = 32;      // of agreement
constexpr float SURE_AGREEMENT = 0.875F; // a triangle that alone tells how normals are oriented

double
cross (const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x () * b.y () - a.y () * b.x ();
}

// The sector of a triangle at one of its corners, less than half a turn, anti-clockwise in the
// corner's tangent plane.
struct Sector
{
  Index first, last;
  Eigen::Vector2d from, to;

  bool holds (const Eigen::Vector2d& direction) const
  {
    return cross (from, direction) > 0.0 && cross (direction, to) > 0.0;
  }
};

// Neighbouring sectors share a neighbour, which rounding must not tell apart.
bool
overlap (const Sector& a, const Sector& b)
{
  if (a.first == b.first || a.last == b.last)
    return true;
  return (a.first != b.last && b.holds (a.from)) || (a.last != b.first && b.holds (a.to)) ||
         (b.first != a.last && a.holds (b.from)) || (b.last != a.first && a.holds (b.to));
}

class ComplexBuilder
{
public:
  ComplexBuilder (const std::vector<Eigen::Vector3d>& positions,
                  const std::vector<Eigen::Vector3f>& normals, std::size_t most)
      : positions_ (positions), normals_ (normals), sides_ (positions.size ()),
        first_corner_ (positions.size (), NONE)
  {
    complex_.triangles.reserve (most);
    complex_.votes.reserve (most);
    next_corner_.reserve (3 * most);
  }

  // Takes a candidate if it fits. Sectors of one star do not overlap: candidates of three votes,
  // offered first to an empty complex, need no test.
  void offer (const Candidate& candidate, bool test_sectors)
  {
    if (test_sectors && isTaken (candidate.corners))
      return;
    if (!isOriented (candidate)) {
      if (candidate.votes == 3)
        complex_.misfits.push_back (candidate.corners);
      return;
    }
    take (candidate.corners, candidate.votes);
  }

  // Takes the triangles of a mesh, oriented like the normals.
  void start (const SurfaceMesh& mesh)
  {
    for (const Triangle& corners : mesh.triangles) {
      take (corners, 3);
      sides_.join (corners[0], corners[1], false);
      sides_.join (corners[0], corners[2], false);
    }
  }

  // Joins sets of points whose normals have no common side yet, by all candidates between them
  // together: a single triangle across a crease or between sheets may be wrong. In rounds, as in
  // Boruvka's forest: every set joins the one that most votes tie it to.
  void orientSets (const std::vector<Candidate>& candidates, const Index* first, const Index* last)
  {
    std::vector<Ballot> ballots;
    do {
      ballots.clear ();
      for (const Index* i = first; i != last; ++i)
        cast (candidates[*i], ballots);
      count (ballots);
      std::stable_sort (ballots.begin (), ballots.end (), [] (const Ballot& a, const Ballot& b) {
        return std::abs (a.votes) > std::abs (b.votes);
      });
      std::unordered_set<Index> joined;
      for (const Ballot& ballot : ballots) {
        const bool first_seen = joined.insert (ballot.a).second;
        const bool second_seen = joined.insert (ballot.b).second;
        if (first_seen || second_seen)
          sides_.join (ballot.a, ballot.b, ballot.votes < 0);
      }
    } while (!ballots.empty ());
  }

  // Turns all triangles to the side of their component.
  SurfaceComplex finish (std::vector<Eigen::Vector3f>& normals)
  {
    for (Triangle& corners : complex_.triangles)
      if (runsClockwise (corners, 0) != sides_.find (corners[0]).flipped)
        std::swap (corners[1], corners[2]);
    for (Index p = 0; p < normals.size (); ++p)
      if (sides_.find (p).flipped)
        normals[p] = -normals[p];
    std::vector<Index> ().swap (first_corner_);
    std::vector<Index> ().swap (next_corner_);
    return inOrderOfPoints ();
  }

private:
  // The triangles by their first corners, so that near triangles are near in memory.
  SurfaceComplex inOrderOfPoints () const
  {
    std::vector<Index> at (positions_.size () + 1, 0);
    for (const Triangle& corners : complex_.triangles)
      ++at[corners[0] + 1];
    std::partial_sum (at.begin (), at.end (), at.begin ());
    SurfaceComplex sorted;
    sorted.triangles.resize (complex_.triangles.size ());
    sorted.votes.resize (complex_.triangles.size ());
    sorted.misfits = complex_.misfits;
    for (std::size_t t = 0; t < complex_.triangles.size (); ++t) {
      const Index place = at[complex_.triangles[t][0]]++;
      sorted.triangles[place] = complex_.triangles[t];
      sorted.votes[place] = complex_.votes[t];
    }
    return sorted;
  }

  // Votes on two sets of points, by their representatives: for the same side, minus for the other.
  struct Ballot
  {
    Index a, b;
    int votes;
  };

  // The votes of one candidate on the sets of its corners.
  void cast (const Candidate& candidate, std::vector<Ballot>& ballots)
  {
    for (std::uint8_t i = 0; i < 3; ++i) {
      const auto j = static_cast<std::uint8_t> ((i + 1U) % 3U);
      const SignedSets::Place a = sides_.find (candidate.corners[i]),
                              b = sides_.find (candidate.corners[j]);
      if (a.root == b.root)
        continue;
      const bool opposite = (runsClockwise (candidate.corners, i) !=
                             runsClockwise (candidate.corners, j)) != (a.flipped != b.flipped);
      ballots.push_back ({std::min (a.root, b.root), std::max (a.root, b.root),
                          opposite ? -candidate.votes : candidate.votes});
    }
  }

  // Adds up the votes on each pair.
  static void count (std::vector<Ballot>& ballots)
  {
    std::stable_sort (ballots.begin (), ballots.end (), [] (const Ballot& a, const Ballot& b) {
      return std::tie (a.a, a.b) < std::tie (b.a, b.b);
    });
    std::size_t pairs = 0;
    for (const Ballot& ballot : ballots) {
      if (pairs > 0 && ballots[pairs - 1].a == ballot.a && ballots[pairs - 1].b == ballot.b)
        ballots[pairs - 1].votes += ballot.votes;
      else
        ballots[pairs++] = ballot;
    }
    ballots.resize (pairs);
  }

  void take (const Triangle& corners, std::uint8_t votes)
  {
    const auto t = static_cast<Index> (complex_.triangles.size ());
    complex_.triangles.push_back (corners);
    complex_.votes.push_back (votes);
    for (std::uint8_t i = 0; i < 3; ++i) {
      next_corner_.push_back (first_corner_[corners[i]]);
      first_corner_[corners[i]] = 3 * t + i;
    }
  }

  Sector sector (const Triangle& corners, std::uint8_t i) const
  {
    const Index p = corners[i], q = corners[(i + 1U) % 3U], r = corners[(i + 2U) % 3U];
    const TangentFrame frame (normals_[p].cast<double> ());
    Sector sector{q, r, frame.project (positions_[q] - positions_[p]),
                  frame.project (positions_[r] - positions_[p])};
    if (cross (sector.from, sector.to) < 0.0) {
      std::swap (sector.first, sector.last);
      std::swap (sector.from, sector.to);
    }
    return sector;
  }

  // True if a triangle taken overlaps another at one of its corners.
  bool isTaken (const Triangle& corners) const
  {
    for (std::uint8_t i = 0; i < 3; ++i) {
      const Sector wanted = sector (corners, i);
      for (Index c = first_corner_[corners[i]]; c != NONE; c = next_corner_[c])
        if (overlap (wanted, sector (complex_.triangles[c / 3], static_cast<std::uint8_t> (c % 3))))
          return true;
    }
    return false;
  }

  bool runsClockwise (const Triangle& corners, std::uint8_t i) const
  {
    const Index p = corners[i], q = corners[(i + 1U) % 3U], r = corners[(i + 2U) % 3U];
    const Eigen::Vector3d normal =
        (positions_[q] - positions_[p]).cross (positions_[r] - positions_[p]);
    return normal.dot (normals_[p].cast<double> ()) < 0.0;
  }

  // True if the candidate fits the sides told by the triangles taken, which it then joins.
  bool isOriented (const Candidate& candidate)
  {
    const Triangle& corners = candidate.corners;
    const bool a = runsClockwise (corners, 0), b = runsClockwise (corners, 1),
               c = runsClockwise (corners, 2);
    const SignedSets::Place at_a = sides_.find (corners[0]), at_b = sides_.find (corners[1]),
                            at_c = sides_.find (corners[2]);
    const auto contradicts = [] (const SignedSets::Place& p, const SignedSets::Place& q,
                                 bool opposite) {
      return p.root == q.root && (p.flipped != q.flipped) != opposite;
    };
    if (contradicts (at_a, at_b, a != b) || contradicts (at_a, at_c, a != c) ||
        contradicts (at_b, at_c, b != c))
      return false;
    sides_.join (corners[0], corners[1], a != b);
    sides_.join (corners[0], corners[2], a != c);
    return true;
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Eigen::Vector3f>& normals_;
  SignedSets sides_;                // of the points' normals
  std::vector<Index> first_corner_; // per point: 3 t + i of its last triangle taken
  std::vector<Index> next_corner_;  // per 3 t + i: the one taken before it at the same point
  SurfaceComplex complex_;
};

// The order in which candidates are offered. The trees of normals grow along triangles that agree
// best, like a spanning forest of least cost; that takes classes of agreement, no full order, for
// the many candidates of three votes.
std::vector<Index>
inOrder (const std::vector<Candidate>& candidates)
{
  std::array<std::size_t, CLASSES + 2> begin{};
  const auto classOf = [] (const Candidate& candidate) {
    if (candidate.votes < 3)
      return CLASSES;
    const auto steps = static_cast<std::size_t> ((1.0F - candidate.agreement) * CLASSES);
    return std::min (steps, CLASSES - 1);
  };
  for (const Candidate& candidate : candidates)
    ++begin[classOf (candidate) + 1];
  std::partial_sum (begin.begin (), begin.end (), begin.begin ());
  std::vector<Index> order (candidates.size ());
  for (Index i = 0; i < candidates.size (); ++i)
    order[begin[classOf (candidates[i])]++] = i;
  const std::size_t doubtful = begin[CLASSES - 1];
  std::sort (order.begin () + static_cast<std::ptrdiff_t> (doubtful), order.end (),
             [&candidates] (Index i, Index j) {
               const Candidate &a = candidates[i], &b = candidates[j];
               return std::tie (b.votes, b.agreement, a.size, a.corners) <
                      std::tie (a.votes, a.agreement, b.size, b.corners);
             });
  return order;
}

} // namespace

SurfaceComplex
buildComplex (const std::vector<Eigen::Vector3d>& positions,
              const std::vector<Candidate>& candidates, std::vector<Eigen::Vector3f>& normals)
{
  const std::vector<Index> order = inOrder (candidates);
  const auto firstWhere = [&] (auto&& predicate) {
    return static_cast<std::size_t> (
        std::find_if (order.begin (), order.end (),
                      [&] (Index i) { return predicate (candidates[i]); }) -
        order.begin ());
  };
  const std::size_t sure =
      firstWhere ([] (const Candidate& c) { return c.votes < 3 || c.agreement < SURE_AGREEMENT; });
  const std::size_t doubtful = firstWhere ([] (const Candidate& c) { return c.votes < 3; });
  ComplexBuilder builder (positions, normals, candidates.size ());
  for (std::size_t i = 0; i < sure; ++i)
    builder.offer (candidates[order[i]], false);
  builder.orientSets (candidates, order.data () + sure, order.data () + doubtful);
  for (std::size_t i = sure; i < order.size (); ++i)
    builder.offer (candidates[order[i]], i >= doubtful);
  return builder.finish (normals);
}

SurfaceComplex
extendComplex (const std::vector<Eigen::Vector3d>& positions,
               const std::vector<Candidate>& candidates, const SurfaceMesh& mesh,
               std::vector<Eigen::Vector3f>& normals)
{
  // Only at the rims, and at points without triangles, is there room.
  std::vector<std::uint8_t> has_room (positions.size (), 0);
  for (Index p = 0; p < positions.size (); ++p)
    has_room[p] = mesh.triangle_of[p] == NONE ? 1 : 0;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE)
        has_room[mesh.from ({t, side})] = has_room[mesh.to ({t, side})] = 1;
  std::vector<Candidate> open;
  std::copy_if (candidates.begin (), candidates.end (), std::back_inserter (open),
                [&has_room] (const Candidate& candidate) {
                  const auto& [a, b, c] = candidate.corners;
                  return has_room[a] != 0 && has_room[b] != 0 && has_room[c] != 0;
                });
  const std::vector<Index> order = inOrder (open);
  ComplexBuilder builder (positions, normals, mesh.triangles.size () + open.size ());
  builder.start (mesh);
  builder.orientSets (open, order.data (), order.data () + order.size ());
  for (Index i : order)
    builder.offer (open[i], true);
  return builder.finish (normals);
}

} // namespace floater
} // namespace pcl
