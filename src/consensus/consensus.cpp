// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus.h"

#include "consensus/orientation.h"
#include "core/geometry.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace pcl::floater {
namespace {
// The sector that a triangle fills in the tangent plane of one of its corners: anti-clockwise from
// one of the other corners to the other, less than half a turn.
struct Sector
{
  Index first, last;        // the other corners
  Eigen::Vector2d from, to; // their directions

  bool contains (const Eigen::Vector2d& direction) const
  {
    return cross (from, direction) > 0.0 && cross (direction, to) > 0.0;
  }
};

// Adjacent sectors share a corner. It is compared by its index, since rounding could make its two
// directions different.
bool
overlap (const Sector& a, const Sector& b)
{
  if (a.first == b.first || a.last == b.last)
    return true;
  return (a.first != b.last && b.contains (a.from)) || (a.last != b.first && b.contains (a.to)) ||
         (b.first != a.last && a.contains (b.from)) || (b.last != a.first && a.contains (b.to));
}

// Accepts candidates one by one if they fit those accepted before.
class ConsensusBuilder
{
public:
  ConsensusBuilder (const std::vector<Eigen::Vector3d>& positions,
                    const std::vector<Eigen::Vector3f>& normals)
      : positions_ (positions), normals_ (normals), orientation_ (positions.size ()),
        last_sector_ (positions.size (), UNWATCHED)
  {
  }

  // Records sectors at these corners from now on, for later tests.
  void watch (const Triangle& corners)
  {
    for (Index p : corners)
      last_sector_[p] = NONE;
  }

  // Accepts a candidate if it fits. The sectors of one star do not overlap, so candidates of three
  // votes that are offered first need no test of sectors.
  bool offer (const SureTriangle& candidate)
  {
    if (!orientation_.join (candidate.corners, candidate.clockwise)) {
      seam_.push_back (candidate.corners);
      return false;
    }
    occupy (candidate.corners);
    return true;
  }

  void offer (const Candidate& candidate, bool test_sectors)
  {
    if (test_sectors && overlapsTaken (candidate.corners))
      return;
    if (!orientation_.join (candidate.corners, candidate.clockwise)) {
      if (candidate.votes == 3)
        seam_.push_back (candidate.corners);
      return;
    }
    occupy (candidate.corners);
    taken_.push_back (&candidate);
  }

  // The accepted doubtful candidates, ordered by their first corners.
  const std::vector<const Candidate*>& takenInOrder ()
  {
    std::stable_sort (taken_.begin (), taken_.end (), [] (const Candidate* a, const Candidate* b) {
      return a->corners[0] < b->corners[0];
    });
    return taken_;
  }

  Orientation& orientation () { return orientation_; }
  std::vector<Triangle>& seam () { return seam_; }

private:
  static constexpr Index UNWATCHED = NONE - 1;

  // The sector of an accepted triangle at a watched corner.
  struct TakenSector
  {
    Index q, r;   // the other corners
    Index before; // the sector accepted before it at this corner, or NONE
  };

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

