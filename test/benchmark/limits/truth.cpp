// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "truth.h"

#include "core/geometry.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace pcl
{
namespace floater
{
namespace
{
Eigen::Vector3d
areaVectorOf (const Triangle& t, const std::vector<Eigen::Vector3d>& positions)
{
  return areaVector (positions[t[0]], positions[t[1]], positions[t[2]]);
}

double
areaOf (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& positions)
{
  double area = 0.0;
  for (const Triangle& t : triangles)
    area += 0.5 * areaVectorOf (t, positions).norm ();
  return area;
}

// Vertices within two edges of a loop.
std::vector<bool>
nearLoop (const BoundaryLoop& loop, const std::vector<Triangle>& triangles, std::size_t points)
{
  constexpr int EDGES = 2;
  std::vector<bool> near (points, false);
  for (const Index p : loop.points)
    near[p] = true;
  for (int step = 0; step < EDGES; ++step) {
    const std::vector<bool> before = near;
    for (const Triangle& t : triangles)
      if (before[t[0]] || before[t[1]] || before[t[2]])
        near[t[0]] = near[t[1]] = near[t[2]] = true;
  }
  return near;
}

// Each true loop takes the longest loop that matches it.
std::pair<std::size_t, std::size_t>
countUnmatched (const std::vector<BoundaryLoop>& loops, const Truth& truth)
{
  std::vector<bool> is_taken (truth.near_loops.size (), false);
  std::size_t spurious = 0;
  for (const BoundaryLoop& loop : loops) { // longest first
    std::size_t match = 0;
    for (; match < is_taken.size (); ++match) {
      const auto near = std::count_if (loop.points.begin (), loop.points.end (),
                                       [&] (Index p) { return truth.near_loops[match][p]; });
      if (!is_taken[match] && 2 * static_cast<std::size_t> (near) >= loop.points.size ())
        break;
    }
    if (match < is_taken.size ())
      is_taken[match] = true;
    else
      ++spurious;
  }
  return {spurious,
          static_cast<std::size_t> (std::count (is_taken.begin (), is_taken.end (), false))};
}

std::size_t
countInsideOut (const std::vector<Triangle>& triangles, const Truth& truth)
{
  TriangleMesh mesh;
  mesh.triangles = triangles;
  if (!mesh.connect (truth.points.size (), 1))
    return 0;
  const MeshComponents components = findComponents (mesh, 1);
  std::vector<double> agreement (components.count, 0.0);
  for (Index t = 0; t < triangles.size (); ++t) {
    const Triangle& corners = triangles[t];
    const Eigen::Vector3d normal =
        truth.normals[corners[0]] + truth.normals[corners[1]] + truth.normals[corners[2]];
    agreement[components.of_triangle[t]] +=
        normal.dot (areaVectorOf (corners, truth.points.positions));
  }
  return static_cast<std::size_t> (
      std::count_if (agreement.begin (), agreement.end (), [] (double sum) { return sum < 0.0; }));
}

} // namespace

Truth
readTruth (const std::filesystem::path& file)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName (file.c_str ());
  reader->Update ();
  vtkPolyData* const mesh = reader->GetOutput ();
  Truth truth;
  truth.name = file.filename ().string ();
  truth.name.resize (truth.name.find ('.'));
  const auto count = static_cast<std::size_t> (mesh->GetNumberOfPoints ());
  for (vtkIdType p = 0; p < mesh->GetNumberOfPoints (); ++p)
    truth.points.positions.emplace_back (mesh->GetPoint (p));
  truth.points.cloud_index.resize (count);
  std::iota (truth.points.cloud_index.begin (), truth.points.cloud_index.end (), Index{0});
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : truth.points.positions)
    box.extend (p);
  truth.points.diagonal = box.isEmpty () ? 1.0 : box.diagonal ().norm ();
  vtkCellArray* const polygons = mesh->GetPolys ();
  polygons->InitTraversal ();
  vtkIdType corners = 0;
  for (const vtkIdType* ids = nullptr; polygons->GetNextCell (corners, ids) != 0;)
    if (corners == 3)
      truth.triangles.push_back (
          {static_cast<Index> (ids[0]), static_cast<Index> (ids[1]), static_cast<Index> (ids[2])});
  if (truth.triangles.empty ())
    throw std::runtime_error (file.string () + " has no triangles");

  const std::vector<float> spacing (count, 1.0F); // not needed for the verdict
  truth.found = checkMesh (truth.triangles, truth.points, spacing, 1);
  for (const BoundaryLoop& loop : truth.found.loops)
    truth.near_loops.push_back (nearLoop (loop, truth.triangles, count));
  truth.area = areaOf (truth.triangles, truth.points.positions);
  truth.normals.assign (count, Eigen::Vector3d::Zero ());
  for (const Triangle& t : truth.triangles)
    for (const Index p : t)
      truth.normals[p] += areaVectorOf (t, truth.points.positions);
  return truth;
}

