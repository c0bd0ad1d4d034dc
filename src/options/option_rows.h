// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The table of options: one row for each. It drives the checks, the warnings on options without
// effect, the tools and their help, the keywords of Python, the reports, and doc/options.md.
#pragma once

#include <pcl/surface/floater/options.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace pcl::floater {
/// A word for a value of an enumeration, on the command line and in reports.
template <typename Enum>
using Choice = std::pair<const char*, Enum>;

/// Words for all values.
template <typename Enum, std::size_t N>
using Choices = const Choice<Enum>[N];

constexpr Choice<bool> METHOD_CHOICES[] = {{"auto", false}, {"tw385", true}};
constexpr Choice<Topology> TOPOLOGY_CHOICES[] = {
    {"auto", Topology::AUTO}, {"disc", Topology::DISC}, {"surface", Topology::SURFACE}};
constexpr Choice<HolePolicy> HOLE_CHOICES[] = {{"auto", HolePolicy::AUTO},
                                               {"close-all", HolePolicy::CLOSE_ALL},
                                               {"keep-largest", HolePolicy::KEEP_LARGEST},
                                               {"keep-count", HolePolicy::KEEP_COUNT},
                                               {"by-size", HolePolicy::BY_SIZE}};
constexpr Choice<Facing> FACING_CHOICES[] = {
    {"auto", Facing::AUTO},           {"outwards", Facing::OUTWARDS}, {"up", Facing::UP},
    {"viewpoint", Facing::VIEWPOINT}, {"normals", Facing::NORMALS},   {"inwards", Facing::INWARDS}};
constexpr Choice<ScatterPolicy> SCATTER_CHOICES[] = {
    {"auto", ScatterPolicy::AUTO}, {"keep", ScatterPolicy::KEEP}, {"drop", ScatterPolicy::DROP}};
constexpr Choice<BoundaryMethod> BOUNDARY_CHOICES[] = {
    {"consensus", BoundaryMethod::CONSENSUS}, {"two-segments", BoundaryMethod::TWO_SEGMENTS}};
constexpr Choice<Neighborhood> NEIGHBORHOOD_CHOICES[] = {
    {"nearest-delaunay", Neighborhood::NEAREST_DELAUNAY},
    {"nearest", Neighborhood::NEAREST},
    {"ball-delaunay", Neighborhood::BALL_DELAUNAY},
    {"ball", Neighborhood::BALL}};
constexpr Choice<Domain> DOMAIN_CHOICES[] = {
    {"circle", Domain::CIRCLE}, {"square", Domain::SQUARE}, {"polygon", Domain::POLYGON}};
constexpr Choice<LoopSpacing> SPACING_CHOICES[] = {{"chord-length", LoopSpacing::CHORD_LENGTH},
                                                   {"centripetal", LoopSpacing::CENTRIPETAL},
                                                   {"uniform", LoopSpacing::UNIFORM}};
constexpr Choice<Weighting> WEIGHTING_CHOICES[] = {
    {"uniform", Weighting::UNIFORM},
    {"inverse-distance", Weighting::INVERSE_DISTANCE},
    {"shape-preserving", Weighting::SHAPE_PRESERVING},
    {"mean-value", Weighting::MEAN_VALUE}};
constexpr Choice<Solver> SOLVER_CHOICES[] = {{"umfpack", Solver::UMFPACK},
                                             {"bicgstab-ilut", Solver::BICGSTAB_ILUT}};
constexpr Choice<Ordering> ORDERING_CHOICES[] = {
    {"automatic", Ordering::AUTOMATIC},
    {"amd", Ordering::AMD},
    {"metis", Ordering::METIS},
    {"reverse-cuthill-mckee", Ordering::REVERSE_CUTHILL_MCKEE},
    {"natural", Ordering::NATURAL}};

constexpr Choice<bool> SWITCH_CHOICES[] = {{"on", true}, {"off", false}};

