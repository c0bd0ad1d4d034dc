// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/charts.h"

#include <queue>
#include <tuple>
#include <unordered_map>

namespace pcl::floater {
namespace {
// Largest mean of 1 - cos of the angles to the mean normal of a chart, plus the costs of creases and of
// area that is turned away: half a sphere has 0.5, half a tube 0.36. More can hardly be flattened.
constexpr double DEVIATION = 0.5;

// The same for charts of more than LARGE triangles. A cap of 60 degrees of a sphere has 0.25: it can be
// projected, which is a good start for its layout. Without it, the layout takes ten times as long.
constexpr double DEVIATION_OF_LARGE = 0.25;
constexpr std::size_t LARGE = 1000;

// Cosine below which area counts as turned away from the mean normal of its chart: 80 degrees. And the
// cost of the share of such area, in deviations: a twentieth takes up half of the limit. A chart that
// hides a piece of itself cannot be projected.
constexpr double AWAY_COSINE = 0.17, AWAY_WEIGHT = 5.0;

// Cost of a crease of a right angle, in deviations: a quarter turn of one side adds as much as the
// deviation of two flat sides (1 - cos 45 degrees, 0.29), so joining two faces of a box exceeds 0.5.
constexpr double CREASE_WEIGHT = 0.25;

// Cost of a seam as long as the border of a disc of this area; decisive on flat surfaces only.
constexpr double SEAM_WEIGHT = 0.05;

// A chart with so few triangles, and with less than this share of the joint area, is joined to a
// neighbouring chart at the end, however it bends: alone it would waste space in the texture.
constexpr std::size_t MOST_IN_CRUMB = 16;
constexpr double CRUMB_SHARE = 0.1;

// Common border of two charts.
struct Contact
{
  double length = 0.0;  // of the seam between them
  double crease = 0.0;  // integral of 1 - cos of the angle across it
  double offered = 0.0; // last offered cost of joining them
};

constexpr std::size_t DIRECTIONS = 42;                // 30 degrees apart
using Histogram = Eigen::Array<float, DIRECTIONS, 1>; // of area over directions

struct Chart
{
  Histogram facing = Histogram::Zero (); // area by the direction that it faces
  Vector3d sum = Vector3d::Zero ();      // of the area vectors
  double area = 0.0;            // of its facets, each in its own plane, without its roughness
  double seam = 0.0;            // length of the seams around it
  std::size_t triangles = 0;    // how many
  std::vector<MeshEdge> border; // its boundary edges, and some that are inside now
  std::unordered_map<Index, Contact> contacts; // with the charts beside it
};

double
oneMinusCosine (const Vector3d& a, const Vector3d& b)
{
  const double lengths = std::sqrt (a.squaredNorm () * b.squaredNorm ());
  return lengths > 0.0 ? 1.0 - a.dot (b) / lengths : 0.0;
}

struct ChartMerger
{
  struct Offer
  {
    double cost;
    Index a, b; // a < b

    bool operator<(const Offer& other) const // the queue has the largest first
    {
      return std::tie (cost, a, b) > std::tie (other.cost, other.a, other.b);
    }
  };

  const TriangleMesh& mesh;
  const MeshComponents& facets;
  const ChartLimits& limits;
  std::array<Vector3d, DIRECTIONS> directions{};
  std::vector<Chart> charts = std::vector<Chart> (facets.count);
  // Per facet: chart that it was joined to, transitively.
  std::vector<Index> part_of = indicesBelow (facets.count);
  std::priority_queue<Offer> offers{};
  std::size_t left = facets.count; // number of charts
  bool is_for_crumbs = false;
  std::vector<Index> fan{};

  // Joins the facets; to be called once.
  MeshComponents merged (const Positions& positions, const std::vector<Vector3d>& area_vectors,
                         const RunContext& run)
  {
    for (std::size_t d = 0; d < DIRECTIONS; ++d)
      directions[d] = spiralDirection (d, DIRECTIONS);
    for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
      Chart& chart = charts[facets.of_triangle[t]];
      chart.sum += 0.5 * area_vectors[t];
      ++chart.triangles;
    }
    for (Chart& chart : charts) {
      chart.area = chart.sum.norm ();
      std::size_t nearest = 0;
      for (std::size_t d = 1; d < directions.size (); ++d)
        if (directions[d].dot (chart.sum) > directions[nearest].dot (chart.sum))
          nearest = d;
      chart.facing[static_cast<Eigen::Index> (nearest)] = static_cast<float> (chart.area);
    }
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const MeshEdge edge{t, side};
        const Index other = mesh.neighbors[t][side], own = facets.of_triangle[t];
        const Index beside = other == NONE ? NONE : facets.of_triangle[other];
        if (beside == own)
          continue;
        charts[own].border.push_back (edge);
        if (beside == NONE)
          continue;
        const double length = (positions[mesh.to (edge)] - positions[mesh.from (edge)]).norm ();
        Contact& contact = charts[own].contacts[beside];
        contact.length += length;
        contact.crease += length * oneMinusCosine (charts[own].sum, charts[beside].sum);
        charts[own].seam += length;
      }
    // At the end, crumbs that remain join the cheapest neighbour.
    for (const bool is_end : {false, true}) {
      is_for_crumbs = is_end;
      for (Index a = 0; a < charts.size (); ++a)
        for (const auto& [b, contact] : charts[a].contacts)
          offer (a, b);
      takeOffers (run);
    }
    MeshComponents parts = facets;
    for (Index& part : parts.of_triangle)
      part = find (part);
    return parts;
  }

