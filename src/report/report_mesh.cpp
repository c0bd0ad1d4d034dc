// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_mesh.h"

#include "core/order_statistics.h"
#include "report/findings.h"

namespace pcl::floater {
namespace {
// Thresholds for warnings. They do not change the mesh.
constexpr double LONG_STEP = 8.0;      // spacings: of an edge of the boundary loop
constexpr double SMALL_HOLE = 6.0;     // spacings: wider holes may belong to the surface
constexpr std::size_t FEW_POINTS = 50; // points of a small component, while ...
constexpr std::size_t TINY_SHARE = 20; // ... another one has this many times as many
// Share of edges bent by more than 60 degrees. Of generated thin and sharp bodies it was up to 0.058, of 66
// public models that came out right up to 0.053, of those with parts that were joined or cut off by mistake
// 0.064 to 0.32. A cube of n points has 1.6 / sqrt (n), a plate 1.9: such edges are few in large clouds.
constexpr double BENT_SHARE = 0.06, BENT_BY_SHAPE = 2.0;
constexpr std::size_t FEWEST_BENT = 100; // points; a body of few may be all sharp: an octahedron
// Noisy and stacked points bend edges, too: they may be one in so many.
constexpr std::size_t NOISY_OR_STACKED = 10;

void
findShape (const Points& points, const MeshExamination& found, Report& report)
{
  const MeshCheck& check = found.check;
  if (check.folds > 0)
    addFinding (report, FindingId::FOLDS, points, {found.figures.folds.at}, check.folds,
                report.denoised ? 1 : 0);
  if (check.self_intersections > 0 || check.has_more_self_intersections)
    addFinding (report, FindingId::CROSSING_TRIANGLES, points, {found.crossing_at},
                check.self_intersections, report.denoised ? 1 : 0,
                check.has_more_self_intersections ? 1 : 0);
  const auto vertices = static_cast<double> (points.size () - found.unused.size ());
  const auto edges = static_cast<double> (std::max<std::size_t> (1, found.figures.edges));
  const double bent_share = static_cast<double> (found.figures.bent) / edges;
  const Statistics& statistics = report.statistics;
  const std::size_t unclear = statistics.projected_points + statistics.stacked_points;
  if (!report.is_view && unclear <= statistics.working_points / NOISY_OR_STACKED &&
      points.size () >= FEWEST_BENT && bent_share > BENT_SHARE &&
      bent_share > BENT_BY_SHAPE / std::sqrt (vertices))
    addFinding (report, FindingId::SPARSE_SHAPE, points, {}, 100.0 * bent_share);
  const LongEdge& longest = found.figures.longest_inside;
  if (found.figures.long_edges.count > 0)
    addFinding (report, FindingId::LONG_EDGES, points, {longest.at.first, longest.at.second},
                found.figures.long_edges.count, std::sqrt (longest.sqr_length));
  if (check.degenerate_triangles > 0)
    addFinding (report, FindingId::NO_AREA, points, {found.figures.degenerate.at},
                check.degenerate_triangles);
  if (found.smallest_component < FEW_POINTS &&
      found.largest_component > TINY_SHARE * found.smallest_component)
    addFinding (report, FindingId::SMALL_COMPONENT, points, {found.smallest_component_at},
                check.components, found.smallest_component);
}

// Nothing is said if the user chose the holes, or asked to cut edges or crossings: holes are expected.
void
findHoles (const Points& points, const MeshExamination& found, const Options& options,
           Report& report)
{
  const bool close_all = options.holes.policy == HolePolicy::CLOSE_ALL;
  if (options.topology == Topology::DISC ||
      (!close_all && options.holes.policy != HolePolicy::AUTO) ||
      options.trimming.maximum_edge_length > 0.0 || options.trimming.maximum_edge_ratio > 0.0 ||
      options.trimming.open_self_intersections)
    return;
  // Small: not wide, and of far fewer points than the border of a round disc has: 3.5 sqrt (n).
  const auto isSmall = [] (const LoopSummary& loop, std::size_t component_points) {
    return loop.width_spacings < SMALL_HOLE && loop.points * loop.points < component_points;
  };
  std::size_t holes = 0, largest = 0;
  for (std::size_t i = found.loops.size (); i-- > 0;)
    if (close_all ||
        isSmall (found.check.loops[i], found.component_points[found.loops[i].component])) {
      ++holes;
      largest = i;
    }
  if (holes == 0)
    return;
  addFinding (report, close_all ? FindingId::HOLES_LEFT_OPEN : FindingId::SMALL_HOLES, points,
              {found.loops[largest].points.front ()}, holes, found.loops[largest].points.size ());
}

// "2 components, 3 boundary loops", "closed, genus 4", "one disc".
std::string
inFewWords (const MeshCheck& check)
{
  std::string text = check.components > 1 ? std::to_string (check.components) + " components" : "";
  const auto add = [&text] (const std::string& more) {
    text += (text.empty () ? "" : ", ") + more;
  };
  if (check.loops.empty ())
    add ("closed");
  else if (check.loops.size () > 1)
    add (std::to_string (check.loops.size ()) + " boundary loops");
  if (check.genus > 0)
    add ("genus " + std::to_string (check.genus));
  return text.empty () ? "one disc" : text;
}

void
reportUnused (const Points& points, const MeshExamination& found, Report& report)
{
  for (const Index p : found.unused)
    if (!std::binary_search (report.outliers.begin (), report.outliers.end (),
                             points.cloud_index[p]))
      report.unused.push_back (points.cloud_index[p]);
  std::sort (report.unused.begin (), report.unused.end ());
  report.statistics.used_points = points.size () - found.unused.size ();
  if (report.unused.empty ())
    return;
  const auto first = std::find_if (found.unused.begin (), found.unused.end (), [&] (Index p) {
    return points.cloud_index[p] == report.unused.front ();
  });
  addFinding (report, FindingId::UNUSED_POINTS, points, {*first}, report.unused.size ());
}

// The limits that cut off all triangles, each with the value that it was compared with.
std::string
whyNothingIsLeft (const Trimming& trimming, const TrimmingOptions& options)
{
  std::string limits;
  const auto add = [&limits] (bool is_asked_for, const std::string& limit) {
    if (is_asked_for)
      limits += (limits.empty () ? "" : ", ") + limit;
  };
  add (options.maximum_edge_length > 0.0,
       "edges longer than " + rounded (options.maximum_edge_length) + " units of the cloud");
  add (options.maximum_edge_ratio > 0.0,
       "edges longer than " + rounded (options.maximum_edge_ratio) + " local spacings");
  add (options.open_self_intersections, "crossing triangles");
  add (options.minimum_component_size > 0,
       "components of fewer than " + std::to_string (options.minimum_component_size) + " points");
  return "no triangle is left: " +
         counted (trimming.triangles, "triangle was", "triangles, all that there were, were") +
         " cut off as asked for (" + limits +
         "); allow longer edges or smaller components, and look whether lengths are in the unit of "
         "the cloud";
}

constexpr std::size_t TINY_OBJECT = 20; // a tiny part has one in so many triangles of the mesh
constexpr double SURE_FACING = 0.9;     // confidence; lower ones are reported
constexpr double GUESSED_FACING = 0.6;  // confidence; a warning below

// Some parts of the mesh.
struct Pieces
{
  std::size_t count = 0, triangles = 0;
  const FacingObject* largest = nullptr;

