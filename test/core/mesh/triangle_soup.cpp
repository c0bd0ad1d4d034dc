// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangle_soup.h"

#include "core/geometry.h"
#include "mesh/visibility.h"
#include "random_directions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace pcl::floater::facing_cases {
TriangleMesh
meshOf (const Soup& soup)
{
  TriangleMesh mesh;
  mesh.triangles = soup.triangles;
  if (!mesh.connect (soup.positions.size (), 1))
    throw std::logic_error ("a generated mesh is no oriented manifold");
  return mesh;
}

void
cutOut (Soup& soup, std::vector<std::uint8_t> is_out)
{
  for (;;) {
    std::vector<Triangle> left;
    for (std::size_t t = 0; t < soup.triangles.size (); ++t)
      if (is_out[t] == 0)
        left.push_back (soup.triangles[t]);
    soup.triangles = std::move (left);
    // A fan has as many beginnings, corners with no triangle before them, as it has ends: one or 0.
    std::vector<std::map<Index, int>> ends (soup.positions.size ());
    std::vector<int> degree (soup.positions.size (), 0);
    for (const Triangle& t : soup.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        ++ends[t[i]][t[(i + 1) % 3]];
        --ends[t[i]][t[(i + 2) % 3]];
        ++degree[t[i]];
      }
    std::vector<std::uint8_t> is_pinched (soup.positions.size (), 0);
    bool any = false;
    for (std::size_t p = 0; p < ends.size (); ++p) {
      const auto begins = std::count_if (ends[p].begin (), ends[p].end (),
                                         [] (const auto& end) { return end.second > 0; });
      is_pinched[p] = begins > 1 ? 1 : 0;
      any = any || begins > 1;
    }
    if (!any)
      return;
    is_out.assign (soup.triangles.size (), 0);
    for (std::size_t t = 0; t < soup.triangles.size (); ++t)
      for (const Index p : soup.triangles[t])
        is_out[t] |= is_pinched[p];
  }
}

double
areaOf (const Soup& soup, const Triangle& t)
{
  return areaVector (soup.positions[t[0]], soup.positions[t[1]], soup.positions[t[2]]).norm ();
}

void
dropSmall (Soup& soup, std::size_t least)
{
  const MeshComponents components = findComponents (meshOf (soup), 1);
  std::vector<std::size_t> sizes (components.count, 0);
  for (const Index c : components.of_triangle)
    ++sizes[c];
  if (least == 0)
    least = sizes.empty () ? 0 : *std::max_element (sizes.begin (), sizes.end ());
  std::vector<std::uint8_t> is_out;
  for (const Index c : components.of_triangle)
    is_out.push_back (sizes[c] < least ? 1 : 0);
  cutOut (soup, is_out);
}

void
cutWindows (Soup& soup, int windows, double share, RandomStream& random)
{
  const TriangleMesh mesh = meshOf (soup);
  double area = 0.0;
  for (const Triangle& t : soup.triangles)
    area += areaOf (soup, t);
  std::vector<std::uint8_t> is_out (soup.triangles.size (), 0);
  for (int w = 0; w < windows; ++w) {
    const auto seed = static_cast<Index> (random.below (soup.triangles.size ()));
    std::vector<std::uint8_t> is_seen (soup.triangles.size (), 0);
    std::vector<Index> ring{seed};
    is_seen[seed] = 1;
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size () && sum < share * area / windows; ++i) {
      is_out[ring[i]] = 1;
      sum += areaOf (soup, soup.triangles[ring[i]]);
      for (const Index u : mesh.neighbors[ring[i]])
        if (u != NONE && is_seen[u] == 0) {
          is_seen[u] = 1;
          ring.push_back (u);
        }
    }
  }
  cutOut (soup, is_out);
  dropSmall (soup, 0);
}

void
transform (Soup& soup, const Eigen::Matrix3d& matrix)
{
  for (Vector& p : soup.positions)
    p = matrix * p;
}

void
turnRound (Soup& soup)
{
  for (Triangle& t : soup.triangles)
    std::swap (t[1], t[2]);
}