  Index find (Index facet)
  {
    while (part_of[facet] != facet)
      facet = part_of[facet] = part_of[part_of[facet]];
    return facet;
  }

  Index chartOf (Index t) { return find (facets.of_triangle[t]); }

  // Deviation and creases.
  double bendOf (Index a, Index b) const
  {
    const Chart &one = charts[a], &other = charts[b];
    const double area = one.area + other.area;
    const Vector3d sum = one.sum + other.sum;
    const double deviation = area > 0.0 ? 1.0 - sum.norm () / area : 0.0;
    const Contact& contact = one.contacts.at (b);
    const double crease = contact.length > 0.0 ? contact.crease / contact.length : 0.0;
    const Histogram facing = one.facing + other.facing;
    const double level = AWAY_COSINE * sum.norm ();
    double away = 0.0; // area that is turned away from the sum
    for (std::size_t d = 0; d < directions.size (); ++d)
      if (directions[d].dot (sum) < level)
        away += static_cast<double> (facing[static_cast<Eigen::Index> (d)]);
    return deviation + CREASE_WEIGHT * crease + AWAY_WEIGHT * (area > 0.0 ? away / area : 0.0);
  }

  double costOf (Index a, Index b) const
  {
    const Chart &one = charts[a], &other = charts[b];
    const double area = one.area + other.area;
    const double seam = one.seam + other.seam - 2.0 * one.contacts.at (b).length;
    const double roundness = area > 0.0 ? seam / (2.0 * std::sqrt (PI * area)) : 0.0;
    return bendOf (a, b) + SEAM_WEIGHT * roundness;
  }

  bool isAllowed (Index a, Index b) const
  {
    const Chart &one = charts[a], &other = charts[b];
    const std::size_t triangles = one.triangles + other.triangles;
    if (triangles > limits.most_triangles)
      return false;
    if (limits.halves)
      return true;
    if (is_for_crumbs) {
      const Chart& small = one.area < other.area ? one : other;
      return small.triangles <= MOST_IN_CRUMB &&
             small.area <= CRUMB_SHARE * (one.area + other.area);
    }
    return bendOf (a, b) <= (triangles <= LARGE ? DEVIATION : DEVIATION_OF_LARGE);
  }

  void takeOffers (const RunContext& run)
  {
    ProgressLoop progress (run, charts.size ());
    while (!offers.empty () && left > (limits.halves ? 2U : 1U)) {
      const Offer offer = offers.top ();
      offers.pop ();
      // One of the charts was joined to another one, or there is a later offer for the two.
      const auto contact = charts[offer.a].contacts.find (offer.b);
      if (contact == charts[offer.a].contacts.end () || contact->second.offered != offer.cost)
        continue;
      // Charts have grown since then, which mostly raises the cost.
      if (costOf (offer.a, offer.b) > offer.cost)
        this->offer (offer.a, offer.b);
      else if (isAllowed (offer.a, offer.b) && makesDisc (offer.a, offer.b)) {
        join (offer.a, offer.b);
        --left;
        progress.next ();
      }
    }
    offers = {};
  }

  void offer (Index a, Index b)
  {
    const double cost = costOf (a, b);
    charts[a].contacts.at (b).offered = charts[b].contacts.at (a).offered = cost;
    offers.push ({cost, std::min (a, b), std::max (a, b)});
  }

  // Whether the union of two discs is a disc: their common border must be connected and not closed,
  // so it has one vertex more than edges. O(boundary of the shorter one).
  bool makesDisc (Index a, Index b)
  {
    if (charts[a].border.size () > charts[b].border.size ())
      std::swap (a, b);
    std::vector<MeshEdge>& border = charts[a].border;
    std::size_t points = 0, edges = 0, kept = 0;
    for (const MeshEdge edge : border) {
      const Index other = mesh.neighbors[edge.triangle][edge.side];
      const Index beyond = other == NONE ? NONE : chartOf (other);
      if (beyond == a)
        continue;
      border[kept++] = edge;
      edges += beyond == b ? 1 : 0;
      mesh.fan (mesh.from (edge), fan);
      if (std::any_of (fan.begin (), fan.end (), [&] (Index t) { return chartOf (t) == b; }))
        ++points;
    }
    border.resize (kept);
    return points == edges + 1;
  }