  // True if a triangle overlaps an accepted one at one of its corners, which must be watched.
  bool overlapsTaken (const Triangle& corners) const
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

  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Eigen::Vector3f>& normals_;
  Orientation orientation_;
  std::vector<Index> last_sector_; // per point: latest sector, NONE, or UNWATCHED
  std::vector<TakenSector> sectors_;
  std::vector<const Candidate*> taken_;
  std::vector<Triangle> seam_;
};

// Sorts doubtful candidates. Those of three votes come first, by their class of normal agreement:
// the orientation then spreads along triangles that agree best, like a minimum spanning forest.
// \return number of candidates of three votes
std::size_t
putInOrder (std::vector<const Candidate*>& candidates)
{
  const auto fewer_votes = std::stable_partition (
      candidates.begin (), candidates.end (), [] (const Candidate* c) { return c->votes == 3; });
  std::stable_sort (candidates.begin (), fewer_votes, [] (const Candidate* a, const Candidate* b) {
    return normalAgreementRank (*a) < normalAgreementRank (*b);
  });
  std::sort (fewer_votes, candidates.end (), [] (const Candidate* a, const Candidate* b) {
    return std::tie (b->votes, b->normal_agreement, a->circumradius_ratio, a->corners) <
           std::tie (a->votes, a->normal_agreement, b->circumradius_ratio, b->corners);
  });
  return static_cast<std::size_t> (fewer_votes - candidates.begin ());
}

void
append (const Triangle& corners, std::uint8_t votes, Consensus& consensus)
{
  consensus.triangles.push_back (corners);
  consensus.votes.push_back (votes);
}

// Collects the accepted triangles, ordered by their first corners.
void
collect (ConsensusBuilder& builder, const CandidateLists& candidates, std::size_t sure_taken,
         Consensus& consensus, const RunContext& run)
{
  Orientation& orientation = builder.orientation ();
  const std::vector<const Candidate*>& doubtful = builder.takenInOrder ();
  consensus.triangles.reserve (sure_taken + doubtful.size ());
  consensus.votes.reserve (sure_taken + doubtful.size ());
  auto next = doubtful.begin ();
  const auto appendDoubtfulBefore = [&] (Index p) {
    for (; next != doubtful.end () && (*next)->corners[0] < p; ++next)
      append (orientation.turned ((*next)->corners, (*next)->clockwise), (*next)->votes, consensus);
  };
  const std::vector<SureTriangle>& sure = candidates.sure;
  ProgressLoop progress (run);
  for (std::size_t i = 0, end = 0; i < sure.size (); i = end) {
    progress.next ();
    const Index p = sure[i].corners[0];
    appendDoubtfulBefore (p);
    while (end < sure.size () && sure[end].corners[0] == p)
      ++end;
    for (std::uint8_t rank = 0; rank < candidates.sure_ranks; ++rank)
      for (std::size_t j = i; j < end; ++j)
        if (sure[j].rank == rank && sure[j].is_taken)
          append (orientation.turned (sure[j].corners, sure[j].clockwise), 3, consensus);
  }
  appendDoubtfulBefore (NONE);
  consensus.seam.swap (builder.seam ());
}

} // namespace

Consensus
buildConsensus (const std::vector<Eigen::Vector3d>& positions, CandidateLists& candidates,
                std::vector<Eigen::Vector3f>& normals, const RunContext& run)
{
  std::vector<const Candidate*> doubtful;
  doubtful.reserve (candidates.doubtful.size ());
  for (const Candidate& candidate : candidates.doubtful)
    doubtful.push_back (&candidate);
  run.poll ();
  const std::size_t of_three_votes = putInOrder (doubtful);
  run.poll ();

  ConsensusBuilder builder (positions, normals);
  for (std::size_t i = of_three_votes; i < doubtful.size (); ++i)
    builder.watch (doubtful[i]->corners);
  std::size_t sure_taken = 0;
  const std::uint8_t sure_ranks = candidates.sure_ranks;
  ProgressLoop progress (run, sure_ranks * candidates.sure.size () + doubtful.size ());
  for (std::uint8_t rank = 0; rank < sure_ranks; ++rank)
    for (SureTriangle& sure : candidates.sure) {
      progress.next ();
      if (sure.rank == rank) {
        sure.is_taken = builder.offer (sure);
        sure_taken += sure.is_taken ? 1 : 0;
      }
    }
  builder.orientation ().vote (doubtful.data (), doubtful.data () + of_three_votes, run);
  for (std::size_t i = 0; i < doubtful.size (); ++i) {
    progress.next ();
    builder.offer (*doubtful[i], i >= of_three_votes);
  }

  Consensus consensus;
  collect (builder, candidates, sure_taken, consensus, run);
  builder.orientation ().turn (normals, run);
  return consensus;
}

} // namespace pcl::floater
