// SPDX-License-Identifier: GPL-3.0-or-later
// Plain structs that pass between the stages.
//
// Three index spaces: a `cloud_index` counts in the user's cloud, a `point` is a row of the working
// set, an `unknown` is a row of the linear system.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl
{
namespace floater
{
using Index = std::uint32_t;
constexpr Index NONE = std::numeric_limits<Index>::max ();

/// A row of a flat table.
struct Row
{
  const Index* first;
  const Index* last;

  const Index* begin () const { return first; }
  const Index* end () const { return last; }
  std::size_t size () const { return static_cast<std::size_t> (last - first); }
  Index operator[] (std::size_t i) const { return first[i]; }
};

/// Lists of points, one for each point, in one array: row p is ids[offsets[p]] to ids[offsets[p +
/// 1]].
struct FlatLists
{
  std::vector<Index> offsets; ///< one more than there are rows
  std::vector<Index> ids;

  std::size_t rows () const { return offsets.empty () ? 0 : offsets.size () - 1; }
  Row row (std::size_t p) const { return {ids.data () + offsets[p], ids.data () + offsets[p + 1]}; }
};

/// Rows of a table to work on, ascending: those listed, or a range of them.
class Selection
{
public:
  static Selection all (std::size_t rows) { return {nullptr, 0, rows}; }
  static Selection range (Index first, Index last) { return {nullptr, first, last - first}; }
  static Selection of (const std::vector<Index>& rows) { return {rows.data (), 0, rows.size ()}; }

  std::size_t size () const { return count_; }
  Index operator[] (std::size_t i) const
  {
    return rows_ ? rows_[i] : first_ + static_cast<Index> (i);
  }

private:
  Selection (const Index* rows, Index first, std::size_t count)
      : rows_ (rows), first_ (first), count_ (count)
  {
  }

  const Index* rows_;
  Index first_;
  std::size_t count_;
};

/// Finite, distinct points, in the order of a space-filling curve, so that near points are near in
/// memory. The order depends on the coordinates only, not on the order of the cloud.
struct WorkingSet
{
  std::vector<Eigen::Vector3d> positions;            ///< centred, diagonal of the bounding box 1
  std::vector<Index> cloud_index;                    ///< of each point; for duplicates the smallest
  Eigen::Vector3d centre = Eigen::Vector3d::Zero (); ///< cloud = centre + scale * position
  double scale = 1.0;
  std::vector<Index> non_finite;                ///< cloud indices, ascending
  std::vector<std::array<Index, 2>> duplicates; ///< cloud indices (point, its stand-in), ascending
};

/// Stars of the points in their tangent planes: neighbours joined to the centre. Neighbours are in
/// anti-clockwise order seen along the normal; in an open star the sector from the last neighbour
/// to the first has no triangle. Normals are unit vectors of arbitrary sign: stars of neighbours
/// may run opposite ways round.
struct Stars
{
  FlatLists neighbors;
  std::vector<Eigen::Vector2d>
      offsets_in_plane;           ///< parallel to neighbors.ids: position in the plane
                                  ///< relative to the centre, length as in space
  std::vector<std::uint8_t> open; ///< 1 if the star does not surround its centre
  std::vector<Eigen::Vector3f> normals;
};

using Triangle = std::array<Index, 3>;

} // namespace floater
} // namespace pcl