  // Joins the chart with fewer neighbours to the other one, which keeps its number.
  void join (Index a, Index b)
  {
    if (charts[a].contacts.size () > charts[b].contacts.size ())
      std::swap (a, b);
    part_of[a] = b;
    Chart small = std::move (charts[a]);
    charts[a] = {};
    Chart& large = charts[b];
    large.seam += small.seam - 2.0 * small.contacts.at (b).length;
    large.sum += small.sum;
    large.facing += small.facing;
    large.area += small.area;
    large.triangles += small.triangles;
    if (small.border.size () > large.border.size ())
      small.border.swap (large.border);
    large.border.insert (large.border.end (), small.border.begin (), small.border.end ());
    small.contacts.erase (b);
    large.contacts.erase (a);
    for (const auto& [c, contact] : small.contacts) {
      Contact& to = large.contacts[c];
      to.length += contact.length;
      to.crease += contact.crease;
      charts[c].contacts.erase (a);
      charts[c].contacts[b] = to;
    }
    for (const auto& [c, contact] : small.contacts)
      offer (b, c);
  }
};

// Straightens the seams (see findCharts). Charts stay discs, and none vanishes.
void
straightenSeams (const TriangleMesh& mesh, const Positions& positions,
                 const std::vector<Vector3d>& area_vectors, const RunContext& run,
                 MeshComponents& charts)
{
  // Weight of a seam along a sharp crease relative to one across a flat region: seams stay on creases.
  constexpr double LEAST_WEIGHT = 0.1;
  constexpr int ROUNDS_AT_MOST = 8; // it ends when nothing changes
  // Weight of a seam along an edge.
  const auto weight = [&] (MeshEdge edge) {
    const double length = (positions[mesh.to (edge)] - positions[mesh.from (edge)]).norm ();
    const Index other = mesh.neighbors[edge.triangle][edge.side];
    const double cosine = 1.0 - oneMinusCosine (area_vectors[edge.triangle], area_vectors[other]);
    return length * std::max (LEAST_WEIGHT, cosine);
  };
  std::vector<Index> fan;
  // Returns whether the triangle was moved.
  const auto tryMove = [&] (Index t) {
    const Index own = charts.of_triangle[t];
    std::uint8_t inner = 3; // the side towards the rest of its chart
    Index to = NONE;
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index other = mesh.neighbors[t][side];
      const Index beyond = other == NONE ? NONE : charts.of_triangle[other];
      if (beyond == own) {
        if (inner != 3)
          return false;
        inner = side;
      }
      else if (beyond == NONE || (to != NONE && to != beyond))
        return false;
      else
        to = beyond;
    }
    if (inner == 3 || to == NONE)
      return false;
    const double gain = weight ({t, TriangleMesh::next (inner)}) +
                        weight ({t, TriangleMesh::previous (inner)}) - weight ({t, inner});
    if (!(gain > 0.0))
      return false;
    // Without the triangle, its chart must not touch the corner that changes charts.
    mesh.fan (mesh.corner ({t, inner}), fan);
    for (const Index around : fan)
      if (around != t && charts.of_triangle[around] == own)
        return false;
    charts.of_triangle[t] = to;
    return true;
  };
  std::vector<Index> waiting;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (const Index other : mesh.neighbors[t])
      if (other != NONE && charts.of_triangle[other] != charts.of_triangle[t]) {
        waiting.push_back (t);
        break;
      }
  for (int round = 0; round < ROUNDS_AT_MOST && !waiting.empty (); ++round) {
    ProgressLoop progress (run, waiting.size ());
    std::vector<Index> next;
    for (const Index t : waiting) {
      if (tryMove (t))
        for (const Index other : mesh.neighbors[t])
          if (other != NONE)
            next.push_back (other);
      progress.next ();
    }
    waiting = std::move (next);
  }
}

} // namespace

MeshComponents
findCharts (const TriangleMesh& mesh, const Positions& positions, const ChartLimits& limits,
            const RunContext& run)
{
  const std::vector<Vector3d> area_vectors = areaVectors (mesh, positions, run);
  const MeshComponents facets = growFacets (mesh, positions, area_vectors, limits, run);
  MeshComponents charts = ChartMerger{mesh, facets, limits}.merged (positions, area_vectors, run);
  straightenSeams (mesh, positions, area_vectors, run, charts);
  // Numbers the charts in the order of their first triangles.
  std::vector<Index> number (charts.count, NONE);
  charts.count = 0;
  for (Index& chart : charts.of_triangle) {
    if (number[chart] == NONE)
      number[chart] = charts.count++;
    chart = number[chart];
  }
  return charts;
}

} // namespace pcl::floater
