// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameterization/region_recursion.h"

#include "common/monitor.h"
#include "neighborhoods/stars.h"
#include "parameterization/parameterize.h"
#include "triangulation/planar_delaunay.h"

#include <algorithm>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// A region as a cloud of its own, numbered from 0.
struct Piece
{
  std::vector<Index> points; // of the whole cloud; ascending
  std::vector<Index> loop;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector2d> uv;
  SurfaceMesh mesh;
  std::size_t level = 0;
};

// True if the boundary of the mesh is the loop.
bool
fillsLoop (const SurfaceMesh& mesh, const std::vector<Index>& loop)
{
  std::vector<Index> successor (mesh.triangle_of.size (), NONE);
  for (std::size_t i = 0; i < loop.size (); ++i)
    successor[loop[i]] = loop[(i + 1) % loop.size ()];
  std::size_t edges = 0;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE) {
        if (successor[mesh.from ({t, side})] != mesh.to ({t, side}))
          return false;
        ++edges;
      }
  return edges == loop.size ();
}

// Makes pieces of regions and collects the triangles of what is not cut out any more.
class Recursion
{
public:
  Recursion (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
             const std::vector<Eigen::Vector3f>& normals, const Options& options)
      : positions_ (positions), near_ (near), normals_ (normals), options_ (options),
        place_ (positions.size (), NONE)
  {
    options_.domain = Domain::CIRCLE;
    options_.progress = nullptr;
  }

  /// Cuts the regions out of a mesh over `points` of the whole cloud (nullptr: all of them).
  void cut (std::vector<Triangle> triangles, const std::vector<Index>* points,
            const std::vector<CollapsedRegion>& regions, std::size_t level)
  {
    for (const CollapsedRegion& region : regions) {
      Piece piece = makePiece (region, points);
      piece.level = level + 1;
      if (!solvePiece (piece))
        continue;
      waiting_.push_back (std::move (piece));
      for (const Index t : region.triangles)
        triangles[t][0] = NONE;
    }
    for (Triangle t : triangles) {
      if (t[0] == NONE)
        continue;
      if (points != nullptr)
        for (Index& p : t)
          p = (*points)[p];
      triangles_.push_back (t);
    }
  }

  /// Goes on with the pieces until none is left.
  RegionRecursion run ()
  {
    RegionRecursion result;
    while (!waiting_.empty ()) {
      Piece piece = std::move (waiting_.back ());
      waiting_.pop_back ();
      ++result.regions;
      result.levels = std::max (result.levels, piece.level);
      const std::vector<CollapsedRegion> regions =
          findCollapsedRegions (piece.mesh, piece.uv, piece.positions, piece.loop);
      cut (std::move (piece.mesh.triangles), &piece.points, regions, piece.level);
    }
    return result;
  }

  std::vector<Triangle> takeTriangles () { return std::move (triangles_); }

private:
  static Piece makePiece (const CollapsedRegion& region, const std::vector<Index>* points)
  {
    Piece piece;
    const auto name = [points] (Index p) { return points == nullptr ? p : (*points)[p]; };
    for (const std::vector<Index>* part : {&region.rim, &region.interior})
      for (const Index p : *part)
        piece.points.push_back (name (p));
    std::sort (piece.points.begin (), piece.points.end ());
    for (const Index p : region.rim)
      piece.loop.push_back (static_cast<Index> (
          std::lower_bound (piece.points.begin (), piece.points.end (), name (p)) -
          piece.points.begin ()));
    return piece;
  }

  // Stars among the piece's own points: beyond the rim there is nothing to hang on.
  FlatLists nearWithin (const Piece& piece)
  {
    for (std::size_t i = 0; i < piece.points.size (); ++i)
      place_[piece.points[i]] = static_cast<Index> (i);
    FlatLists near;
    near.offsets.push_back (0);
    for (const Index p : piece.points) {
      for (const Index q : near_.row (p))
        if (place_[q] != NONE)
          near.ids.push_back (place_[q]);
      near.offsets.push_back (static_cast<Index> (near.ids.size ()));
    }
    for (const Index p : piece.points)
      place_[p] = NONE;
    return near;
  }

  bool solvePiece (Piece& piece)
  {
    const FlatLists near = nearWithin (piece);
    std::vector<Eigen::Vector3f> normals;
    for (const Index p : piece.points) {
      piece.positions.push_back (positions_[p]);
      normals.push_back (normals_[p]);
    }
    const bool all = options_.neighborhood == Neighborhood::NEAREST ||
                     options_.neighborhood == Neighborhood::BALL;
    Stars stars = makeStars (piece.positions, near, normals, options_.filter_sheets,
                             options_.threads, all ? StarKind::ALL : StarKind::DELAUNAY);
    Statistics unused;
    StageClock clock (unused, options_.progress);
    Parameterization parameterization =
        parameterize (piece.positions, near, stars, piece.loop, options_, clock, unused);
    if (parameterization.problem)
      return false;
    piece.uv = std::move (parameterization.uv);
    piece.mesh = triangulatePlane (piece.uv, piece.loop);
    return fillsLoop (piece.mesh, piece.loop);
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const FlatLists& near_;
  const std::vector<Eigen::Vector3f>& normals_;
  Options options_;
  std::vector<Index> place_; // in the piece at hand, of each point of the whole cloud
  std::vector<Piece> waiting_;
  std::vector<Triangle> triangles_;
};

} // namespace

RegionRecursion
layOutCollapsedRegions (SurfaceMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                        const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
                        const std::vector<Eigen::Vector3f>& normals, const std::vector<Index>& loop,
                        const Options& options)
{
  const std::vector<CollapsedRegion> regions = findCollapsedRegions (mesh, uv, positions, loop);
  if (regions.empty ())
    return {};
  MonitoredLoop progress (1); // stages of the regions are none of the whole
  Recursion recursion (positions, near, normals, options);
  recursion.cut (mesh.triangles, nullptr, regions, 0);
  const RegionRecursion result = recursion.run ();
  SurfaceMesh whole;
  whole.triangles = recursion.takeTriangles ();
  if (result.levels == 0 || !whole.connect (positions.size ()))
    return {};
  mesh = std::move (whole);
  return result;
}

} // namespace floater
} // namespace pcl