/// The word for a value.
template <typename Enum, std::size_t N>
const char*
choiceName (Choices<Enum, N>& choices, Enum value)
{
  for (const auto& choice : choices)
    if (choice.second == value)
      return choice.first;
  return "unknown";
}

/// Headings of the options in the help.
namespace option_group {
constexpr const char* GENERAL = "General";
constexpr const char* KIND = "What is made";
constexpr const char* SURFACE = "Surface";
constexpr const char* NEIGHBORHOODS = "Neighbourhoods";
constexpr const char* BOUNDARY = "Boundary of a disc";
constexpr const char* PARAMETERIZATION = "Parameterization of a disc";
constexpr const char* SYSTEM = "Linear system of a disc";
} // namespace option_group

/// What an option needs to have an effect.
enum class UsedFor
{
  ALL,
  KEEP_COUNT,
  BY_SIZE,
  STARS,        ///< not scans that are connected as their sensor saw them
  NEIGHBORHOOD, ///< discs, or neighbourhoods other than the k nearest
  NEAREST,      ///< neighbourhoods of k points
  BALLS,        ///< neighbourhoods in balls
  DISC,
  LOOP, ///< discs whose boundary loop is found
  TWO_SEGMENTS,
  POLYGON,
  ITERATIVE, ///< discs with an iterative solver
  SCATTER
};

/// A row of the table.
struct OptionRow
{
  const char* name;     ///< in Python and in reports; as --name, with - for _, in the tool
  const char* group;    ///< heading in the help
  const char* in_class; ///< its setter in pcl::FloaterReconstruction, or its field in DiscOptions
  UsedFor used_for;
  const char* text;        ///< what it does, for the help and the pages
  const char* letter = ""; ///< short name in the tool
};

/// Allowed range of a number.
struct NumberRange
{
  double least, most;
  bool without_least = false, without_most = false;

  bool has (double value) const
  {
    return (without_least ? value > least : value >= least) &&
           (without_most ? value < most : value <= most);
  }

  /// "from 6 to 200", "above 0 and below 360", "0 or more".
  std::string text () const;
};

constexpr double NO_LIMIT = std::numeric_limits<double>::max ();

