// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_check.h"

#include "common/monitor.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double PRECISION = 1e-7; // of single precision coordinates, in diagonals of the cloud
constexpr double FLATTEST = 1e-3;  // height of a triangle by its longest edge
constexpr double SQR_FOLD_COSINE = 0.25; // 120 degrees between the normals
constexpr std::size_t EXACT_WIDTH = 200; // points of a loop of which all pairs are measured

using BoundaryEdge = std::pair<Index, Index>; // from, to: the surface on the left

// Sets of points that hang together.
class Pieces
{
public:
  explicit Pieces (std::size_t points) : parent_ (points)
  {
    std::iota (parent_.begin (), parent_.end (), Index{0});
  }

  Index root (Index p)
  {
    while (parent_[p] != p)
      p = parent_[p] = parent_[parent_[p]];
    return p;
  }

  // The smaller root stays, whatever the order.
  void unite (Index p, Index q)
  {
    p = root (p);
    q = root (q);
    parent_[std::max (p, q)] = std::min (p, q);
  }

private:
  std::vector<Index> parent_;
};

bool
isProper (const Triangle& t, std::size_t points)
{
  return t[0] < points && t[1] < points && t[2] < points && t[0] != t[1] && t[1] != t[2] &&
         t[2] != t[0];
}

class Examiner
{
public:
  Examiner (const std::vector<Triangle>& triangles, const WorkingSet& set,
            const std::vector<float>& spacing, MeshExamination& found)
      : triangles_ (triangles), set_ (set), spacing_ (spacing), found_ (found),
        check_ (found.check), pieces_ (set.positions.size ()), slot_ (set.positions.size (), NONE)
  {
  }

  // Every point with its triangles and edges, then the pieces.
  void run ()
  {
    const std::size_t points = set_.positions.size ();
    indexCorners ();
    MonitoredLoop progress (points);
    for (Index p = 0; p < points; ++p) {
      progress.next ();
      if (offsets_[p] == offsets_[p + 1])
        found_.unused.push_back (p);
      else
        lookAround (p);
    }
    check_.euler_characteristic = static_cast<std::int64_t> (points - found_.unused.size ()) -
                                  static_cast<std::int64_t> (edges_) +
                                  static_cast<std::int64_t> (offsets_.back () / 3);
    check_.longest_edge = std::sqrt (sqr_longest_);
    found_.longest_inside = std::sqrt (sqr_longest_inside_);
    std::vector<Index> ().swap (triangles_at_);
    countPieces ();
  }

  // Ascending.
  const std::vector<BoundaryEdge>& boundary () const { return boundary_; }

  std::size_t piecePoints (Index p) { return slot_[pieces_.root (p)]; }

private:
  // An edge from the point that is looked at, and the triangles on both sides of it.
  struct Spoke
  {
    Index to;
    Index out = 0, in = 0;           // triangles that run along it from the point, and to it
    Index left = NONE, right = NONE; // their third corners
    Index fan;                       // another spoke of the same fan, or itself
  };

  void indexCorners ()
  {
    const std::size_t points = set_.positions.size ();
    offsets_.assign (points + 2, 0);
    for (const Triangle& t : triangles_)
      if (isProper (t, points))
        for (const Index p : t)
          ++offsets_[p + 2];
      else
        noteImproper (t);
    std::partial_sum (offsets_.begin (), offsets_.end (), offsets_.begin ());
    // Shifted by one, so that filling moves every offset to its place.
    triangles_at_.resize (offsets_.back ());
    for (Index t = 0; t < triangles_.size (); ++t)
      if (isProper (triangles_[t], points))
        for (const Index p : triangles_[t])
          triangles_at_[offsets_[p + 1]++] = t;
    offsets_.pop_back ();
  }

  void noteImproper (const Triangle& t)
  {
    ++check_.nonmanifold_edges;
    ++check_.degenerate_triangles;
    for (const Index p : t)
      if (p < set_.positions.size ())
        note (found_.broken_at, p);
  }

