// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every edge of the result is tested to be locally Delaunay, so the result is the Delaunay
// triangulation, for any positions of the pixels.
#include "view/lattice_view.h"

#include "core/exact.h"
#include "core/geometry.h"
#include "core/parallel.h"
#include "floater/planar_delaunay.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pcl::floater {
namespace {
/// Diagonal of a cell. Corners and sides are anti-clockwise in the plane; side i is from corner i
/// to i + 1. Corner 0 is the pixel with the smallest cloud index.
enum class Split : std::uint8_t
{
  NONE,  ///< not complete
  FIRST, ///< triangles (0, 1, 2) and (0, 2, 3)
  SECOND ///< triangles (0, 1, 3) and (1, 2, 3)
};

using Corners = std::array<Index, 4>;

class LatticeView
{
public:
  LatticeView (const std::vector<Eigen::Vector2d>& places, const std::vector<Index>& cloud_index,
               std::size_t lattice_width, const RunContext& run)
      : places_ (places), run_ (run), width_ (lattice_width)
  {
    const std::size_t last =
        cloud_index.empty () ? 0 : *std::max_element (cloud_index.begin (), cloud_index.end ());
    height_ = last / width_ + 1;
    columns_ = width_ - 1;
    rows_ = height_ - 1;
    point_at_.assign (width_ * height_, NONE);
    for (Index p = 0; p < cloud_index.size (); ++p)
      if (places[p].allFinite ())
        point_at_[cloud_index[p]] = p;
  }

  std::optional<TriangleMesh> triangulate ()
  {
    // Cells beside gaps may not be in the triangulation. Each round removes such cells; few clouds
    // need two.
    constexpr int ROUNDS = 4;
    // With more points outside of complete cells, this method is not faster.
    constexpr std::size_t LEAST_GAIN = 2;
    findSplits ();
    for (int round = 0; round < ROUNDS; ++round) {
      std::size_t rest = 0;
      const std::vector<Eigen::Vector2d> left_over = placesOfRest (rest);
      if (rest * LEAST_GAIN > places_.size ())
        return {};
      outer_ = triangulateHull (left_over);
      if (joinOuter ())
        return mesh ();
    }
    return {};
  }

private:
  std::size_t cells () const { return rows_ * columns_; }

  Corners cornersOf (std::size_t cell) const
  {
    const std::size_t first = cell / columns_ * width_ + cell % columns_;
    return {point_at_[first], point_at_[first + (is_mirrored_ ? width_ : 1)],
            point_at_[first + width_ + 1], point_at_[first + (is_mirrored_ ? 1 : width_)]};
  }

  /// The cell beyond a side; cells () if there is none.
  std::size_t across (std::size_t cell, std::size_t side) const
  {
    const std::size_t row = cell / columns_, column = cell % columns_;
    // Sides of an unmirrored cell: first row, last column, last row, first column.
    switch (is_mirrored_ ? 3 - side : side) {
    case 0:
      return row == 0 ? cells () : cell - columns_;
    case 1:
      return column + 1 == columns_ ? cells () : cell + 1;
    case 2:
      return row + 1 == rows_ ? cells () : cell + columns_;
    default:
      return column == 0 ? cells () : cell - 1;
    }
  }

  bool isComplete (std::size_t cell) const
  {
    return cell < cells () && splits_[cell] != Split::NONE;
  }

  bool isInCircle (Index a, Index b, Index c, Index d) const
  {
    return floater::isInCircle (places_[a], places_[b], places_[c], places_[d]);
  }

  /// The third corner of the triangle at a side of a complete cell.
  static std::size_t apexAt (Split split, std::size_t side)
  {
    constexpr std::array<std::size_t, 4> OF_FIRST{2, 0, 0, 2}, OF_SECOND{3, 3, 1, 1};
    return split == Split::FIRST ? OF_FIRST[side] : OF_SECOND[side];
  }

  template <typename Body>
  void forCells (const Body& body) const
  {
    parallelTasks (run_, rows_, [&] (std::size_t row) {
      for (std::size_t cell = row * columns_; cell < (row + 1) * columns_; ++cell)
        body (cell);
    });
  }