/// Calls \a visit with each row, in the order of the help, and with
/// - a bool, or a bool and its choices;
/// - an enumerator and its choices;
/// - an int or a double, and its range;
/// - for `viewpoint`, ViewOptions; for `largest_hole` and `largest_hole_length`, HoleOptions and the
///   unit of the size, which is 0 or more.
/// The loop of a disc and the callbacks are not in the table.
template <typename AnyOptions, typename Visitor>
void
visitOptions (AnyOptions& options, Visitor&& visit)
{
  using namespace option_group;
  auto& disc = options.disc;
  auto& trimming = options.trimming;
  visit ({"threads", GENERAL, "setNumberOfThreads", UsedFor::ALL,
          "threads, 0: one for each core; the result is the same", "j"},
         options.threads, NumberRange{0, NO_LIMIT});
  visit ({"method", KIND, "setDiscOptions (DiscOptions::tw385 ())", UsedFor::ALL,
          "tw385: a disc by the method of that report and nothing else: no outliers, noise, sheet "
          "filter, flips or repair"},
         disc.as_published, METHOD_CHOICES);
  visit (
      {"topology", KIND, "setTopology", UsedFor::ALL,
       "what the points are taken for: a disc (one component with one boundary loop, laid out in "
       "the plane) or any surface; auto: a disc if the boundary loop is given, else any surface"},
      options.topology, TOPOLOGY_CHOICES);
  visit ({"holes", SURFACE, "setHolePolicy", UsedFor::ALL,
          "boundary loops that stay open: those that look like boundaries, not like gaps of the "
          "sampling; none; the largest of each component; a number of the most likely; or those "
          "above a size"},
         options.holes.policy, HOLE_CHOICES);
  visit ({"kept_loops", SURFACE, "setKeptLoops", UsedFor::KEEP_COUNT,
          "keep-count: boundary loops that stay open"},
         options.holes.kept_loops, NumberRange{0, NO_LIMIT});
  visit ({"largest_hole", SURFACE, "setLargestHole (size)", UsedFor::BY_SIZE,
          "by-size: width of the widest hole to fill, in local spacings"},
         options.holes, LengthUnit::SPACINGS);
  visit ({"largest_hole_length", SURFACE, "setLargestHole (size, LengthUnit::CLOUD)",
          UsedFor::BY_SIZE, "instead of largest-hole: the same in units of the cloud"},
         options.holes, LengthUnit::CLOUD);
  visit ({"viewpoint", SURFACE, "setViewPoint, setViewUse", UsedFor::ALL,
          "one scan: where its sensor was, before any shift; its points are connected as they were "
          "seen from there. auto: that of the file, or one that is found, if the spacing of the "
          "points tells so; none: the cloud is no single scan"},
         options.view);
  visit ({"facing", SURFACE, "setFacing", UsedFor::ALL,
          "which side of each component is its front; auto: decided from the data"},
         options.facing, FACING_CHOICES);
  visit ({"max_edge", SURFACE, "setMaximumEdgeLength", UsedFor::ALL,
          "cut off triangles with a longer edge, in units of the cloud; 0: no limit"},
         trimming.maximum_edge_length, NumberRange{0, NO_LIMIT});
  visit ({"max_edge_ratio", SURFACE, "setMaximumEdgeRatio", UsedFor::ALL,
          "the same in local spacings; 0: no limit"},
         trimming.maximum_edge_ratio, NumberRange{0, NO_LIMIT});
  visit ({"min_component", SURFACE, "setMinimumComponentSize", UsedFor::ALL,
          "cut off components of fewer points"},
         trimming.minimum_component_size, NumberRange{0, NO_LIMIT});
  visit ({"remove_outliers", SURFACE, "setRemoveOutliers", UsedFor::ALL,
          "leave points that lie off any surface out of the mesh"},
         options.remove_outliers);
  visit ({"scatter", SURFACE, "setScatterPolicy", UsedFor::SCATTER,
          "what becomes of regions that are no surface at any scale, such as leaves"},
         options.scatter, SCATTER_CHOICES);
  visit ({"denoise", SURFACE, "setDenoise", UsedFor::ALL,
          "where noise is strong, connect points as they lie when projected on local planes"},
         options.denoise);
  visit ({"flips", SURFACE, "setFlipEdges", UsedFor::ALL, "flip edges in space at the end"},
         options.flip_edges);
  visit ({"uncross", SURFACE, "setRemoveSelfIntersections", UsedFor::ALL,
          "change the mesh where triangles cross each other or are folded"},
         options.remove_self_intersections);
  visit ({"open_crossings", SURFACE, "setOpenSelfIntersections", UsedFor::ALL,
          "take triangles out until no two cross each other"},
         trimming.open_self_intersections);
  visit ({"neighbors", NEIGHBORHOODS, "setKSearch", UsedFor::NEAREST,
          "nearest neighbours of each point", "k"},
         options.neighbors.k, NumberRange{6, 200});
  visit ({"neighborhood", NEIGHBORHOODS, "setNeighborhood", UsedFor::NEIGHBORHOOD,
          "points that a point of a disc is a mean of: the nearest, those in a ball, or the "
          "Delaunay star among either"},
         options.neighbors.kind, NEIGHBORHOOD_CHOICES);
  visit ({"ball_radius", NEIGHBORHOODS, "setBallRadius", UsedFor::BALLS,
          "ball, ball-delaunay: radius, in mean distances of a point to its 6 nearest"},
         options.neighbors.ball_radius, NumberRange{1, 10});
  visit ({"sheet_filter", NEIGHBORHOODS, "setFilterSheets", UsedFor::STARS,
          "drop neighbours on another sheet of the surface"},
         options.filter_sheets);
  visit ({"boundary", BOUNDARY, "boundary.method", UsedFor::LOOP,
          "how the boundary loop is found: as the longest one of the surface on which the stars "
          "agree; or as in TW 385, section 3 (two-segments)"},
         disc.boundary.method, BOUNDARY_CHOICES);
  visit ({"opening_angle", BOUNDARY, "boundary.opening_angle", UsedFor::TWO_SEGMENTS,
          "two-segments: degrees; a boundary point has a wider sector without neighbours"},
         disc.boundary.opening_angle, NumberRange{0, 360, true, true});
  visit ({"cluster_tolerance", BOUNDARY, "boundary.cluster_tolerance", UsedFor::TWO_SEGMENTS,
          "two-segments: distance over which clusters grow, as a fraction of the bounding box "
          "diagonal"},
         disc.boundary.cluster_tolerance, NumberRange{0, 1, true, false});
  visit ({"cluster_neighbors", BOUNDARY, "boundary.cluster_k", UsedFor::TWO_SEGMENTS,
          "two-segments: boundary points that a cluster takes in at a time"},
         disc.boundary.cluster_k, NumberRange{1, NO_LIMIT});
  visit ({"domain", PARAMETERIZATION, "domain.curve", UsedFor::DISC,
          "convex curve on which the loop is laid"},
         disc.domain.curve, DOMAIN_CHOICES);
  visit (
      {"sides", PARAMETERIZATION, "domain.polygon_sides", UsedFor::POLYGON, "sides of the polygon"},
      disc.domain.polygon_sides, NumberRange{3, NO_LIMIT});
  visit ({"spacing", PARAMETERIZATION, "domain.loop_spacing", UsedFor::DISC,
          "how the points of the loop are spaced on that curve"},
         disc.domain.loop_spacing, SPACING_CHOICES);
  visit ({"weights", PARAMETERIZATION, "weighting", UsedFor::DISC,
          "weights of the neighbours of a point"},
         disc.weighting, WEIGHTING_CHOICES);
  visit ({"solver", SYSTEM, "solver.method", UsedFor::DISC, "what solves the system"},
         disc.solver.method, SOLVER_CHOICES);
  visit ({"ordering", SYSTEM, "solver.ordering", UsedFor::DISC, "order of the unknowns"},
         disc.solver.ordering, ORDERING_CHOICES);
  visit ({"tolerance", SYSTEM, "solver.tolerance", UsedFor::ITERATIVE,
          "bicgstab-ilut: relative residual to reach"},
         disc.solver.tolerance, NumberRange{0, 1, true, true});
  visit ({"max_iterations", SYSTEM, "solver.max_iterations", UsedFor::ITERATIVE,
          "bicgstab-ilut: iterations after which it gives up"},
         disc.solver.max_iterations, NumberRange{1, NO_LIMIT});
  visit ({"ilut_fill", SYSTEM, "solver.ilut_fill", UsedFor::ITERATIVE,
          "bicgstab-ilut: entries kept in a row of each factor"},
         disc.solver.ilut_fill, NumberRange{1, 10000});
  visit ({"ilut_drop", SYSTEM, "solver.ilut_drop", UsedFor::ITERATIVE,
          "bicgstab-ilut: entries of the factors below this fraction of their row are dropped"},
         disc.solver.ilut_drop, NumberRange{0, 1});
}

/// A visitor that keeps the rows, and their values as numbers that differ where the values do.
struct OptionValues
{
  explicit OptionValues (const Options& options) { visitOptions (options, *this); }

  std::vector<OptionRow> rows;
  std::vector<double> values;

  template <typename Value, typename... More>
  void operator() (const OptionRow& row, const Value& value, const More&...)
  {
    rows.push_back (row);
    values.push_back (static_cast<double> (value));
  }
  void operator() (const OptionRow& row, const ViewOptions& view) { (*this) (row, view.use); }
  void operator() (const OptionRow& row, const HoleOptions& holes, LengthUnit unit)
  {
    (*this) (row, holes.unit == unit ? holes.largest_hole : 0.0);
  }
};

} // namespace pcl::floater