namespace
{
// Collects flaws in a few words each.
class Flaws
{
public:
  void note (bool is_flaw, const std::string& name)
  {
    if (is_flaw)
      text_ += (text_.empty () ? "" : ", ") + name;
  }

  std::string text () const { return text_; }

private:
  std::string text_;
};

std::string
counted (const char* name, std::int64_t have, std::int64_t want)
{
  return std::string (name) + " " + std::to_string (have) + " for " + std::to_string (want);
}

MeshExamination
examine (const std::vector<Triangle>& triangles, const Truth& truth)
{
  const std::vector<float> spacing (truth.points.size (), 1.0F);
  return checkMesh (triangles, truth.points, spacing, 1);
}

// \param share of the points that may be lost
bool
hasLostPoints (const MeshExamination& found, const Truth& truth, double share)
{
  const double unused =
      static_cast<double> (found.unused.size ()) - static_cast<double> (truth.found.unused.size ());
  return unused > share * static_cast<double> (truth.points.size ());
}

// \param share by which the area may differ
bool
hasOtherArea (const std::vector<Triangle>& triangles, const Truth& truth, double share)
{
  return std::abs (areaOf (triangles, truth.points.positions) / truth.area - 1.0) > share;
}

std::size_t
boundaryEdges (const MeshCheck& check)
{
  std::size_t edges = 0;
  for (const LoopSummary& loop : check.loops)
    edges += loop.points;
  return edges;
}

} // namespace

std::string
flawsOf (const std::vector<Triangle>& triangles, const Truth& truth)
{
  if (triangles.empty ())
    return "no mesh";
  const MeshExamination found = examine (triangles, truth);
  const MeshCheck &is = found.check, &should_be = truth.found.check;
  const auto [spurious, closed] = countUnmatched (found.loops, truth);
  Flaws flaws;
  flaws.note (hasLostPoints (found, truth, 0.001), "unused points");
  flaws.note (!found.isManifold (), "not manifold");
  flaws.note (spurious > 0, std::to_string (spurious) + " spurious loops");
  flaws.note (closed > 0, std::to_string (closed) + " true loops closed");
  flaws.note (is.components != should_be.components,
              counted ("components", static_cast<std::int64_t> (is.components),
                       static_cast<std::int64_t> (should_be.components)));
  flaws.note (
      is.euler_characteristic != should_be.euler_characteristic,
      counted ("Euler characteristic", is.euler_characteristic, should_be.euler_characteristic));
  flaws.note (is.folds > should_be.folds, counted ("folds", static_cast<std::int64_t> (is.folds),
                                                   static_cast<std::int64_t> (should_be.folds)));
  flaws.note (countInsideOut (triangles, truth) > 0, "inside out");
  flaws.note (hasOtherArea (triangles, truth, 0.01), "area");
  return flaws.text ();
}

std::string
flawsOfScan (const std::vector<Triangle>& triangles, const Truth& truth)
{
  if (triangles.empty ())
    return "no mesh";
  const MeshExamination found = examine (triangles, truth);
  const MeshCheck &is = found.check, &should_be = truth.found.check;
  const std::size_t edges = boundaryEdges (is), true_edges = boundaryEdges (should_be);
  Flaws flaws;
  flaws.note (hasLostPoints (found, truth, 0.01), "unused points");
  flaws.note (!found.isManifold (), "not manifold");
  flaws.note (is.components > 2 * should_be.components + 10,
              counted ("components", static_cast<std::int64_t> (is.components),
                       static_cast<std::int64_t> (should_be.components)));
  flaws.note (2 * edges > 3 * true_edges,
              counted ("boundary edges", static_cast<std::int64_t> (edges),
                       static_cast<std::int64_t> (true_edges)));
  flaws.note (is.folds > std::max (should_be.folds, triangles.size () / 2000),
              counted ("folds", static_cast<std::int64_t> (is.folds),
                       static_cast<std::int64_t> (should_be.folds)));
  flaws.note (hasOtherArea (triangles, truth, 0.05), "area");
  return flaws.text ();
}

} // namespace floater
} // namespace pcl
