// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/surface_complex.h"

#include "complex/signed_sets.h"
#include "neighborhoods/tangent_frame.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t CLASSES = 32; // of agreement

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

  void offer (const Candidate& candidate)
  {
    // Sectors of one star do not overlap: candidates of three votes, offered first, need no test.
    for (std::uint8_t i = 0; i < 3 && candidate.votes < 3; ++i)
      if (isTaken (candidate.corners, i))
        return;
    if (!isOriented (candidate)) {
      complex_.misfits += candidate.votes == 3 ? 1 : 0;
      return;
    }
    const auto t = static_cast<Index> (complex_.triangles.size ());
    complex_.triangles.push_back (candidate.corners);
    complex_.votes.push_back (candidate.votes);
    for (std::uint8_t i = 0; i < 3; ++i) {
      next_corner_.push_back (first_corner_[candidate.corners[i]]);
      first_corner_[candidate.corners[i]] = 3 * t + i;
    }
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
    return std::move (complex_);
  }

private:
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

  bool isTaken (const Triangle& corners, std::uint8_t i) const
  {
    const Sector wanted = sector (corners, i);
    for (Index c = first_corner_[corners[i]]; c != NONE; c = next_corner_[c])
      if (overlap (wanted, sector (complex_.triangles[c / 3], static_cast<std::uint8_t> (c % 3))))
        return true;
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

} // namespace

SurfaceComplex
buildComplex (const std::vector<Eigen::Vector3d>& positions, std::vector<Candidate> candidates,
              std::vector<Eigen::Vector3f>& normals)
{
  // The trees of normals grow along triangles that agree best, like a spanning forest of least
  // cost; that takes classes of agreement, no full order, for the many candidates of three votes.
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
  ComplexBuilder builder (positions, normals, candidates.size ());
  for (Index i : order)
    builder.offer (candidates[i]);
  std::vector<Candidate> ().swap (candidates);
  return builder.finish (normals);
}

} // namespace floater
} // namespace pcl