  static void note (Index& place, Index p) { place = std::min (place, p); }

  Index spokeTo (Index q)
  {
    if (slot_[q] == NONE) {
      slot_[q] = static_cast<Index> (spokes_.size ());
      spokes_.push_back ({q, 0, 0, NONE, NONE, slot_[q]});
    }
    return slot_[q];
  }

  Index fanOf (Index spoke)
  {
    while (spokes_[spoke].fan != spoke)
      spoke = spokes_[spoke].fan = spokes_[spokes_[spoke].fan].fan;
    return spoke;
  }

  void lookAround (Index p)
  {
    spokes_.clear ();
    std::size_t joins = 0;
    for (Index i = offsets_[p]; i < offsets_[p + 1]; ++i) {
      const Triangle& t = triangles_[triangles_at_[i]];
      const std::size_t side = t[0] == p ? 0 : t[1] == p ? 1 : 2;
      const Index q = t[side == 2 ? 0 : side + 1], r = t[side == 0 ? 2 : side - 1];
      if (p < q && p < r)
        lookAtTriangle (p, q, r);
      const Index a = spokeTo (q), b = spokeTo (r);
      ++spokes_[a].out;
      spokes_[a].left = r;
      ++spokes_[b].in;
      spokes_[b].right = q;
      const Index fan_a = fanOf (a), fan_b = fanOf (b);
      joins += fan_a != fan_b ? 1 : 0;
      spokes_[std::max (fan_a, fan_b)].fan = std::min (fan_a, fan_b);
    }
    // Two triangles on the same three points close a fan that has no inside.
    const bool is_flat = spokes_.size () == 2 && spokes_[0].out + spokes_[0].in == 2;
    if (joins + 1 < spokes_.size () || is_flat) {
      ++check_.nonmanifold_vertices;
      note (found_.broken_at, p);
    }
    for (const Spoke& spoke : spokes_) {
      slot_[spoke.to] = NONE;
      if (spoke.out + spoke.in == 1 && spoke.out == 1)
        boundary_.emplace_back (p, spoke.to);
      if (p < spoke.to)
        lookAtEdge (p, spoke);
    }
  }

  void lookAtTriangle (Index a, Index b, Index c)
  {
    const Eigen::Vector3d ab = set_.positions[b] - set_.positions[a];
    const Eigen::Vector3d ac = set_.positions[c] - set_.positions[a];
    const double sqr_longest =
        std::max ({ab.squaredNorm (), ac.squaredNorm (), (ac - ab).squaredNorm ()});
    const double sqr_height = ab.cross (ac).squaredNorm () / sqr_longest;
    if (sqr_height > PRECISION * PRECISION || sqr_height > FLATTEST * FLATTEST * sqr_longest)
      return;
    ++check_.degenerate_triangles;
    note (found_.degenerate_at, a);
  }

  void lookAtEdge (Index p, const Spoke& spoke)
  {
    const Index q = spoke.to;
    ++edges_;
    pieces_.unite (p, q);
    const Eigen::Vector3d pq = set_.positions[q] - set_.positions[p];
    const double scale = 0.5 * (static_cast<double> (spacing_[p]) + spacing_[q]);
    const double sqr_length = scale > 0.0 ? pq.squaredNorm () / (scale * scale) : 0.0;
    if (sqr_length > sqr_longest_) {
      sqr_longest_ = sqr_length;
      check_.longest_edge_at = {set_.cloud_index[p], set_.cloud_index[q]};
    }
    if (spoke.out + spoke.in == 1)
      return;
    if (spoke.out != 1 || spoke.in != 1) {
      ++(spoke.out + spoke.in > 2 ? check_.nonmanifold_edges : check_.orientation_conflicts);
      note (found_.broken_at, p);
      return;
    }
    if (sqr_length > LONG_EDGE * LONG_EDGE) {
      ++found_.long_edges;
      if (sqr_length > sqr_longest_inside_) {
        sqr_longest_inside_ = sqr_length;
        found_.longest_inside_at = {p, q};
      }
    }
    const Eigen::Vector3d left = pq.cross (set_.positions[spoke.left] - set_.positions[p]);
    const Eigen::Vector3d right = (set_.positions[spoke.right] - set_.positions[p]).cross (pq);
    const double cosine = left.dot (right); // times both lengths
    if (cosine < 0.0 &&
        cosine * cosine > SQR_FOLD_COSINE * left.squaredNorm () * right.squaredNorm ()) {
      ++check_.folds;
      note (found_.fold_at, p);
    }
  }

