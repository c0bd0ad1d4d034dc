// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus.h"

#include "core/parallel.h"

#include <cstdlib>
#include <map>
#include <unordered_set>

namespace pcl::floater {
namespace {
// Thresholds of candidates of 1, 2 and 3 votes, chosen by hand: largest circumradius over spacing, and
// smallest normal agreement. Without the circumradii, 545 clouds have a fifth more pairs of crossing
// triangles. Without the normal agreement they have as many: an airborne scan of trees has a sixth
// more, branches of few points less than half.
constexpr std::array<float, 3> LARGEST_CIRCUMRADIUS{2.0F, 2.0F, 3.0F};
constexpr std::array<float, 3> LEAST_AGREEMENT{0.4F, 0.2F, 0.1F};

// Number of classes of normal agreement, evenly spaced in the cosine from 1 to 0.
constexpr std::size_t AGREEMENT_RANKS = 32;

// Classes in which a candidate of three votes is sure, as most triangles are: it enters the consensus
// unless it contradicts the orientation. Cosines above 0.875.
constexpr std::size_t SURE_RANKS = 4;

// Sets the normal agreement and `clockwise` of a new candidate from the corners.
void
setNormalAgreement (const Positions& positions, const Normals& normals, Candidate& candidate)
{
  const auto& [a, b, c] = candidate.corners;
  const Vector3d normal = areaVector (positions[a], positions[b], positions[c]);
  const Vector3f unit = (normal / normal.norm ()).cast<float> ();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3f& at_corner = normals[candidate.corners[i]];
    candidate.normal_agreement =
        std::min (candidate.normal_agreement, std::abs (unit.dot (at_corner)));
    if (normal.dot (at_corner.cast<double> ()) < 0.0)
      candidate.clockwise = static_cast<std::uint8_t> (candidate.clockwise | (1U << i));
  }
}

// The sector that a triangle fills in the tangent plane of one of its corners: anti-clockwise from
// one of the other corners to the other, less than half a turn.
struct Sector
{
  Index first, last; // the other corners
  Vector2d from, to; // their directions

  bool contains (const Vector2d& direction) const
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
struct ConsensusBuilder
{
  static constexpr Index UNWATCHED = NONE - 1;

  // The sector of an accepted triangle at a watched corner.
  struct TakenSector
  {
    Index q, r;   // the other corners
    Index before; // the sector accepted before it at this corner, or NONE
  };

  const Positions& positions;
  const Normals& normals;
  Orientation orientation = Orientation (positions.size ());
  std::vector<Triangle> seam = {}; // see Consensus
  // Per point: latest sector, NONE, or UNWATCHED: there, sectors are not recorded.
  std::vector<Index> last_sector = std::vector<Index> (positions.size (), UNWATCHED);
  std::vector<TakenSector> sectors = {};

  // Accepts a candidate if it fits. The sectors of one star do not overlap, so candidates of three
  // votes that are offered first need no test of sectors.
  // \return whether it is accepted
  bool offer (const Candidate& candidate, bool test_sectors)
  {
    if (test_sectors && overlapsTaken (candidate.corners))
      return false;
    const bool fits = orientation.join (candidate.corners, candidate.clockwise);
    if (fits)
      occupy (candidate.corners);
    else if (candidate.votes == 3)
      seam.push_back (candidate.corners);
    return fits;
  }

private:
  void occupy (const Triangle& corners)
  {
    for (std::size_t i = 0; i < 3; ++i) {
      Index& last = last_sector[corners[i]];
      if (last == UNWATCHED)
        continue;
      sectors.push_back ({corners[(i + 1) % 3], corners[(i + 2) % 3], last});
      last = static_cast<Index> (sectors.size () - 1);
    }
  }