  Split splitOf (const Corners& q) const
  {
    if (std::find (q.begin (), q.end (), NONE) != q.end ())
      return Split::NONE;
    for (std::size_t i = 0; i < 4; ++i)
      if (!isAntiClockwise (places_[q[i]], places_[q[(i + 1) % 4]], places_[q[(i + 2) % 4]]))
        return Split::NONE;
    return isInCircle (q[0], q[1], q[2], q[3]) ? Split::SECOND : Split::FIRST;
  }

  /// Tests which cells are complete, and whether their triangles are locally Delaunay.
  void findSplits ()
  {
    is_mirrored_ = isMirrored ();
    splits_.assign (cells (), Split::NONE);
    forCells ([this] (std::size_t cell) { splits_[cell] = splitOf (cornersOf (cell)); });
    std::vector<std::uint8_t> is_bad (cells (), 0);
    forCells ([&] (std::size_t cell) {
      if (!isComplete (cell))
        return;
      const Corners q = cornersOf (cell);
      for (std::size_t side = 0; side < 4; ++side) {
        const std::size_t other = across (cell, side);
        if (!isComplete (other))
          continue;
        const Index apex = q[apexAt (splits_[cell], side)];
        const std::size_t back = (side + 2) % 4; // the same edge in the other cell
        const Index opposite = cornersOf (other)[apexAt (splits_[other], back)];
        if (isInCircle (q[side], q[(side + 1) % 4], apex, opposite))
          is_bad[cell] = 1;
      }
    });
    for (std::size_t cell = 0; cell < cells (); ++cell)
      if (is_bad[cell] != 0)
        splits_[cell] = Split::NONE;
  }

  /// Whether rows and columns are clockwise in the plane, in most cells.
  bool isMirrored () const
  {
    std::size_t positive = 0, negative = 0;
    for (std::size_t cell = 0; cell < cells (); ++cell) {
      const Corners q = cornersOf (cell);
      if (std::find (q.begin (), q.end (), NONE) != q.end ())
        continue;
      ++(cross (places_[q[2]] - places_[q[0]], places_[q[3]] - places_[q[1]]) > 0.0 ? positive
                                                                                    : negative);
    }
    return negative > positive;
  }

  /// Positions of the points that are not surrounded by complete cells; NaN for the others.
  std::vector<Eigen::Vector2d> placesOfRest (std::size_t& rest) const
  {
    constexpr double NOWHERE = std::numeric_limits<double>::quiet_NaN ();
    std::vector<Eigen::Vector2d> left_over (places_.size (), {NOWHERE, NOWHERE});
    rest = 0;
    for (std::size_t row = 0; row < height_; ++row)
      for (std::size_t column = 0; column < width_; ++column) {
        const Index p = point_at_[row * width_ + column];
        if (p == NONE || isSurrounded (row, column))
          continue;
        left_over[p] = places_[p];
        ++rest;
      }
    return left_over;
  }

  bool isSurrounded (std::size_t row, std::size_t column) const
  {
    if (row == 0 || column == 0 || row == rows_ || column == columns_)
      return false;
    const std::size_t cell = row * columns_ + column;
    return isComplete (cell) && isComplete (cell - 1) && isComplete (cell - columns_) &&
           isComplete (cell - columns_ - 1);
  }

  /// The edge of the outer triangulation from p to q; triangle NONE if there is none.
  MeshEdge outerEdge (Index p, Index q, std::vector<Index>& fan) const
  {
    outer_.fan (p, fan);
    for (const Index t : fan) {
      const MeshEdge edge{t, TriangleMesh::previous (outer_.sideOf (t, p))};
      if (outer_.to (edge) == q)
        return edge;
    }
    return {NONE, 0};
  }

