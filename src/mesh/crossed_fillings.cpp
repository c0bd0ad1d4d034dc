// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/crossed_fillings.h"

#include "mesh/box_tree.h"
#include "mesh/hole_filling.h"

namespace pcl::floater {
namespace {
// Which triangles cross those of a mesh that are in a tree. Each loop has a copy of its own.
struct Obstacles
{
  const std::vector<Triangle>& triangles;
  const Positions& positions;
  const BoxTree& tree;
  std::vector<std::size_t> found = {}; // the latest first

  // \param counts (t): whether a triangle in the way counts
  template <typename Counts>
  bool cross (const Triangle& triangle, Counts&& counts)
  {
    const auto isInTheWay = [&] (std::size_t t) {
      return counts (triangles[t]) && doCross (triangle, triangles[t], positions);
    };
    const Eigen::AlignedBox3d box = boxOf (triangle, positions);
    const auto again = std::find_if (found.begin (), found.end (), [&] (std::size_t t) {
      return box.intersects (boxOf (triangles[t], positions)) && isInTheWay (t);
    });
    if (again != found.end ()) {
      std::rotate (found.begin (), again, again + 1);
      return true;
    }
    return tree.forOverlaps (box, [&] (std::size_t t) {
      if (!isInTheWay (t))
        return false;
      found.resize (std::min (found.size (), KEPT - 1));
      found.insert (found.begin (), t);
      return true;
    });
  }

  // The triangles of a loop have mostly the same ones in their way.
  static constexpr std::size_t KEPT = 16;
};

bool
isAny (const Triangle& /*triangle*/)
{
  return true;
}

} // namespace

CrossedFillings::CrossedFillings (const TriangleMesh& mesh, std::size_t before,
                                  const std::vector<BoundaryLoop>& loops,
                                  const Positions& positions, const TriangleCost& cost,
                                  const RunContext& run)
{
  if (mesh.triangles.size () == before)
    return;
  const BoxTree tree (
      before, [&] (std::size_t t) { return boxOf (mesh.triangles[t], positions); }, run);
  Obstacles obstacles{mesh.triangles, positions, tree};
  loop_of_.assign (positions.size (), NONE);
  for (Index i = 0; i < loops.size (); ++i)
    for (const Index p : loops[i].points)
      loop_of_[p] = i;
  const auto isAtNoLoop = [this] (const Triangle& t) {
    return !anyCorner (t, [this] (Index p) { return loop_of_[p] != NONE; });
  };
  is_crossed_.assign (loops.size (), 0);
  is_pierced_ = is_crossed_;
  for (std::size_t t = before; t < mesh.triangles.size (); ++t) {
    run.poll ();
    const Triangle& triangle = mesh.triangles[t];
    if (!obstacles.cross (triangle, isAny))
      continue;
    const Index loop = loopOf (triangle);
    is_crossed_[loop] = 1;
    if (is_pierced_[loop] == 0 && obstacles.cross (triangle, isAtNoLoop))
      is_pierced_[loop] = 1;
  }
  if (std::find (is_crossed_.begin (), is_crossed_.end (), 1) == is_crossed_.end ())
    return;
  const auto end = mesh.triangles.begin () + static_cast<std::ptrdiff_t> (before);
  before_.assign (mesh.triangles.begin (), end);
  first_.assign (end, mesh.triangles.end ());
  TriangleMesh around;
  around.triangles = before_;
  std::copy_if (first_.begin (), first_.end (), std::back_inserter (around.triangles),
                [this] (const Triangle& t) { return is_crossed_[loopOf (t)] == 0; });
  around.connect (positions.size (), run);
  const std::size_t all = around.triangles.size ();
  std::vector<BoundaryLoop> crossed = loops;
  for (std::size_t i = 0; i < loops.size (); ++i)
    crossed[i].keep_open = is_crossed_[i] == 0;
  fillHoles (around, crossed, positions, cost, run,
             [obstacles] (const Triangle& t) mutable { return !obstacles.cross (t, isAny); });
  other_.assign (around.triangles.begin () + static_cast<std::ptrdiff_t> (all),
                 around.triangles.end ());
  for (std::size_t i = 0; i < loops.size (); ++i)
    is_clear_.push_back (crossed[i].keep_open ? 0 : 1);
}

std::vector<Triangle>
CrossedFillings::replaced (const Flags& is_chosen, bool may_stay_open,
                           std::vector<BoundaryLoop>& loops) const
{
  Flags is_replaced (loops.size (), 0);
  for (std::size_t p = 0; p < is_chosen.size (); ++p)
    if (const Index i = loop_of_[p]; is_chosen[p] != 0 && i != NONE && is_crossed_[i] != 0) {
      is_replaced[i] = is_clear_[i] != 0 || (may_stay_open && is_pierced_[i] != 0) ? 1 : 0;
      loops[i].keep_open = loops[i].judgement.is_too_deep =
          is_replaced[i] != 0 && is_clear_[i] == 0;
    }
  if (std::find (is_replaced.begin (), is_replaced.end (), 1) == is_replaced.end ())
    return {};
  std::vector<Triangle> triangles = before_;
  std::copy_if (first_.begin (), first_.end (), std::back_inserter (triangles),
                [&] (const Triangle& t) { return is_replaced[loopOf (t)] == 0; });
  std::copy_if (other_.begin (), other_.end (), std::back_inserter (triangles),
                [&] (const Triangle& t) { return is_replaced[loopOf (t)] != 0; });
  return triangles;
}

} // namespace pcl::floater