  Sector sector (Index p, Index q, Index r) const
  {
    const TangentFrame frame (normals[p].cast<double> ());
    Sector sector{q, r, frame.project (positions[q] - positions[p]),
                  frame.project (positions[r] - positions[p])};
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
      for (Index s = last_sector[p]; s != NONE; s = sectors[s].before)
        if (overlap (wanted, sector (p, sectors[s].q, sectors[s].r)))
          return true;
    }
    return false;
  }
};

} // namespace

SignedSets::Place
Orientation::placeOf (const Triangle& corners, std::uint8_t clockwise, std::size_t corner)
{
  SignedSets::Place place = sides_.find (corners[corner]);
  place.flipped = place.flipped != (((clockwise >> corner) & 1U) != 0);
  return place;
}

bool
Orientation::join (const Triangle& corners, std::uint8_t clockwise)
{
  using Place = SignedSets::Place;
  const Place a = placeOf (corners, clockwise, 0), b = placeOf (corners, clockwise, 1),
              c = placeOf (corners, clockwise, 2);
  const auto contradict = [] (const Place& p, const Place& q) {
    return p.root == q.root && p.flipped != q.flipped;
  };
  if (contradict (a, b) || contradict (a, c) || contradict (b, c))
    return false;
  if (a.root != b.root)
    sides_.join (a.root, b.root, a.flipped != b.flipped);
  if (a.root != c.root)
    sides_.join (a.root, c.root, a.flipped != c.flipped);
  return true;
}

void
Orientation::vote (const std::vector<Candidate>& candidates, const Row& voters,
                   const RunContext& run)
{
  ProgressLoop progress (run);
  while (true) {
    // Of two sets, by their representatives: positive for the same side, negative for opposite ones.
    std::map<std::pair<Index, Index>, int> sums;
    for (const Index voter : voters) {
      progress.next ();
      const Candidate& c = candidates[voter];
      for (std::size_t i = 0; i < 3; ++i) {
        const SignedSets::Place a = placeOf (c.corners, c.clockwise, i),
                                b = placeOf (c.corners, c.clockwise, (i + 1U) % 3U);
        if (a.root != b.root)
          sums[std::minmax (a.root, b.root)] += a.flipped != b.flipped ? -c.votes : c.votes;
      }
    }
    if (sums.empty ())
      return;
    std::vector<std::pair<std::pair<Index, Index>, int>> votes (sums.begin (), sums.end ());
    std::stable_sort (votes.begin (), votes.end (), [] (const auto& one, const auto& other) {
      return std::abs (one.second) > std::abs (other.second);
    });
    std::unordered_set<Index> joined;
    for (const auto& [sets, weight] : votes) {
      progress.next ();
      const bool is_first_of_a = joined.insert (sets.first).second;
      const bool is_first_of_b = joined.insert (sets.second).second;
      if (is_first_of_a || is_first_of_b)
        sides_.join (sets.first, sets.second, weight < 0);
    }
  }
}

Triangle
Orientation::turned (Triangle corners, std::uint8_t clockwise)
{
  if (placeOf (corners, clockwise, 0).flipped)
    std::swap (corners[1], corners[2]);
  return corners;
}

void
Orientation::turn (Normals& normals, const RunContext& run)
{
  ProgressLoop progress (run);
  for (Index p = 0; p < normals.size (); ++p) {
    progress.next ();
    if (sides_.find (p).flipped)
      normals[p] = -normals[p];
  }
}

