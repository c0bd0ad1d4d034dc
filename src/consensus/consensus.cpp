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
  // \return whether it is accepted
  bool offer (const Candidate& candidate, bool test_sectors)
  {
    if (test_sectors && overlapsTaken (candidate.corners))
      return false;
    const bool fits = orientation_.join (candidate.corners, candidate.clockwise);
    if (fits)
      occupy (candidate.corners);
    else if (candidate.votes == 3)
      seam_.push_back (candidate.corners);
    return fits;
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
  std::vector<Triangle> seam_;
};

// Sorts doubtful candidates. Those of three votes come first, by their class of normal agreement:
// the orientation then spreads along triangles that agree best, like a minimum spanning forest.
// \return number of candidates of three votes
std::size_t
putInOrder (std::vector<Candidate*>& candidates)
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

} // namespace

Consensus
buildConsensus (const std::vector<Eigen::Vector3d>& positions, std::vector<Candidate> candidates,
                const CandidateLimits& limits, std::vector<Eigen::Vector3f>& normals,
                const RunContext& run)
{
  std::vector<Candidate*> doubtful;
  for (Candidate& candidate : candidates)
    if (!isSure (candidate, limits))
      doubtful.push_back (&candidate);
  run.poll ();
  const std::size_t of_three_votes = putInOrder (doubtful);
  run.poll ();

  ConsensusBuilder builder (positions, normals);
  for (std::size_t i = of_three_votes; i < doubtful.size (); ++i)
    builder.watch (doubtful[i]->corners);
  std::size_t taken = 0;
  const auto offer = [&] (Candidate& candidate, bool test_sectors) {
    candidate.is_taken = builder.offer (candidate, test_sectors);
    taken += candidate.is_taken ? 1 : 0;
  };
  ProgressLoop progress (run, limits.sure_ranks * candidates.size () + doubtful.size ());
  for (std::size_t rank = 0; rank < limits.sure_ranks; ++rank)
    for (Candidate& candidate : candidates) {
      progress.next ();
      if (candidate.votes == 3 && normalAgreementRank (candidate) == rank)
        offer (candidate, false);
    }
  builder.orientation ().vote (doubtful.data (), doubtful.data () + of_three_votes, run);
  for (std::size_t i = 0; i < doubtful.size (); ++i) {
    progress.next ();
    offer (*doubtful[i], i >= of_three_votes);
  }

  std::stable_sort (
      doubtful.begin (), doubtful.end (),
      [] (const Candidate* a, const Candidate* b) { return a->corners[0] < b->corners[0]; });
  Consensus consensus;
  consensus.triangles.reserve (taken);
  consensus.votes.reserve (taken);
  const auto append = [&] (const Candidate& candidate) {
    if (!candidate.is_taken)
      return;
    consensus.triangles.push_back (
        builder.orientation ().turned (candidate.corners, candidate.clockwise));
    consensus.votes.push_back (candidate.votes);
  };
  auto next = doubtful.begin ();
  for (auto first = candidates.begin (), last = first; first != candidates.end (); first = last) {
    const Index p = first->corners[0];
    last = std::find_if (first, candidates.end (),
                         [p] (const Candidate& candidate) { return candidate.corners[0] != p; });
    for (std::size_t rank = 0; rank < limits.sure_ranks; ++rank)
      for (auto candidate = first; candidate != last; ++candidate)
        if (candidate->votes == 3 && normalAgreementRank (*candidate) == rank)
          append (*candidate);
    for (; next != doubtful.end () && (*next)->corners[0] == p; ++next)
      append (**next);
  }
  consensus.seam = std::move (builder.seam ());
  builder.orientation ().turn (normals, run);
  return consensus;
}

} // namespace pcl::floater
