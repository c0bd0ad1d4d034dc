// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/boundary_notches.h"

#include "mesh/boundary_peel.h"
#include "mesh/triangle_removal.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace pcl
{
namespace floater
{
namespace
{
using Positions = std::vector<Eigen::Vector3d>;

// A sample of the corners tells how obtuse they are: of so many triangles.
constexpr std::size_t SAMPLE = 20'000;

class NotchOpener
{
public:
  NotchOpener (const TriangleMesh& mesh, const Positions& positions, const NotchLimits& limits,
               const RunContext& run)
      : mesh_ (mesh), positions_ (positions), limits_ (limits), run_ (run),
        peel_ (mesh, positions.size (), run)
  {
  }

  /// Number of triangles to take out.
  std::size_t run ()
  {
    if (peel_.edges ().empty ())
      return 0;
    limit_ = std::min (limits_.largest_cosine, usualCosine ());
    for (const MeshEdge e : peel_.edges ())
      offer (e);
    std::size_t count = 0;
    while (!notches_.empty ()) {
      const auto [cosine, triangle, side] = notches_.top ();
      notches_.pop ();
      const MeshEdge e{triangle, side};
      if (!peel_.mayTake (e))
        continue;
      peel_.take (e);
      ++count;
      offer (mesh_.mate ({triangle, TriangleMesh::next (side)}));
      offer (mesh_.mate ({triangle, TriangleMesh::previous (side)}));
    }
    return count;
  }

  std::vector<std::uint8_t> takenTriangles () && { return std::move (peel_).takenTriangles (); }

private:
  using Notch = std::tuple<double, Index, std::uint8_t>; // cosine, triangle, side of the boundary

  // Of the angle opposite to an edge; 1 if points coincide.
  double cosineAt (MeshEdge e) const
  {
    const Eigen::Vector3d& corner = positions_[mesh_.corner (e)];
    const Eigen::Vector3d a = positions_[mesh_.from (e)] - corner;
    const Eigen::Vector3d b = positions_[mesh_.to (e)] - corner;
    const double product = a.norm () * b.norm ();
    return product > 0.0 ? a.dot (b) / product : 1.0;
  }

  // A cosine below which are the usual share of all corners.
  double usualCosine () const
  {
    const std::size_t step = std::max<std::size_t> (1, mesh_.triangles.size () / SAMPLE);
    std::vector<double> cosines;
    ProgressLoop progress (run_); // each triangle may bring pages into memory
    for (std::size_t t = 0; t < mesh_.triangles.size (); t += step) {
      progress.next ();
      for (std::uint8_t side = 0; side < 3; ++side)
        cosines.push_back (cosineAt ({static_cast<Index> (t), side}));
    }
    const auto at =
        cosines.begin () +
        static_cast<std::ptrdiff_t> (limits_.usual_share * static_cast<double> (cosines.size ()));
    std::nth_element (cosines.begin (), at, cosines.end ());
    return *at;
  }

  void offer (MeshEdge e)
  {
    const double cosine = cosineAt (e);
    if (cosine < limit_)
      notches_.emplace (cosine, e.triangle, e.side);
  }

  const TriangleMesh& mesh_;
  const Positions& positions_;
  const NotchLimits& limits_;
  const RunContext& run_;
  double limit_ = 0.0;
  BoundaryPeel peel_;
  std::priority_queue<Notch, std::vector<Notch>, std::greater<>> notches_;
};

} // namespace

std::size_t
openNotches (TriangleMesh& mesh, const Positions& positions, const NotchLimits& limits,
             const RunContext& run)
{
  NotchOpener opener (mesh, positions, limits, run);
  const std::size_t count = opener.run ();
  if (count > 0)
    removeTriangles (mesh, std::move (opener).takenTriangles (), run);
  return count;
}

} // namespace floater
} // namespace pcl
