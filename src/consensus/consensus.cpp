// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus.h"

#include "core/disjoint_sets.h"
#include "core/geometry.h"
#include "core/tangent_frame.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
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

bool
runsClockwise (std::uint8_t clockwise, std::size_t corner)
{
  return ((clockwise >> corner) & 1U) != 0;
}

class ConsensusBuilder
{
public:
  ConsensusBuilder (const std::vector<Eigen::Vector3d>& positions,
                    const std::vector<Eigen::Vector3f>& normals)
      : positions_ (positions), normals_ (normals), sides_ (positions.size ()),
        last_sector_ (positions.size (), UNWATCHED)
  {
  }

  // Remembers the sectors around these corners from now on: where one is to be tested.
  void watch (const Triangle& corners)
  {
    for (Index p : corners)
      last_sector_[p] = NONE;
  }

  // Takes a candidate if it fits. Sectors of one star do not overlap: candidates of three votes,
  // offered first to an empty consensus, need no test.
  bool offer (const SureTriangle& candidate)
  {
    if (!isOriented (candidate.corners, candidate.clockwise)) {
      seam_.push_back (candidate.corners);
      return false;
    }
    occupy (candidate.corners);
    return true;
  }

  void offer (const Candidate& candidate, bool test_sectors)
  {
    if (test_sectors && isTaken (candidate.corners))
      return;
    if (!isOriented (candidate.corners, candidate.clockwise)) {
      if (candidate.votes == 3)
        seam_.push_back (candidate.corners);
      return;
    }
    occupy (candidate.corners);
    taken_.push_back (&candidate);
  }

  // Takes a triangle that is oriented like the normals.
  void start (const Triangle& corners)
  {
    occupy (corners);
    sides_.join (corners[0], corners[1], false);
    sides_.join (corners[0], corners[2], false);
  }

  // Joins sets of points whose normals have no common side yet, by all candidates between them
  // together: a single triangle across a crease or between sheets may be wrong. In rounds, as in
  // Boruvka's forest: every set joins the one that most votes tie it to.
  void orientSets (const Candidate* const* first, const Candidate* const* last)
  {
    std::vector<OrientationVote> ballots;
    do {
      ballots.clear ();
      for (const Candidate* const* candidate = first; candidate != last; ++candidate)
        cast (**candidate, ballots);
      count (ballots);
      std::stable_sort (ballots.begin (), ballots.end (),
                        [] (const OrientationVote& a, const OrientationVote& b) {
                          return std::abs (a.votes) > std::abs (b.votes);
                        });
      std::unordered_set<Index> joined;
      for (const OrientationVote& ballot : ballots) {
        const bool first_seen = joined.insert (ballot.a).second;
        const bool second_seen = joined.insert (ballot.b).second;
        if (first_seen || second_seen)
          sides_.join (ballot.a, ballot.b, ballot.votes < 0);
      }
    } while (!ballots.empty ());
  }

  // Candidates taken, but for the sure ones, by their first corners.
  const std::vector<const Candidate*>& takenInOrder ()
  {
    std::stable_sort (taken_.begin (), taken_.end (), [] (const Candidate* a, const Candidate* b) {
      return a->corners[0] < b->corners[0];
    });
    return taken_;
  }

  // Turned to the side of its component.
  Triangle turned (Triangle corners, std::uint8_t clockwise)
  {
    if (runsClockwise (clockwise, 0) != sides_.find (corners[0]).flipped)
      std::swap (corners[1], corners[2]);
    return corners;
  }

  void turn (std::vector<Eigen::Vector3f>& normals)
  {
    for (Index p = 0; p < normals.size (); ++p)
      if (sides_.find (p).flipped)
        normals[p] = -normals[p];
  }

  std::vector<Triangle>& seam () { return seam_; }

private:
  static constexpr Index UNWATCHED = NONE - 1;

  // Votes on two sets of points, by their representatives: for the same side, minus for the other.
  struct OrientationVote
  {
    Index a, b;
    int votes;
  };