  // Points that hang together do so by edges, but where a vertex has several fans.
  void countPieces ()
  {
    std::fill (slot_.begin (), slot_.end (), 0);
    for (Index p = 0; p < slot_.size (); ++p)
      if (offsets_[p] < offsets_[p + 1])
        ++slot_[pieces_.root (p)];
    for (Index p = 0; p < slot_.size (); ++p) {
      if (slot_[p] == 0)
        continue;
      ++check_.components;
      found_.largest_piece = std::max<std::size_t> (found_.largest_piece, slot_[p]);
      if (found_.smallest_piece_at == NONE || slot_[p] < found_.smallest_piece) {
        found_.smallest_piece = slot_[p];
        found_.smallest_piece_at = p;
      }
    }
    if (check_.nonmanifold_vertices > 0)
      check_.components = piecesByEdges ();
  }

  std::size_t piecesByEdges () const
  {
    std::vector<std::array<Index, 3>> edges; // smaller end, larger end, triangle
    std::size_t count = 0;
    for (Index t = 0; t < triangles_.size (); ++t)
      if (isProper (triangles_[t], set_.positions.size ())) {
        ++count;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto [a, b] = std::minmax (triangles_[t][i], triangles_[t][(i + 1) % 3]);
          edges.push_back ({a, b, t});
        }
      }
    std::sort (edges.begin (), edges.end ());
    Pieces pieces (triangles_.size ());
    for (std::size_t e = 1; e < edges.size (); ++e)
      if (edges[e][0] == edges[e - 1][0] && edges[e][1] == edges[e - 1][1]) {
        const Index a = pieces.root (edges[e - 1][2]), b = pieces.root (edges[e][2]);
        count -= a != b ? 1 : 0;
        pieces.unite (a, b);
      }
    return count;
  }

  const std::vector<Triangle>& triangles_;
  const WorkingSet& set_;
  const std::vector<float>& spacing_;
  MeshExamination& found_;
  MeshCheck& check_;
  std::vector<Index> offsets_, triangles_at_; // triangles of every point
  Pieces pieces_;
  std::vector<Index> slot_; // while a point is looked at: of its neighbours, the spoke to each;
                            // afterwards of every root the points of its piece
  std::vector<Spoke> spokes_;
  std::vector<BoundaryEdge> boundary_;
  std::size_t edges_ = 0;
  double sqr_longest_ = 0.0, sqr_longest_inside_ = 0.0; // in local spacings
};

// Boundary edges in cycles. Where the mesh is broken, a walk ends at a point that no edge leaves.
std::vector<BoundaryRim>
walkRims (const std::vector<BoundaryEdge>& edges)
{
  std::vector<BoundaryRim> rims;
  std::vector<std::uint8_t> walked (edges.size (), 0);
  for (std::size_t start = 0; start < edges.size (); ++start) {
    if (walked[start] != 0)
      continue;
    BoundaryRim rim;
    for (std::size_t e = start; e < edges.size () && walked[e] == 0;) {
      walked[e] = 1;
      rim.points.push_back (edges[e].first);
      const Index to = edges[e].second;
      e = static_cast<std::size_t> (
          std::lower_bound (edges.begin (), edges.end (), BoundaryEdge{to, 0}) - edges.begin ());
      while (e < edges.size () && edges[e].first == to && walked[e] != 0)
        ++e;
      if (e < edges.size () && edges[e].first != to)
        break;
    }
    rims.push_back (std::move (rim));
  }
  return rims;
}