  void add (const FacingObject& object)
  {
    ++count;
    triangles += object.triangles;
    if (largest == nullptr || object.triangles > largest->triangles)
      largest = &object;
  }
};

FindingId
guessOf (Facing wanted)
{
  if (wanted == Facing::OUTWARDS || wanted == Facing::INWARDS)
    return FindingId::GUESSED_OUTSIDE;
  if (wanted == Facing::UP)
    return FindingId::GUESSED_UP;
  return wanted == Facing::VIEWPOINT ? FindingId::GUESSED_TOWARDS_VIEW : FindingId::GUESSED_FRONT;
}

FindingId
findingOf (FacingMiss miss, Facing wanted)
{
  if (miss == FacingMiss::CONTRADICTION)
    return FindingId::NORMALS_CONTRADICT;
  if (miss == FacingMiss::NO_NORMALS)
    return FindingId::NORMALS_MISSING;
  return wanted == Facing::UP ? FindingId::CLOSED_HAS_NO_UP : FindingId::VIEWPOINT_OUTSIDE;
}

// Reports the front of each part. Warns of guesses, and where the requested rule did not decide.
void
reportFacing (const Points& points, const MeshFacing& facing, Facing wanted, Report& report)
{
  std::size_t triangles = 0;
  for (const FacingObject& object : facing.objects)
    triangles += object.triangles;
  Pieces guessed;
  std::array<Pieces, static_cast<std::size_t> (FacingMiss::COUNT)> missed;
  for (const FacingObject& object : facing.objects) {
    ++report.facing_parts[static_cast<std::size_t> (object.rule)];
    report.facing_certainty = std::min (report.facing_certainty, object.certainty);
    if (object.miss != FacingMiss::NOTHING)
      missed[static_cast<std::size_t> (object.miss)].add (object);
    if (object.certainty >= SURE_FACING)
      continue;
    report.facing_decisions.push_back (
        {object.triangles, points.cloud_index[object.at], object.rule, object.certainty});
    if (object.certainty < GUESSED_FACING && TINY_OBJECT * object.triangles >= triangles)
      guessed.add (object);
  }
  std::stable_sort (
      report.facing_decisions.begin (), report.facing_decisions.end (),
      [] (const FacingDecision& a, const FacingDecision& b) { return a.certainty < b.certainty; });
  if (facing.lacks_viewpoint)
    addFinding (report, FindingId::NO_VIEWPOINT, points, {});
  const auto add = [&] (FindingId id, const Pieces& pieces) {
    if (pieces.count > 0 && TINY_OBJECT * pieces.triangles >= triangles)
      addFinding (report, id, points, {pieces.largest->at}, pieces.count);
  };
  for (std::size_t miss = 0; miss < missed.size (); ++miss)
    add (findingOf (static_cast<FacingMiss> (miss), wanted), missed[miss]);
  add (guessOf (wanted), guessed);
}

} // namespace

void
reportDisc (const Points& points, const Disc& disc, Report& report)
{
  const Boundary& boundary = disc.boundary;
  report.loop = valuesAt (points.cloud_index, boundary.loop);
  report.statistics.boundary_candidates = boundary.candidates;
  report.statistics.loop_points = boundary.loop.size ();
  if (boundary.largest_step > LONG_STEP)
    addFinding (report, FindingId::STEP_IN_LOOP, points, {boundary.longest_from},
                boundary.largest_step);
  SystemStatistics& figures = report.statistics;
  figures = disc.figures;
  if (figures.nnz_matrix > 0)
    figures.fill_in = static_cast<double> (figures.nnz_factors) / figures.nnz_matrix;
  if (disc.uv.empty ())
    return;
  const Vector2d nowhere = Vector2d::Constant (std::numeric_limits<double>::quiet_NaN ());
  const Eigen::Array2d mirror (1.0, disc.finish.facing.turned > 0 ? -1.0 : 1.0);
  report.parameters.assign (report.statistics.cloud_points, nowhere);
  for (Index p = 0; p < points.cloud_index.size (); ++p)
    report.parameters[points.cloud_index[p]] = disc.uv[p].array () * mirror;
  for (const std::array<Index, 2>& duplicate : points.duplicates)
    report.parameters[duplicate[0]] = report.parameters[duplicate[1]];
}

void
reportLoops (const Points& points, const Surface& surface, Report& report)
{
  if (const std::vector<Triangle>& seam = surface.orientation_seam; !seam.empty ())
    addFinding (report, FindingId::ONE_SIDED, points, {seam.front ()[0]}, seam.size ());
  report.statistics.holes_filled = surface.holes_filled;
  std::size_t too_deep = 0;
  const BoundaryLoop* widest = nullptr;
  for (const BoundaryLoop& loop : surface.doubtful_loops) {
    const LoopDecision decision{summaryOf (loop, points), loop.keep_open,
                                loop.judgement.probability (), loop.judgement.is_too_deep};
    if (decision.is_too_deep && decision.stays_open && decision.probability <= 0.5) {
      ++too_deep;
      if (widest == nullptr || loop.width > widest->width)
        widest = &loop;
    }
    report.loop_decisions.push_back (decision);
  }
  std::stable_sort (report.loop_decisions.begin (), report.loop_decisions.end (),
                    [] (const LoopDecision& a, const LoopDecision& b) {
                      return std::abs (a.probability - 0.5) < std::abs (b.probability - 0.5);
                    });
  if (too_deep > 0)
    addFinding (report, FindingId::DEEP_HOLES, points, {widest->points.front ()}, too_deep,
                widest->width * points.scale, widest->width / widest->spacing);
}

Problem
reportMesh (const Points& points, const std::vector<Triangle>& triangles,
            const MeshExamination& found, const MeshFinish& finish, const Trimming& trimming,
            const Options& options, Report& report)
{
  Statistics& statistics = report.statistics;
  statistics.flips = finish.flips;
  statistics.necks_cut = finish.necks_cut;
  statistics.remade_points = finish.remade.points ();
  statistics.self_intersection_flips = finish.repairs.flips;
  statistics.self_intersection_moves = finish.repairs.moves;
  statistics.self_intersection_rebuilds = finish.repairs.rebuilds;
  statistics.triangles = triangles.size ();
  report.check = found.check;
  if (report.topology == Topology::SURFACE)
    report.topology_reason =
        (options.topology == Topology::SURFACE ? "asked for" : inFewWords (found.check)) +
        (report.is_view ? ", seen from one place" : "");
  statistics.folds = found.check.folds;
  if (!found.isManifold ())
    return {RunStatus::INTERNAL_ERROR,
            "the result is not an oriented manifold: " +
                std::to_string (found.check.nonmanifold_edges) + " edges and " +
                std::to_string (found.check.nonmanifold_vertices) + " points are not manifold" +
                (found.figures.broken.at == NONE
                     ? ""
                     : ", one at " + placeText (points.cloud_index[found.figures.broken.at],
                                                points.inCloud (found.figures.broken.at))) +
                "; please report this with the cloud"};
  if (report.loop.empty () && !found.loops.empty ()) {
    report.loop = valuesAt (points.cloud_index, found.loops.front ().points);
    statistics.loop_points = report.loop.size ();
  }
  reportUnused (points, found, report);
  findShape (points, found, report);
  findHoles (points, found, options, report);
  report.check.largest_area_share = largestAreaShare (triangles, points.positions);
  // Nothing is said of what was trimmed: it was asked for.
  statistics.trimmed_triangles = trimming.triangles;
  statistics.opened_triangles = trimming.crossing;
  statistics.trimmed_components = trimming.components;
  statistics.trimmed_points = trimming.points.size ();
  statistics.used_points -= trimming.points.size ();
  for (const Index p : trimming.points)
    report.unused.push_back (points.cloud_index[p]);
  std::sort (report.unused.begin (), report.unused.end ());
  if (triangles.empty () && trimming.triangles > 0)
    return {RunStatus::DEGENERATE, whyNothingIsLeft (trimming, options.trimming)};
  reportFacing (points, finish.facing, options.facing, report);
  return {};
}

} // namespace pcl::floater