  /// Finds the triangles of the outer triangulation between the complete cells.
  /// \return false if some cells are not in the Delaunay triangulation; they are marked incomplete
  bool joinOuter ()
  {
    std::vector<std::array<std::uint8_t, 3>> is_closed (outer_.triangles.size (), {0, 0, 0});
    std::vector<Index> kept, covered, fan;
    std::vector<std::size_t> bad;
    for (std::size_t cell = 0; cell < cells (); ++cell) {
      if (!isComplete (cell))
        continue;
      for (std::size_t side = 0; side < 4; ++side) {
        if (isComplete (across (cell, side)))
          continue;
        const Corners q = cornersOf (cell);
        const Index from = q[side], to = q[(side + 1) % 4];
        const MeshEdge inner = outerEdge (from, to, fan);
        const MeshEdge edge = outerEdge (to, from, fan);
        if (edge.triangle == NONE && inner.triangle == NONE) {
          bad.push_back (cell);
          continue;
        }
        if (inner.triangle != NONE) {
          is_closed[inner.triangle][inner.side] = 1;
          covered.push_back (inner.triangle);
        }
        if (edge.triangle == NONE)
          continue; // on the convex hull
        is_closed[edge.triangle][edge.side] = 1;
        if (isInCircle (from, to, q[apexAt (splits_[cell], side)], outer_.corner (edge)))
          bad.push_back (cell);
        kept.push_back (edge.triangle);
      }
    }
    for (const std::size_t cell : bad)
      splits_[cell] = Split::NONE;
    if (!bad.empty ())
      return false;
    const std::vector<std::uint8_t> is_kept = spread (kept, is_closed);
    const std::vector<std::uint8_t> is_covered = spread (covered, is_closed);
    kept_.clear ();
    for (Index t = 0; t < outer_.triangles.size (); ++t) {
      overlaps_ = overlaps_ || (is_kept[t] != 0 && is_covered[t] != 0);
      if (is_kept[t] != 0)
        kept_.push_back (t);
    }
    return true;
  }

  /// The triangles of the outer triangulation that are connected to some without crossing a closed
  /// side.
  std::vector<std::uint8_t> spread (std::vector<Index> reached,
                                    const std::vector<std::array<std::uint8_t, 3>>& is_closed) const
  {
    std::vector<std::uint8_t> is_reached (outer_.triangles.size (), 0);
    for (const Index t : reached)
      is_reached[t] = 1;
    while (!reached.empty ()) {
      const Index t = reached.back ();
      reached.pop_back ();
      for (std::size_t side = 0; side < 3; ++side) {
        const Index other = outer_.neighbors[t][side];
        if (is_closed[t][side] != 0 || other == NONE || is_reached[other] != 0)
          continue;
        is_reached[other] = 1;
        reached.push_back (other);
      }
    }
    return is_reached;
  }

  /// \return nothing if complete cells overlap each other or other points
  std::optional<TriangleMesh> mesh () const
  {
    if (overlaps_)
      return {};
    TriangleMesh mesh;
    for (std::size_t cell = 0; cell < cells (); ++cell) {
      if (!isComplete (cell))
        continue;
      const Corners q = cornersOf (cell);
      const bool is_first = splits_[cell] == Split::FIRST;
      mesh.triangles.push_back ({q[0], q[1], is_first ? q[2] : q[3]});
      mesh.triangles.push_back ({is_first ? q[0] : q[1], q[2], q[3]});
    }
    for (const Index t : kept_)
      mesh.triangles.push_back (outer_.triangles[t]);
    if (!mesh.connect (places_.size (), run_))
      return {};
    for (Index p = 0; p < places_.size (); ++p)
      if (mesh.triangle_of[p] == NONE && outer_.triangle_of[p] != NONE)
        return {};
    return mesh;
  }

  const std::vector<Eigen::Vector2d>& places_;
  RunContext run_;
  std::size_t width_, height_ = 0;     // in pixels
  std::size_t columns_ = 0, rows_ = 0; // in cells
  bool is_mirrored_ = false;
  std::vector<Index> point_at_; // of each pixel
  std::vector<Split> splits_;   // of each cell
  TriangleMesh outer_;
  std::vector<Index> kept_; // triangles of the outer triangulation between cells, ascending
  bool overlaps_ = false;   // complete cells overlap, as in a scan of a full turn
};

} // namespace

std::optional<TriangleMesh>
triangulateLattice (const std::vector<Eigen::Vector2d>& places,
                    const std::vector<Index>& cloud_index, std::size_t lattice_width,
                    const RunContext& run)
{
  return LatticeView (places, cloud_index, lattice_width, run).triangulate ();
}

} // namespace pcl::floater
