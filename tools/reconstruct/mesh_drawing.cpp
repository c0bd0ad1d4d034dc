// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "html_report.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "local/planes.h"
#include "mesh/fold_repair.h"
#include "mesh/self_intersections.h"
#include "points/neighbors.h"

#include <pcl/surface/floater/vertex_normals.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace pcl::floater {
Eigen::AlignedBox3d
boxAround (const std::vector<Eigen::Vector3d>& positions)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : positions)
    box.extend (position);
  return box;
}

namespace {
/// The positions of the vertices of triangles, which are renumbered in their order.
/// \param points number of points; corners are below
template <typename Position>
std::vector<Eigen::Vector3d>
takeVertices (std::size_t points, const Position& positionOf, Triangles& triangles)
{
  std::vector<Index> number (points, NONE);
  std::vector<Eigen::Vector3d> positions;
  for (Triangle& triangle : triangles)
    for (Index& p : triangle) {
      if (number[p] == NONE) {
        number[p] = static_cast<Index> (positions.size ());
        positions.push_back (positionOf (p));
      }
      p = number[p];
    }
  return positions;
}

/// The height of each vertex above the mean of those that it is connected to, in spacings.
std::vector<float>
heights (const Drawing& drawing, int threads)
{
  const std::vector<Eigen::Vector3f> normals =
      vertexNormals (drawing.positions, drawing.triangles, threads);
  std::vector<double> sums (normals.size ());
  std::vector<std::uint32_t> terms (normals.size ());
  for (const Triangle& triangle : drawing.triangles)
    for (std::size_t c = 0; c < 3; ++c)
      for (const std::size_t other : {(c + 1) % 3, (c + 2) % 3}) {
        const Index p = triangle[c];
        sums[p] += normals[p].cast<double> ().dot (drawing.positions[triangle[other]] -
                                                   drawing.positions[p]);
        ++terms[p];
      }
  std::vector<float> result;
  for (std::size_t p = 0; p < sums.size (); ++p)
    if (drawing.spacing[p] > 0.0F)
      result.push_back (
          static_cast<float> (std::abs (sums[p]) / (terms[p] * double (drawing.spacing[p]))));
  return result;
}

/// How often a run has found something.
std::size_t
timesFound (const Report& report, FindingId id)
{
  for (const Finding& finding : report.findings)
    if (finding.id == id)
      return static_cast<std::size_t> (finding.numbers.at (0));
  return 0;
}

/// The flaws that the report counts. It has places of some only, so they are found again; of long
/// edges and of triangles without area, the worst ones.
std::vector<Flaw>
findFlaws (const TriangleMesh& mesh, const Drawing& drawing, const Report& report,
           const RunContext& run)
{
  const std::vector<Eigen::Vector3d>& positions = drawing.positions;
  Flaw crossing{"crossing", {}}, folds{"folded", {}}, flat{"flat", {}}, far{"long", {}};
  const auto addSides = [&mesh] (MeshEdge edge, Flaw& flaw) {
    flaw.triangles.insert (flaw.triangles.end (), {edge.triangle, mesh.mate (edge).triangle});
  };
  if (report.check.self_intersections > 0)
    for (const CrossingPair& pair : findSelfIntersections (mesh.triangles, positions, run))
      crossing.triangles.insert (crossing.triangles.end (), {pair.first, pair.second});
  for (const MeshEdge edge : findFolds (mesh, positions, run))
    addSides (edge, folds);

  using Rated = std::pair<double, MeshEdge>; // the larger, the worse
  std::vector<Rated> edges, triangles;
  const std::size_t long_edges = timesFound (report, FindingId::LONG_EDGES);
  const std::size_t without_area = report.check.degenerate_triangles;
  constexpr double FAR = 2.0, FLAT = 0.01; // others are none of them for sure
  for (Index t = 0; t < mesh.triangles.size () && long_edges + without_area > 0; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    double longest = 0.0;
    for (const std::uint8_t side : {0, 1, 2}) {
      const MeshEdge edge{t, side};
      const Index from = mesh.from (edge), to = mesh.to (edge), other = mesh.mate (edge).triangle;
      const double length = (positions[to] - positions[from]).norm ();
      const double spacing = 0.5 * (drawing.spacing[from] + drawing.spacing[to]);
      longest = std::max (longest, length);
      if (other != NONE && other > t && length > FAR * spacing)
        edges.emplace_back (length / spacing, edge);
    }
    const double height = areaVector (positions[a], positions[b], positions[c]).norm () / longest;
    if (!(height >= FLAT * longest))
      triangles.emplace_back (-height, MeshEdge{t, 0});
  }
  const auto takeWorst = [] (std::vector<Rated>& rated, std::size_t count, const auto& take) {
    count = std::min (count, rated.size ());
    std::partial_sort (rated.begin (), rated.begin () + static_cast<std::ptrdiff_t> (count),
                       rated.end (), [] (const Rated& a, const Rated& b) {
                         return a.first != b.first ? a.first > b.first
                                                   : a.second.triangle < b.second.triangle;
                       });
    for (std::size_t i = 0; i < count; ++i)
      take (rated[i].second);
  };
  takeWorst (edges, long_edges, [&] (MeshEdge edge) { addSides (edge, far); });
  takeWorst (triangles, without_area,
             [&flat] (MeshEdge edge) { flat.triangles.push_back (edge.triangle); });
  std::vector<Flaw> flaws{std::move (crossing), std::move (folds), std::move (flat),
                          std::move (far)};
  for (Flaw& flaw : flaws)
    sortUnique (flaw.triangles);
  return flaws;
}

/// Joins the vertices within the cells of a grid that is just wide enough, but those of flaws.
void
thin (Drawing& drawing, std::size_t most)
{
  std::vector<Index> flawed;
  for (const Flaw& flaw : drawing.flaws)
    flawed.insert (flawed.end (), flaw.triangles.begin (), flaw.triangles.end ());
  sortUnique (flawed);
  std::vector<std::uint8_t> stays (drawing.positions.size ());
  for (const Index t : flawed)
    for (const Index p : drawing.triangles[t])
      stays[p] = 1;
  const Box box = boxAround (drawing.positions);
  constexpr double CELLS = 1 << 20, GROWTH = 1.2;
  const double widest = box.sizes ().maxCoeff ();
  const double too_many = static_cast<double> (drawing.triangles.size ()) / double (most);
  const double narrowest =
      std::max ({drawing.median_spacing * std::sqrt (too_many) / GROWTH, widest / CELLS, 1e-300});
  double cell = narrowest;
  std::vector<Index> joined (stays.size ());
  Triangles kept;
  std::vector<Index> number; // of each triangle among those kept
  do {
    cell *= GROWTH;
    if (cell > widest && drawing.has_all_flaws) { // there are too many
      drawing.has_all_flaws = false;
      std::fill (stays.begin (), stays.end (), std::uint8_t{0});
      cell = narrowest;
    }
    std::unordered_map<std::uint64_t, Index> first;
    for (Index p = 0; p < joined.size (); ++p) {
      std::uint64_t key = 0;
      for (int axis = 0; axis < 3; ++axis)
        key = key << 21U |
              static_cast<std::uint64_t> ((drawing.positions[p][axis] - box.min ()[axis]) / cell);
      joined[p] = stays[p] != 0 ? p : first.try_emplace (key, p).first->second;
    }
    kept.clear ();
    number.assign (drawing.triangles.size (), NONE);
    for (std::size_t t = 0; t < number.size (); ++t) {
      Triangle triangle = drawing.triangles[t];
      for (Index& p : triangle)
        p = joined[p];
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
        continue;
      number[t] = static_cast<Index> (kept.size ());
      kept.push_back (triangle);
    }
  } while (kept.size () > most);
  for (Flaw& flaw : drawing.flaws) {
    for (Index& t : flaw.triangles)
      t = number[t];
    flaw.triangles.erase (std::remove (flaw.triangles.begin (), flaw.triangles.end (), NONE),
                          flaw.triangles.end ());
  }
  drawing.positions = takeVertices (
      joined.size (), [&drawing] (Index p) { return drawing.positions[p]; }, kept);
  drawing.triangles = std::move (kept);
}

} // namespace

