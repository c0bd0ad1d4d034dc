// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_list.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace pcl
{
namespace floater
{
namespace
{
template <typename Value>
Value
scaled (Value value, double factor)
{
  if constexpr (std::is_floating_point_v<Value>)
    return static_cast<Value> (value * factor);
  const auto rounded = static_cast<Value> (std::lround (static_cast<double> (value) * factor));
  const auto one = static_cast<Value> (1);
  if (rounded != value)
    return std::max (rounded, one);
  return factor > 1.0 ? value + one : std::max (static_cast<Value> (value - one), one);
}

} // namespace

// A member of Limits by its name in the code.
#define PCL_FLOATER_LIMIT(member)                                                                  \
  {                                                                                                \
#member, [] (Limits & limits, double factor)                                                   \
    { limits.member = scaled (limits.member, factor); },                                           \
        [] (const Limits& limits) { return static_cast<double> (limits.member); }   \
  }

std::vector<NamedLimit>
allLimits ()
{
  return {
      PCL_FLOATER_LIMIT (outliers.far),
      PCL_FLOATER_LIMIT (outliers.off_plane),
      PCL_FLOATER_LIMIT (outliers.flat),
      PCL_FLOATER_LIMIT (outliers.stray),
      PCL_FLOATER_LIMIT (outliers.cluster),
      PCL_FLOATER_LIMIT (outliers.own),
      PCL_FLOATER_LIMIT (outliers.owners),
      PCL_FLOATER_LIMIT (noise.strong),
      PCL_FLOATER_LIMIT (noise.falls_to),
      PCL_FLOATER_LIMIT (noise.quantile),
      PCL_FLOATER_LIMIT (noise.sheet_gap),
      PCL_FLOATER_LIMIT (noise.radius),
      PCL_FLOATER_LIMIT (noise.disturbed_share),
      PCL_FLOATER_LIMIT (noise.scatter),
      PCL_FLOATER_LIMIT (planes.least_aspect),
      PCL_FLOATER_LIMIT (planes.core_points),
      PCL_FLOATER_LIMIT (planes.sheet_sine),
      PCL_FLOATER_LIMIT (sheets.plane_sine),
      PCL_FLOATER_LIMIT (sheets.normal_cosine),
      PCL_FLOATER_LIMIT (reach.farthest),
      PCL_FLOATER_LIMIT (reach.most_cosine),
      PCL_FLOATER_LIMIT (reach.line_sine),
      PCL_FLOATER_LIMIT (reach.thicknesses),
      PCL_FLOATER_LIMIT (reach.gap_ratio),
      PCL_FLOATER_LIMIT (reach.circle_sheet.plane_sine),
      PCL_FLOATER_LIMIT (reach.circle_sheet.normal_cosine),
      PCL_FLOATER_LIMIT (reach.added),
      PCL_FLOATER_LIMIT (reach.rounds),
      PCL_FLOATER_LIMIT (surface.consensus.candidates.circumradius_ratio[0]),
      PCL_FLOATER_LIMIT (surface.consensus.candidates.circumradius_ratio[1]),
      PCL_FLOATER_LIMIT (surface.consensus.candidates.circumradius_ratio[2]),
      PCL_FLOATER_LIMIT (surface.consensus.candidates.normal_agreement[0]),
      PCL_FLOATER_LIMIT (surface.consensus.candidates.normal_agreement[1]),
      PCL_FLOATER_LIMIT (surface.consensus.candidates.normal_agreement[2]),
      PCL_FLOATER_LIMIT (surface.consensus.candidates.sure_ranks),
      PCL_FLOATER_LIMIT (surface.consensus.smallest_island),
      PCL_FLOATER_LIMIT (surface.consensus.shortest_seam),
      PCL_FLOATER_LIMIT (surface.open_loops.sectors.angle),
      PCL_FLOATER_LIMIT (surface.open_loops.sectors.sheet.plane_sine),
      PCL_FLOATER_LIMIT (surface.open_loops.sectors.sheet.normal_cosine),
      PCL_FLOATER_LIMIT (surface.open_loops.constant),
      PCL_FLOATER_LIMIT (surface.open_loops.points),
      PCL_FLOATER_LIMIT (surface.open_loops.compactness),
      PCL_FLOATER_LIMIT (surface.open_loops.irregularity),
      PCL_FLOATER_LIMIT (surface.open_loops.growth),
      PCL_FLOATER_LIMIT (surface.open_loops.turning),
      PCL_FLOATER_LIMIT (surface.open_loops.open_points),
      PCL_FLOATER_LIMIT (surface.open_loops.deepest_gap),
      PCL_FLOATER_LIMIT (surface.hole_filling.area_cost),
      PCL_FLOATER_LIMIT (surface.hole_filling.largest_polygon),
      PCL_FLOATER_LIMIT (surface.finish.cost.turned_cosine),
      PCL_FLOATER_LIMIT (surface.finish.cost.turned_cost),
      PCL_FLOATER_LIMIT (surface.finish.cost.large_area),
      PCL_FLOATER_LIMIT (surface.finish.cost.large_cost),
      PCL_FLOATER_LIMIT (surface.finish.cost.fold_cost),
      PCL_FLOATER_LIMIT (surface.finish.repair.largest_fan),
      PCL_FLOATER_LIMIT (surface.finish.repair.passes),
      PCL_FLOATER_LIMIT (surface.finish.repair.places),
      PCL_FLOATER_LIMIT (surface.finish.repair.patch_points),
      PCL_FLOATER_LIMIT (surface.finish.repair.kicks),
      PCL_FLOATER_LIMIT (surface.finish.repair.points_per_kick),
      PCL_FLOATER_LIMIT (surface.finish.repair.passes_after_kick),
      PCL_FLOATER_LIMIT (surface.finish.repair.places_after_kick),
      PCL_FLOATER_LIMIT (uncrossing.pair_cost),
      PCL_FLOATER_LIMIT (uncrossing.largest_fan),
      PCL_FLOATER_LIMIT (uncrossing.places),
      PCL_FLOATER_LIMIT (uncrossing.passes),
      PCL_FLOATER_LIMIT (uncrossing.tests_per_triangle),
      PCL_FLOATER_LIMIT (uncrossing.fewest_tests),
      PCL_FLOATER_LIMIT (surface.finish.facing.body_ratio),
      PCL_FLOATER_LIMIT (surface.finish.facing.lines),
      PCL_FLOATER_LIMIT (surface.finish.facing.triangles_per_line),
      PCL_FLOATER_LIMIT (surface.finish.facing.fewest_lines),
      PCL_FLOATER_LIMIT (surface.finish.facing.seen_share),
      PCL_FLOATER_LIMIT (surface.finish.facing.equal_axes),
      PCL_FLOATER_LIMIT (surface.finish.facing.nesting_margin),
      PCL_FLOATER_LIMIT (surface.finish.facing.nesting_lines),
      PCL_FLOATER_LIMIT (surface.finish.facing.own_body_ratio),
      PCL_FLOATER_LIMIT (surface.finish.facing.chance_lines),
      PCL_FLOATER_LIMIT (surface.finish.facing.continuations.reach),
      PCL_FLOATER_LIMIT (surface.finish.facing.continuations.cosine),
      PCL_FLOATER_LIMIT (surface.finish.facing.continuations.agreement),
      PCL_FLOATER_LIMIT (surface.finish.facing.continuations.support),
      PCL_FLOATER_LIMIT (view.evidence.patches),
      PCL_FLOATER_LIMIT (view.evidence.patch_points),
      PCL_FLOATER_LIMIT (view.evidence.near_ratio),
      PCL_FLOATER_LIMIT (view.evidence.near_share),
      PCL_FLOATER_LIMIT (view.evidence.regularity),
      PCL_FLOATER_LIMIT (view.search.even),
      PCL_FLOATER_LIMIT (view.search.explained),
      PCL_FLOATER_LIMIT (view.search.samples),
      PCL_FLOATER_LIMIT (view.search.cells),
      PCL_FLOATER_LIMIT (view.search.directions),
      PCL_FLOATER_LIMIT (view.search.starts),
      PCL_FLOATER_LIMIT (view.search.area_evaluations),
      PCL_FLOATER_LIMIT (view.search.by_areas),
      PCL_FLOATER_LIMIT (view.search.compared),
      PCL_FLOATER_LIMIT (view.search.rounds),
      PCL_FLOATER_LIMIT (view.search.ray_evaluations),
      PCL_FLOATER_LIMIT (view.search.after_round.regularity),
      PCL_FLOATER_LIMIT (view.search.after_round.near_share),
      PCL_FLOATER_LIMIT (view.search.after_round_from_far.regularity),
      PCL_FLOATER_LIMIT (view.search.after_round_from_far.near_share),
      PCL_FLOATER_LIMIT (view.search.after_first_fit.regularity),
      PCL_FLOATER_LIMIT (view.search.after_first_fit.near_share),
      PCL_FLOATER_LIMIT (view.search.after_fit.regularity),
      PCL_FLOATER_LIMIT (view.search.after_fit.near_share),
      PCL_FLOATER_LIMIT (view.search.rows),
      PCL_FLOATER_LIMIT (view.search.row_directions),
      PCL_FLOATER_LIMIT (view.search.by_rows),
      PCL_FLOATER_LIMIT (view.search.coarse_patches),
      PCL_FLOATER_LIMIT (view.search.fits),
      PCL_FLOATER_LIMIT (view.gaps.radius),
      PCL_FLOATER_LIMIT (view.steps.slope),
      PCL_FLOATER_LIMIT (view.steps.noise),
      PCL_FLOATER_LIMIT (view.steps.turn),
      PCL_FLOATER_LIMIT (view.steps.sharp_noise),
      PCL_FLOATER_LIMIT (view.steps.joint),
      PCL_FLOATER_LIMIT (view.steps.continued),
      PCL_FLOATER_LIMIT (view.steps.edges_per_bin),
      PCL_FLOATER_LIMIT (view.steps.bins_beside),
      PCL_FLOATER_LIMIT (view.steps.noise_quantile),
      PCL_FLOATER_LIMIT (view.steps.rounding),
      PCL_FLOATER_LIMIT (view.steps.step_quantile),
      PCL_FLOATER_LIMIT (view.steps.largest_quantum),
      PCL_FLOATER_LIMIT (view.flips.angle),
      PCL_FLOATER_LIMIT (view.flips.fold_cost),
      PCL_FLOATER_LIMIT (view.shortest_step),
      PCL_FLOATER_LIMIT (view.smallest_part),
      PCL_FLOATER_LIMIT (view.largest_unused_share),
      PCL_FLOATER_LIMIT (loop.circumradius_ratios[0]),
      PCL_FLOATER_LIMIT (loop.circumradius_ratios[1]),
      PCL_FLOATER_LIMIT (loop.circumradius_ratios[2]),
      PCL_FLOATER_LIMIT (loop.longest_edge),
      PCL_FLOATER_LIMIT (loop.largest_trusted_step),
      PCL_FLOATER_LIMIT (loop.mutual_cost),
      PCL_FLOATER_LIMIT (loop.one_sided_cost),
      PCL_FLOATER_LIMIT (loop.least_gain),
      PCL_FLOATER_LIMIT (loop.largest_detour),
      PCL_FLOATER_LIMIT (loop.edge_margin),
      PCL_FLOATER_LIMIT (loop.shortest_loop),
      PCL_FLOATER_LIMIT (loop.few_points),
      PCL_FLOATER_LIMIT (disc.least_reached_share),
      PCL_FLOATER_LIMIT (disc.links_per_point),
      PCL_FLOATER_LIMIT (disc.collapsed_scale),
      PCL_FLOATER_LIMIT (disc.largest_fold_share),
  };
}

#undef PCL_FLOATER_LIMIT

} // namespace floater
} // namespace pcl