  // A triangle taken, at a corner that is watched.
  struct TakenSector
  {
    Index q, r;   // its other corners
    Index before; // the one taken before it at the same corner
  };

  // The votes of one candidate on the sets of its corners.
  void cast (const Candidate& candidate, std::vector<OrientationVote>& ballots)
  {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1U) % 3U;
      const SignedSets::Place a = sides_.find (candidate.corners[i]),
                              b = sides_.find (candidate.corners[j]);
      if (a.root == b.root)
        continue;
      const bool opposite = (runsClockwise (candidate.clockwise, i) !=
                             runsClockwise (candidate.clockwise, j)) != (a.flipped != b.flipped);
      ballots.push_back ({std::min (a.root, b.root), std::max (a.root, b.root),
                          opposite ? -candidate.votes : candidate.votes});
    }
  }

  // Adds up the votes on each pair.
  static void count (std::vector<OrientationVote>& ballots)
  {
    std::stable_sort (ballots.begin (), ballots.end (),
                      [] (const OrientationVote& a, const OrientationVote& b) {
                        return std::tie (a.a, a.b) < std::tie (b.a, b.b);
                      });
    std::size_t pairs = 0;
    for (const OrientationVote& ballot : ballots) {
      if (pairs > 0 && ballots[pairs - 1].a == ballot.a && ballots[pairs - 1].b == ballot.b)
        ballots[pairs - 1].votes += ballot.votes;
      else
        ballots[pairs++] = ballot;
    }
    ballots.resize (pairs);
  }

  void occupy (const Triangle& corners)
  {
    for (std::size_t i = 0; i < 3; ++i) {
      Index& last = last_sector_[corners[i]];
      if (last == UNWATCHED)
        continue;
      sectors_.push_back ({corners[(i + 1) % 3], corners[(i + 2) % 3], last});
      last = static_cast<Index> (sectors_.size () - 1);
    }
  }

  Sector sector (Index p, Index q, Index r) const
  {
    const TangentFrame frame (normals_[p].cast<double> ());
    Sector sector{q, r, frame.project (positions_[q] - positions_[p]),
                  frame.project (positions_[r] - positions_[p])};
    if (cross (sector.from, sector.to) < 0.0) {
      std::swap (sector.first, sector.last);
      std::swap (sector.from, sector.to);
    }
    return sector;
  }

  // True if a triangle taken overlaps another at one of its corners, which are watched.
  bool isTaken (const Triangle& corners) const
  {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = corners[i];
      const Sector wanted = sector (p, corners[(i + 1) % 3], corners[(i + 2) % 3]);
      for (Index s = last_sector_[p]; s != NONE; s = sectors_[s].before)
        if (overlap (wanted, sector (p, sectors_[s].q, sectors_[s].r)))
          return true;
    }
    return false;
  }

  // True if a triangle fits the sides told by the triangles taken, which it then joins.
  bool isOriented (const Triangle& corners, std::uint8_t clockwise)
  {
    const bool a = runsClockwise (clockwise, 0), b = runsClockwise (clockwise, 1),
               c = runsClockwise (clockwise, 2);
    const SignedSets::Place at_a = sides_.find (corners[0]), at_b = sides_.find (corners[1]),
                            at_c = sides_.find (corners[2]);
    const auto contradicts = [] (const SignedSets::Place& p, const SignedSets::Place& q,
                                 bool opposite) {
      return p.root == q.root && (p.flipped != q.flipped) != opposite;
    };
    if (contradicts (at_a, at_b, a != b) || contradicts (at_a, at_c, a != c) ||
        contradicts (at_b, at_c, b != c))
      return false;
    if (at_a.root != at_b.root)
      sides_.join (corners[0], corners[1], a != b);
    if (at_a.root != at_c.root)
      sides_.join (corners[0], corners[2], a != c);
    return true;
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Eigen::Vector3f>& normals_;
  SignedSets sides_;               // of the points' normals
  std::vector<Index> last_sector_; // per point: of the sectors taken there; NONE, UNWATCHED
  std::vector<TakenSector> sectors_;
  std::vector<const Candidate*> taken_;
  std::vector<Triangle> seam_;
};