std::vector<Candidate>
findCandidates (const Positions& positions, const Stars& stars, const Normals& normals,
                const std::vector<float>& spacing, const RunContext& run)
{
  RangeLists<Candidate> ranges (positions.size ());
  parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Candidate>& range = ranges.of (first);
    range.reserve (2 * (last - first));
    for (auto p = static_cast<Index> (first); p < last; ++p) {
      anyTriangle (stars, p, [&] (Index q, Index r) {
        const bool in_q = hasTriangle (stars, q, r, p), in_r = hasTriangle (stars, r, p, q);
        if ((in_q && q < p) || (in_r && r < p))
          return false; // q or r is its first corner
        Candidate candidate{{p, q, r}, static_cast<std::uint8_t> (1 + in_q + in_r)};
        double step = (spacing[p] + spacing[q] + spacing[r]) / 3.0;
        if (const std::vector<float>& reach = stars.reach; !reach.empty ())
          step = std::max (step, static_cast<double> (REACH_AS_SPACING *
                                                      std::max ({reach[p], reach[q], reach[r]})));
        candidate.circumradius_ratio =
            static_cast<float> (circumradius (positions[p], positions[q], positions[r]) / step);
        setNormalAgreement (positions, normals, candidate);
        const std::size_t rank = candidate.votes - 1U;
        if (candidate.circumradius_ratio <= LARGEST_CIRCUMRADIUS[rank] &&
            candidate.normal_agreement >= LEAST_AGREEMENT[rank])
          range.push_back (candidate);
        return false;
      });
    }
  });
  return ranges.join ();
}

Consensus
buildConsensus (const Positions& positions, std::vector<Candidate> candidates, Normals& normals,
                const RunContext& run)
{
  // In the order of their offers: those of three votes by their class of normal agreement, so that the
  // orientation spreads along triangles that agree best, like a minimum spanning forest.
  CsrLists order = makeCsrLists (AGREEMENT_RANKS + 1, [&] (const auto& emit) {
    for (Index c = 0; c < candidates.size (); ++c) {
      const auto steps = static_cast<std::size_t> ((1.0F - candidates[c].normal_agreement) *
                                                   static_cast<float> (AGREEMENT_RANKS));
      emit (candidates[c].votes == 3 ? std::min (steps, AGREEMENT_RANKS - 1) : AGREEMENT_RANKS, c);
    }
  });
  std::vector<Index>& ids = order.ids;
  const std::size_t doubtful = order.offsets[SURE_RANKS]; // from there on
  const std::size_t fewer_votes = order.offsets[AGREEMENT_RANKS];
  run.poll ();
  std::sort (ids.begin () + static_cast<std::ptrdiff_t> (fewer_votes), ids.end (),
             [&candidates] (Index i, Index j) {
               const Candidate &a = candidates[i], &b = candidates[j];
               return std::tie (b.votes, b.normal_agreement, a.circumradius_ratio, a.corners) <
                      std::tie (a.votes, a.normal_agreement, b.circumradius_ratio, b.corners);
             });
  run.poll ();

  ConsensusBuilder builder{positions, normals};
  for (std::size_t i = fewer_votes; i < ids.size (); ++i)
    for (const Index p : candidates[ids[i]].corners)
      builder.last_sector[p] = NONE; // sectors here are recorded from now on, for later tests
  ProgressLoop progress (run, ids.size ());
  const auto offer = [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      progress.next ();
      candidates[ids[i]].is_taken = builder.offer (candidates[ids[i]], i >= fewer_votes);
    }
  };
  offer (0, doubtful);
  builder.orientation.vote (candidates, {ids.data () + doubtful, ids.data () + fewer_votes}, run);
  offer (doubtful, ids.size ());

  const CsrLists at_corner = makeCsrLists (positions.size (), [&] (const auto& emit) {
    for (const Index c : ids)
      if (candidates[c].is_taken)
        emit (candidates[c].corners[0], c);
  });
  Consensus consensus;
  consensus.triangles.reserve (at_corner.ids.size ());
  consensus.votes.reserve (at_corner.ids.size ());
  for (const Index c : at_corner.ids) {
    const Candidate& candidate = candidates[c];
    consensus.triangles.push_back (
        builder.orientation.turned (candidate.corners, candidate.clockwise));
    consensus.votes.push_back (candidate.votes);
  }
  consensus.seam = std::move (builder.seam);
  builder.orientation.turn (normals, run);
  return consensus;
}

} // namespace pcl::floater
