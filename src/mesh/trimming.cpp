// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/trimming.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
// An edge is as long as the limit up to rounding; positions are in a box of diagonal 1.
constexpr double ROUNDING = 1e-15;

class Trimmer
{
public:
  Trimmer (TriangleMesh& mesh, const RunContext& run)
      : mesh_ (mesh), run_ (run), is_kept_ (mesh.triangles.size (), 1)
  {
  }

  void cutLongEdges (const Points& points, const std::vector<float>& spacing,
                     const TrimmingOptions& options)
  {
    ProgressLoop progress (run_);
    for (Index t = 0; t < mesh_.triangles.size (); ++t) {
      progress.next ();
      const Triangle& triangle = mesh_.triangles[t];
      for (std::size_t i = 0; i < 3; ++i)
        if (isTooLong (triangle[i], triangle[(i + 1) % 3], points, spacing, options)) {
          takeOut (t);
          break;
        }
    }
    while (!changed_.empty ()) {
      const Index p = changed_.back ();
      changed_.pop_back ();
      keepLargestFan (p);
    }
    compact ();
  }

  // \return how many
  std::size_t cutSmallComponents (std::size_t fewest)
  {
    const MeshComponents components = findComponents (mesh_, run_);
    const std::vector<std::size_t> points = countPoints (mesh_, components);
    for (Index t = 0; t < mesh_.triangles.size (); ++t)
      if (points[components.of_triangle[t]] < fewest)
        is_kept_[t] = 0;
    compact ();
    return static_cast<std::size_t> (std::count_if (
        points.begin (), points.end (), [fewest] (std::size_t count) { return count < fewest; }));
  }

private:
  static bool isTooLong (Index p, Index q, const Points& points, const std::vector<float>& spacing,
                         const TrimmingOptions& options)
  {
    const double length = (points.positions[q] - points.positions[p]).norm () - ROUNDING;
    const double unit = 0.5 * (static_cast<double> (spacing[p]) + spacing[q]);
    return (options.maximum_edge_length > 0.0 &&
            length > options.maximum_edge_length / points.scale) ||
           (options.maximum_edge_ratio > 0.0 && length > options.maximum_edge_ratio * unit);
  }

  void takeOut (Index t)
  {
    if (is_kept_[t] == 0)
      return;
    is_kept_[t] = 0;
    for (const Index p : mesh_.triangles[t])
      changed_.push_back (p);
  }

  // The triangles around p are one fan of the mesh as it was. What is kept of it are runs.
  void keepLargestFan (Index p)
  {
    mesh_.fan (p, fan_);
    const auto isKept = [this] (Index t) { return is_kept_[t] != 0; };
    // In a closed fan, a run may go on from the last triangle to the first: begin at a gap.
    if (isClosed (p))
      std::rotate (fan_.begin (), std::find_if_not (fan_.begin (), fan_.end (), isKept),
                   fan_.end ());
    std::size_t largest = 0, length = 0, end = 0;
    for (std::size_t i = 0; i < fan_.size (); ++i) {
      length = isKept (fan_[i]) ? length + 1 : 0;
      if (length > largest) {
        largest = length;
        end = i + 1;
      }
    }
    for (std::size_t i = 0; i < fan_.size (); ++i)
      if (i + largest < end || i >= end)
        takeOut (fan_[i]);
  }

  bool isClosed (Index p) const
  {
    const Index first = fan_.front ();
    return mesh_.neighbors[first][TriangleMesh::previous (mesh_.sideOf (first, p))] != NONE;
  }

  void compact ()
  {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size (); ++t)
      if (is_kept_[t] != 0)
        mesh_.triangles[kept++] = mesh_.triangles[t];
    if (kept == mesh_.triangles.size ())
      return;
    mesh_.triangles.resize (kept);
    is_kept_.assign (kept, 1);
    mesh_.connect (mesh_.triangle_of.size (), run_);
  }

  TriangleMesh& mesh_;
  RunContext run_;
  std::vector<std::uint8_t> is_kept_; // of each triangle
  std::vector<Index> changed_;        // points that have lost a triangle; some more than once
  std::vector<Index> fan_;            // of the current point
};

} // namespace

bool
asksForTrimming (const TrimmingOptions& options)
{
  return options.maximum_edge_length > 0.0 || options.maximum_edge_ratio > 0.0 ||
         options.minimum_component_size > 0;
}

Trimming
trimMesh (TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
          const TrimmingOptions& options, const RunContext& run)
{
  Trimming done;
  const std::size_t triangles = mesh.triangles.size ();
  const std::vector<Index> before = mesh.triangle_of;
  Trimmer trimmer (mesh, run);
  trimmer.cutLongEdges (points, spacing, options);
  if (options.minimum_component_size > 0)
    done.components =
        trimmer.cutSmallComponents (static_cast<std::size_t> (options.minimum_component_size));
  done.triangles = triangles - mesh.triangles.size ();
  for (Index p = 0; p < before.size (); ++p)
    if (before[p] != NONE && mesh.triangle_of[p] == NONE)
      done.points.push_back (p);
  return done;
}

} // namespace floater
} // namespace pcl