// The order in which doubtful candidates are offered. The trees of normals grow along triangles
// that agree best, like a spanning forest of least cost; that takes classes of agreement, no full
// order, for the candidates of three votes. These come first.
// \return how many have three votes
std::size_t
putInOrder (std::vector<const Candidate*>& candidates)
{
  const auto few = std::stable_partition (candidates.begin (), candidates.end (),
                                          [] (const Candidate* c) { return c->votes == 3; });
  std::stable_sort (candidates.begin (), few, [] (const Candidate* a, const Candidate* b) {
    return normalAgreementRank (*a) < normalAgreementRank (*b);
  });
  std::sort (few, candidates.end (), [] (const Candidate* a, const Candidate* b) {
    return std::tie (b->votes, b->normal_agreement, a->circumradius_ratio, a->corners) <
           std::tie (a->votes, a->normal_agreement, b->circumradius_ratio, b->corners);
  });
  return static_cast<std::size_t> (few - candidates.begin ());
}

// Appends triangles with votes.
void
append (const Triangle& corners, std::uint8_t votes, Consensus& consensus)
{
  consensus.triangles.push_back (corners);
  consensus.votes.push_back (votes);
}

// The sure and the doubtful triangles taken, by their first corners.
void
collect (ConsensusBuilder& builder, const CandidateLists& candidates, std::size_t sure_taken,
         Consensus& consensus)
{
  const std::vector<const Candidate*>& doubtful = builder.takenInOrder ();
  consensus.triangles.reserve (sure_taken + doubtful.size ());
  consensus.votes.reserve (sure_taken + doubtful.size ());
  auto next = doubtful.begin ();
  const auto appendDoubtfulBefore = [&] (Index p) {
    for (; next != doubtful.end () && (*next)->corners[0] < p; ++next)
      append (builder.turned ((*next)->corners, (*next)->clockwise), (*next)->votes, consensus);
  };
  const std::vector<SureTriangle>& sure = candidates.sure;
  for (std::size_t i = 0, end = 0; i < sure.size (); i = end) {
    const Index p = sure[i].corners[0];
    appendDoubtfulBefore (p);
    while (end < sure.size () && sure[end].corners[0] == p)
      ++end;
    for (std::uint8_t rank = 0; rank < SURE_RANKS; ++rank)
      for (std::size_t j = i; j < end; ++j)
        if (sure[j].rank == rank && sure[j].is_taken)
          append (builder.turned (sure[j].corners, sure[j].clockwise), 3, consensus);
  }
  appendDoubtfulBefore (NONE);
  consensus.seam.swap (builder.seam ());
}

// Tells which candidates have all their corners at the rims of a mesh, or at points without
// triangles: elsewhere there is no room.
class Room
{
public:
  explicit Room (const TriangleMesh& mesh) : has_room_ (mesh.triangle_of.size (), 0)
  {
    for (Index p = 0; p < has_room_.size (); ++p)
      has_room_[p] = mesh.triangle_of[p] == NONE ? 1 : 0;
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (mesh.neighbors[t][side] == NONE)
          has_room_[mesh.from ({t, side})] = has_room_[mesh.to ({t, side})] = 1;
  }

  bool isAt (const Triangle& corners) const
  {
    return has_room_[corners[0]] != 0 && has_room_[corners[1]] != 0 && has_room_[corners[2]] != 0;
  }

private:
  std::vector<std::uint8_t> has_room_;
};