void
append (Soup& soup, const Soup& more)
{
  const auto offset = static_cast<Index> (soup.positions.size ());
  soup.positions.insert (soup.positions.end (), more.positions.begin (), more.positions.end ());
  for (const Triangle& t : more.triangles)
    soup.triangles.push_back ({t[0] + offset, t[1] + offset, t[2] + offset});
}

Soup
grid (const std::function<Vector (double, double)>& shape, int columns, int rows, bool wraps)
{
  Soup soup;
  const int width = wraps ? columns : columns + 1;
  for (int v = 0; v <= rows; ++v)
    for (int u = 0; u < width; ++u)
      soup.positions.push_back (
          shape (static_cast<double> (u) / columns, static_cast<double> (v) / rows));
  const auto at = [&] (int u, int v) { return static_cast<Index> (v * width + u % width); };
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u) {
      soup.triangles.push_back ({at (u, v), at (u + 1, v), at (u + 1, v + 1)});
      soup.triangles.push_back ({at (u, v), at (u + 1, v + 1), at (u, v + 1)});
    }
  return soup;
}

void
keepSeen (Soup& soup, const Vector& direction)
{
  const TriangleRays rays (soup.triangles, soup.positions, 1);
  std::vector<std::uint8_t> is_out (soup.triangles.size (), 0);
  for (Index t = 0; t < soup.triangles.size (); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const std::vector<Vector>& p = soup.positions;
    const Vector normal = areaVector (p[a], p[b], p[c]).normalized ();
    const Vector middle = (p[a] + p[b] + p[c]) / 3.0;
    bool is_hidden = normal.dot (direction) < 0.1; // grazing rays return nothing
    if (!is_hidden)
      rays.forHits (middle, direction,
                    [&] (Index other, double) { return is_hidden = other != t; });
    is_out[t] = is_hidden ? 1 : 0;
  }
  cutOut (soup, is_out);
  dropSmall (soup, 0);
}

void
cutBelow (Soup& soup, const Vector& direction, double level)
{
  std::vector<std::uint8_t> is_out;
  for (const Triangle& t : soup.triangles) {
    const bool is_below = std::any_of (
        t.begin (), t.end (), [&] (Index p) { return soup.positions[p].dot (direction) < level; });
    is_out.push_back (is_below ? 1 : 0);
  }
  cutOut (soup, is_out);
  dropSmall (soup, 0);
}

void
tear (Soup& soup, int cuts, double width, RandomStream& random)
{
  Eigen::AlignedBox3d box;
  for (const Triangle& t : soup.triangles)
    for (const Index p : t)
      box.extend (soup.positions[p]);
  std::vector<std::uint8_t> is_out (soup.triangles.size (), 0);
  for (int i = 0; i < cuts; ++i) {
    const Vector normal = randomDirection (random);
    const Vector place =
        box.center () + 0.3 * box.sizes ().cwiseProduct (Vector (between (random, -1.0, 1.0),
                                                                 between (random, -1.0, 1.0), 0.0));
    for (std::size_t t = 0; t < soup.triangles.size (); ++t)
      for (const Index p : soup.triangles[t])
        if (std::abs (normal.dot (soup.positions[p] - place)) < 0.5 * width)
          is_out[t] = 1;
  }
  cutOut (soup, is_out);
  dropSmall (soup, 10);
}

void
cutCones (const std::vector<Soup*>& walls, int windows, RandomStream& random)
{
  std::vector<Vector> axes;
  for (int i = 0; i < windows; ++i)
    axes.push_back (randomDirection (random));
  const double cosine = std::cos (between (random, 5.0, 25.0) * DEGREE);
  for (Soup* wall : walls) {
    std::vector<std::uint8_t> is_out;
    for (const Triangle& t : wall->triangles) {
      const Vector middle = wall->positions[t[0]].normalized ();
      const bool is_cut = std::any_of (axes.begin (), axes.end (),
                                       [&] (const Vector& a) { return a.dot (middle) > cosine; });
      is_out.push_back (is_cut ? 1 : 0);
    }
    cutOut (*wall, is_out);
    dropSmall (*wall, 0);
  }
}

} // namespace pcl::floater::facing_cases