Drawing
makeDrawing (const CommandLine& line, const Cloud& cloud, const Result& result)
{
  Drawing drawing;
  if (result.triangles.empty ())
    return drawing;
  drawing.triangles = result.triangles;
  drawing.positions = takeVertices (
      cloud.size (), [&cloud] (Index p) { return cloud.position (p); }, drawing.triangles);
  const Eigen::AlignedBox3d box = boxAround (drawing.positions);
  drawing.centre = box.center ();
  if (const double size = box.sizes ().maxCoeff (); size > 0.0)
    drawing.unit = std::ldexp (1.0, std::ilogb (size));
  for (Eigen::Vector3d& position : drawing.positions)
    position = (position - drawing.centre) / drawing.unit;
  constexpr int NEAREST = 6; // that localSpacing takes
  const RunContext run (std::max (line.options.threads, 0));
  drawing.spacing = localSpacing (
      drawing.positions,
      findNearestNeighbors (drawing.positions, Rows::all (drawing.positions.size ()), NEAREST, run),
      run);
  std::vector<float> spacing = drawing.spacing;
  drawing.median_spacing = median (spacing);
  drawing.height = heights (drawing, line.options.threads);
  TriangleMesh mesh;
  mesh.triangles = drawing.triangles;
  if (mesh.connect (drawing.positions.size (), run))
    drawing.flaws = findFlaws (mesh, drawing, result.report, run);
  if (drawing.triangles.size () > line.shown_triangles)
    thin (drawing, line.shown_triangles);
  return drawing;
}

} // namespace pcl::floater