// Candidates where there is room, as they are oriented now; what is sure counts as doubtful here.
std::vector<Candidate>
findOpen (const std::vector<Eigen::Vector3d>& positions, const CandidateLists& candidates,
          const TriangleMesh& mesh, const std::vector<Eigen::Vector3f>& normals)
{
  const Room room (mesh);
  std::vector<Candidate> open;
  for (const SureTriangle& sure : candidates.sure)
    if (room.isAt (sure.corners))
      open.push_back ({sure.corners, 3, 0, 0.0F, 0.0F});
  for (const Candidate& doubtful : candidates.doubtful)
    if (room.isAt (doubtful.corners))
      open.push_back (doubtful);
  for (Candidate& candidate : open)
    setNormalAgreement (positions, normals, candidate);
  std::stable_sort (open.begin (), open.end (), [] (const Candidate& a, const Candidate& b) {
    return a.corners[0] < b.corners[0];
  });
  return open;
}

std::vector<const Candidate*>
pointersTo (const std::vector<Candidate>& candidates)
{
  std::vector<const Candidate*> pointers;
  pointers.reserve (candidates.size ());
  for (const Candidate& candidate : candidates)
    pointers.push_back (&candidate);
  return pointers;
}

} // namespace

Consensus
buildConsensus (const std::vector<Eigen::Vector3d>& positions, CandidateLists& candidates,
                std::vector<Eigen::Vector3f>& normals, const RunContext& run)
{
  std::vector<const Candidate*> doubtful = pointersTo (candidates.doubtful);
  const std::size_t of_three_votes = putInOrder (doubtful);

  ConsensusBuilder builder (positions, normals);
  for (std::size_t i = of_three_votes; i < doubtful.size (); ++i)
    builder.watch (doubtful[i]->corners);
  std::size_t sure_taken = 0;
  ProgressLoop progress (run, SURE_RANKS * candidates.sure.size () + doubtful.size ());
  for (std::uint8_t rank = 0; rank < SURE_RANKS; ++rank)
    for (SureTriangle& sure : candidates.sure) {
      progress.next ();
      if (sure.rank == rank) {
        sure.is_taken = builder.offer (sure);
        sure_taken += sure.is_taken ? 1 : 0;
      }
    }
  builder.orientSets (doubtful.data (), doubtful.data () + of_three_votes);
  for (std::size_t i = 0; i < doubtful.size (); ++i) {
    progress.next ();
    builder.offer (*doubtful[i], i >= of_three_votes);
  }

  Consensus consensus;
  collect (builder, candidates, sure_taken, consensus);
  builder.turn (normals);
  return consensus;
}

bool
extendConsensus (const std::vector<Eigen::Vector3d>& positions, const CandidateLists& candidates,
                 const TriangleMesh& mesh, std::vector<Eigen::Vector3f>& normals,
                 Consensus& consensus, const RunContext& run)
{
  const std::vector<Candidate> open = findOpen (positions, candidates, mesh, normals);
  if (open.empty ())
    return false;
  std::vector<const Candidate*> order = pointersTo (open);
  putInOrder (order);
  ConsensusBuilder builder (positions, normals);
  for (const Candidate* candidate : order)
    builder.watch (candidate->corners);
  for (const Triangle& corners : mesh.triangles)
    builder.start (corners);
  builder.orientSets (order.data (), order.data () + order.size ());
  ProgressLoop progress (run, order.size ());
  for (const Candidate* candidate : order) {
    progress.next ();
    builder.offer (*candidate, true);
  }

  const std::vector<const Candidate*>& taken = builder.takenInOrder ();
  consensus.triangles.reserve (mesh.triangles.size () + taken.size ());
  consensus.votes.reserve (mesh.triangles.size () + taken.size ());
  auto next = taken.begin ();
  const auto appendTakenBefore = [&] (Index p) {
    for (; next != taken.end () && (*next)->corners[0] < p; ++next)
      append (builder.turned ((*next)->corners, (*next)->clockwise), (*next)->votes, consensus);
  };
  for (const Triangle& corners : mesh.triangles) {
    appendTakenBefore (corners[0]);
    append (builder.turned (corners, 0), 3, consensus);
  }
  appendTakenBefore (NONE);
  consensus.seam.swap (builder.seam ());
  builder.turn (normals);
  return true;
}

} // namespace floater
} // namespace pcl
