// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/findings.h"
#include "report/report_mesh.h"

namespace pcl::floater {
namespace {
// Up to which share a mesh is good, and from which on it is poor; above 1, it is never poor by this
// alone. Right meshes of generated bodies have no crossing pair; with noise of half a spacing, most
// thin and sharp ones have one in 20 triangles. Of 37 generated scans without enough area, or of
// many parts or folds, 30 leave 2 % of the view open or 0.2 % of the points out; 32 of 123 other
// scans do so as well. The other bounds are chosen by hand.
struct Bounds
{
  double good, poor;
};
constexpr Bounds CROSSING{0.0001, 0.05}; // crossing pairs for each triangle
constexpr Bounds FOLDS{0.05, 2.0}; // for each triangle of a view; 0.015 for noisy depth cameras
constexpr Bounds OPEN{0.02, 2.0};  // share of the triangles of a view that are left open
constexpr Bounds AREA{0.25, 0.5};  // share in the largest 1 % of triangles; 4 % with noise
// The same of a view: 14 % in rooms. Of 64 wrong scans 10 were good without this, and 2 are with it.
constexpr Bounds AREA_OF_VIEW{0.25, 2.0};
constexpr Bounds UNUSED{0.002, 0.1};      // share of the points without a triangle
constexpr Bounds SCATTER{0.05, 0.6};      // share of the points on no surface
constexpr Bounds OUTLIERS{0.002, 0.5};    // share of the points off any surface
constexpr Bounds NOISE{0.1, 2.0};         // share of points projected
constexpr Bounds LONG_EDGES{0.002, 0.05}; // long edges for each triangle

// Why a mesh is no better, and what helps.
using Reason = std::pair<std::string, std::string>;

// Two digits: "1.8 %", "12 %".
std::string
percent (double share)
{
  const double value = 100.0 * share;
  const double digits = value < 10.0 ? 10.0 : 1.0;
  return rounded (std::round (digits * value) / digits) + " %";
}

const Finding*
find (const Report& report, FindingId id)
{
  const auto found = std::find_if (report.findings.begin (), report.findings.end (),
                                   [id] (const Finding& finding) { return finding.id == id; });
  return found == report.findings.end () ? nullptr : &*found;
}

constexpr const char* LEAVE_OUT = "leave them out: --scatter drop";

Reason
noisy (const Statistics& statistics)
{
  return {"the points are noisy (90 % of them by less than " +
              rounded (statistics.noise_quantile_90) + " local spacings)",
          "thin the cloud with a voxel grid several times as wide as the noise, smooth it "
          "(pcl::MovingLeastSquares), or take a method that smooths, such as Poisson"};
}

// Whether points on no surface are in the mesh nevertheless.
bool
keepsScatter (const Report& report)
{
  const Statistics& statistics = report.statistics;
  const std::size_t left_out = statistics.non_finite_points + statistics.duplicate_points +
                               statistics.outlier_points + report.scatter.size ();
  return statistics.working_points + left_out > statistics.selected_points;
}

// Why triangles cross.
Reason
whyCrossing (const Report& report, double points)
{
  constexpr double COARSE_STEP = 0.2; // of the coordinates, in local spacings, that explains flaws
  constexpr double MANY = 0.02; // share of stacked, noisy or scattered points that explains flaws
  const Statistics& statistics = report.statistics;
  if (statistics.coordinate_step > COARSE_STEP)
    return {"the coordinates are coarse: their step is " + rounded (statistics.coordinate_step) +
                " of the local spacing",
            find (report, FindingId::COORDINATES_IN_FLOAT) != nullptr
                ? "subtract an origin before coordinates are stored in 32 bits (--shift)"
                : "store the coordinates with more digits"};
  const auto stacked = static_cast<double> (statistics.stacked_points);
  const auto projected = static_cast<double> (statistics.projected_points);
  const auto scattered = keepsScatter (report) ? static_cast<double> (report.scatter.size ()) : 0.0;
  const double most = std::max ({stacked, projected, scattered, MANY * points});
  if (stacked == most)
    return {"points lie on one another, such as in overlapping scans",
            "thin the cloud with a voxel grid of about half the spacing"};
  if (projected == most)
    return noisy (statistics);
  if (scattered == most)
    return {"points lie on no surface, such as leaves", LEAVE_OUT};
  return {"sheets of the surface come closer to each other than their points",
          "scan more densely there; --open-crossings cuts such triangles off"};
}

} // namespace

Verdict
judge (const Report& report)
{
  Verdict verdict;
  verdict.value = Quality::GOOD;
  double excess = 0.0;
  const auto measure = [&] (double share, const Bounds& bounds, const Reason& reason) {
    const Quality quality = share >= bounds.poor  ? Quality::POOR
                            : share > bounds.good ? Quality::USABLE
                                                  : Quality::GOOD;
    const double beyond = share / bounds.good;
    if (quality == Quality::GOOD || quality < verdict.value ||
        (quality == verdict.value && beyond <= excess))
      return;
    excess = beyond;
    verdict = {quality, reason.first, reason.second};
  };
  const Statistics& statistics = report.statistics;
  const auto triangles = static_cast<double> (std::max<std::size_t> (1, statistics.triangles));
  const auto points = static_cast<double> (std::max<std::size_t> (1, statistics.working_points));
  const auto share = [] (std::size_t count, double of) { return static_cast<double> (count) / of; };
  const auto shareWith = [] (std::size_t count, double others) { // of all, these included
    return static_cast<double> (count) / (others + static_cast<double> (count));
  };
  const std::size_t pairs = report.check.self_intersections;
  const bool has_more = report.check.has_more_self_intersections;
  const double crossing = std::max (share (pairs, triangles), has_more ? CROSSING.poor : 0.0);
  const auto [why, remedy] = whyCrossing (report, points);
  measure (crossing, CROSSING,
           {(has_more ? "more than " : "") +
                counted (pairs, "pair of triangles crosses", "pairs of triangles cross") +
                ", one for each " + rounded (std::ceil (1.0 / std::max (crossing, CROSSING.good))) +
                " triangles, since " + why,
            remedy});
  measure (report.is_view ? share (report.check.folds, triangles) : 0.0, FOLDS,
           {counted (report.check.folds, "edge is folded", "edges are folded") +
                ", since the points are noisy along the rays",
            "smooth the cloud (pcl::MovingLeastSquares), or thin it with a voxel grid several "
            "times as wide as the noise"});
  const double open = shareWith (statistics.view_steps + statistics.view_gaps, triangles);
  measure (open, OPEN,
           {percent (open) + " of the view is open, at depth steps and where rays are missing",
            "scan from another place as well: what is hidden or seen edge-on from here stays "
            "open"});
  const double area = report.check.largest_area_share;
  measure (area, report.is_view ? AREA_OF_VIEW : AREA,
           {percent (area) + " of the area is in 1 % of the triangles, " +
                (report.is_view ? "far from the sensor or seen edge-on"
                                : "since far or sparse points are joined to the rest"),
            report.is_view ? "scan from another place as well: what continues there and what is a "
                             "step is uncertain"
                           : "cut off triangles with long edges: --max-edge-ratio 8"});
  const double unused = share (report.unused.size (), points);
  measure (unused, UNUSED,
           {percent (unused) + " of the points are in no triangle",
            report.is_view ? "give the place of the sensor, or --viewpoint none"
                           : "look at them (points of Report::unused): the sampling is too thin "
                             "there, or they are no surface"});
  const bool is_kept = keepsScatter (report);
  const double scatter =
      is_kept ? share (report.scatter.size (), points) : shareWith (report.scatter.size (), points);
  measure (
      scatter, SCATTER,
      {percent (scatter) + " of the points lie on no surface, such as leaves or far background",
       is_kept ? LEAVE_OUT : "cut them out of the cloud, or keep them with --scatter keep"});
  const double outliers = shareWith (report.outliers.size (), points);
  measure (outliers, OUTLIERS,
           {percent (outliers) + " of the points lie off any surface" +
                (report.is_view ? ", alone between rays that miss it" : "") + ", and were left out",
            "look at them (points of Report::outliers); --remove-outliers off keeps them"});
  measure (share (statistics.projected_points, points), NOISE, noisy (statistics));
  const Finding* const long_edges = find (report, FindingId::LONG_EDGES);
  measure ((long_edges != nullptr ? long_edges->numbers.at (0) : 0.0) / triangles, LONG_EDGES,
           {"edges inside are much longer than the spacing: the sampling is too sparse there, or a "
            "gap was filled",
            "more points there, or --max-edge-ratio 8"});
  const auto flag = [&] (std::initializer_list<FindingId> ids, const Reason& reason) {
    const bool is_raised = std::any_of (
        ids.begin (), ids.end (), [&] (FindingId id) { return find (report, id) != nullptr; });
    measure (is_raised ? 1.0 : 0.0, {0.5, 2.0}, reason);
  };
  flag ({FindingId::SPARSE_SHAPE},
        {"the points are too few for the shape, so that parts may be joined or cut off",
         "more points: a part needs some across its thinnest place, and gaps be wider than the "
         "spacing"});
  flag ({FindingId::NO_AREA}, {"triangles have no area, since points lie on one line",
                               "remove points from straight edges"});
  const FindingId small = report.is_view ? FindingId::DEEP_HOLES : FindingId::SMALL_HOLES;
  flag ({FindingId::DEEP_HOLES, small},
        {"holes stay open where the sampling may be thin", "--holes close-all closes them"});
  flag ({FindingId::ONE_SIDED}, {"the surface was cut open, since it seems one-sided",
                                 "look at the cut: thin sheets may be joined there"});
  flag ({FindingId::GUESSED_OUTSIDE, FindingId::GUESSED_UP, FindingId::GUESSED_TOWARDS_VIEW,
         FindingId::GUESSED_FRONT},
        {"which side is the front is a guess",
         "give the place of the sensor (--viewpoint), or choose --facing"});
  return verdict;
}

double
largestAreaShare (const std::vector<Triangle>& triangles, const Positions& positions)
{
  std::vector<float> areas;
  areas.reserve (triangles.size ());
  for (const Triangle& t : triangles)
    areas.push_back (static_cast<float> (areaVectorOf (t, positions).norm ()));
  const double all = std::accumulate (areas.begin (), areas.end (), 0.0);
  const auto largest = areas.begin () + areas.size () / 100;
  std::nth_element (areas.begin (), largest, areas.end (), std::greater<> ());
  const double of_largest = std::accumulate (areas.begin (), largest, 0.0);
  return all > 0.0 ? of_largest / all : 0.0;
}

} // namespace pcl::floater