double
widthOf (const std::vector<Index>& loop, const std::vector<Eigen::Vector3d>& positions)
{
  double sqr_width = 0.0;
  const auto farthestFrom = [&] (Index p, std::size_t first) {
    Index farthest = p;
    double sqr_distance = 0.0;
    for (std::size_t i = first; i < loop.size (); ++i) {
      const double sqr = (positions[loop[i]] - positions[p]).squaredNorm ();
      if (sqr > sqr_distance) {
        sqr_distance = sqr;
        farthest = loop[i];
      }
    }
    sqr_width = std::max (sqr_width, sqr_distance);
    return farthest;
  };
  if (loop.size () <= EXACT_WIDTH)
    for (std::size_t i = 0; i < loop.size (); ++i)
      farthestFrom (loop[i], i + 1);
  else
    farthestFrom (farthestFrom (loop.front (), 0), 0);
  return std::sqrt (sqr_width);
}

LoopSummary
summaryOf (const std::vector<Index>& loop, const WorkingSet& set, const std::vector<float>& spacing)
{
  LoopSummary summary;
  summary.points = loop.size ();
  summary.at = NONE;
  double length = 0.0, spacings = 0.0;
  for (std::size_t i = 0; i < loop.size (); ++i) {
    const Index p = loop[i], q = loop[i + 1 == loop.size () ? 0 : i + 1];
    length += (set.positions[q] - set.positions[p]).norm ();
    spacings += spacing[p];
    summary.at = std::min (summary.at, set.cloud_index[p]);
  }
  const double width = widthOf (loop, set.positions);
  summary.length = set.scale * length;
  summary.width = set.scale * width;
  summary.width_spacings =
      spacings > 0.0 ? width * static_cast<double> (loop.size ()) / spacings : 0.0;
  return summary;
}

// Longest first, equal ones by their place.
void
sortLoops (MeshExamination& found)
{
  std::vector<std::size_t> order (found.rims.size ());
  std::iota (order.begin (), order.end (), std::size_t{0});
  const std::vector<LoopSummary>& loops = found.check.loops;
  std::sort (order.begin (), order.end (), [&loops] (std::size_t a, std::size_t b) {
    return loops[a].length != loops[b].length ? loops[a].length > loops[b].length
                                              : loops[a].at < loops[b].at;
  });
  std::vector<LoopSummary> sorted_loops;
  std::vector<BoundaryRim> sorted_rims;
  for (const std::size_t i : order) {
    sorted_loops.push_back (loops[i]);
    sorted_rims.push_back (std::move (found.rims[i]));
  }
  found.check.loops = std::move (sorted_loops);
  found.rims = std::move (sorted_rims);
}

} // namespace

MeshExamination
checkMesh (const std::vector<Triangle>& triangles, const WorkingSet& set,
           const std::vector<float>& spacing)
{
  MeshExamination found;
  found.check.done = true;
  Examiner examiner (triangles, set, spacing, found);
  examiner.run ();
  found.rims = walkRims (examiner.boundary ());
  for (BoundaryRim& rim : found.rims) {
    rim.piece_points = examiner.piecePoints (rim.points.front ());
    found.check.loops.push_back (summaryOf (rim.points, set, spacing));
  }
  sortLoops (found);
  // Of every piece the characteristic is 2 - 2 genus - loops.
  if (found.isManifold ())
    found.check.genus =
        (2 * static_cast<std::int64_t> (found.check.components) -
         static_cast<std::int64_t> (found.rims.size ()) - found.check.euler_characteristic) /
        2;
  return found;
}

} // namespace floater
} // namespace pcl
