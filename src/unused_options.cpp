// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "unused_options.h"

#include <initializer_list>
#include <utility>

namespace pcl::floater {
namespace {
struct Change
{
  const char* option;
  bool is_changed;
};
using Changes = std::initializer_list<Change>;

// Collects sentences; each names the options that are changed.
class Sentences
{
public:
  // \param reason ends the sentence that begins with the options
  void add (const Changes& changes, const std::string& reason)
  {
    std::string names;
    std::size_t count = 0;
    for (const Change& change : changes)
      if (change.is_changed) {
        names += (count == 0 ? "" : ", ") + std::string (change.option);
        ++count;
      }
    if (count > 0)
      sentences_.push_back (
          (count == 1 ? "an option has no effect: " : "options have no effect: ") + names + "; " +
          reason);
  }

  std::vector<std::string> take () { return std::move (sentences_); }

private:
  std::vector<std::string> sentences_;
};

bool
areInBalls (Neighborhood kind)
{
  return kind == Neighborhood::BALL || kind == Neighborhood::BALL_DELAUNAY;
}

void
addBoundaryAndDomain (const DiscOptions& options, Sentences& sentences)
{
  const DiscOptions defaults;
  const BoundaryOptions &boundary = options.boundary, &usual = defaults.boundary;
  const Change method{"the boundary method", boundary.method != usual.method};
  const Change angle{"the opening angle", boundary.opening_angle != usual.opening_angle};
  const Change tolerance{"the cluster tolerance",
                         boundary.cluster_tolerance != usual.cluster_tolerance};
  const Change k{"the number of cluster neighbours", boundary.cluster_k != usual.cluster_k};
  if (!boundary.loop.empty ())
    sentences.add ({method, angle, tolerance, k}, "the boundary loop is given");
  else if (boundary.method != BoundaryMethod::TWO_SEGMENTS)
    sentences.add ({angle, tolerance, k}, "only the boundary method of two segments takes it");
  if (options.domain.curve != Domain::POLYGON)
    sentences.add ({{"the number of polygon sides",
                     options.domain.polygon_sides != defaults.domain.polygon_sides}},
                   "the domain is no polygon");
}

void
addSolver (const SolverOptions& options, Sentences& sentences)
{
  const SolverOptions defaults;
  if (options.method != Solver::BICGSTAB_ILUT)
    sentences.add ({{"the fill of ILUT", options.ilut_fill != defaults.ilut_fill},
                    {"the drop tolerance of ILUT", options.ilut_drop != defaults.ilut_drop}},
                   "only the solver BiCGSTAB with ILUT takes it");
  if (options.method != Solver::BICGSTAB_ILUT && options.method != Solver::GAUSS_SEIDEL)
    sentences.add (
        {{"the tolerance", options.tolerance != defaults.tolerance},
         {"the number of iterations", options.max_iterations != defaults.max_iterations}},
        "the solver is direct");
}

// All that only the disc method reads.
void
addDisc (const DiscOptions& options, Sentences& sentences)
{
  const DiscOptions defaults;
  const BoundaryOptions& boundary = options.boundary;
  const DomainOptions& domain = options.domain;
  const SolverOptions& solver = options.solver;
  sentences.add (
      {{"the boundary method", boundary.method != defaults.boundary.method},
       {"the opening angle", boundary.opening_angle != defaults.boundary.opening_angle},
       {"the cluster tolerance", boundary.cluster_tolerance != defaults.boundary.cluster_tolerance},
       {"the number of cluster neighbours", boundary.cluster_k != defaults.boundary.cluster_k},
       {"the domain", domain.curve != defaults.domain.curve},
       {"the number of polygon sides", domain.polygon_sides != defaults.domain.polygon_sides},
       {"the spacing on the domain", domain.loop_spacing != defaults.domain.loop_spacing},
       {"the weights", options.weighting != defaults.weighting},
       {"the solver", solver.method != defaults.solver.method},
       {"the ordering", solver.ordering != defaults.solver.ordering},
       {"the tolerance", solver.tolerance != defaults.solver.tolerance},
       {"the number of iterations", solver.max_iterations != defaults.solver.max_iterations},
       {"the fill of ILUT", solver.ilut_fill != defaults.solver.ilut_fill},
       {"the drop tolerance of ILUT", solver.ilut_drop != defaults.solver.ilut_drop}},
      "the mesh was not made as a disc");
}

void
addHoles (const HoleOptions& options, Sentences& sentences)
{
  const HoleOptions defaults;
  if (options.policy != HolePolicy::KEEP_COUNT)
    sentences.add ({{"the number of kept loops", options.kept_loops != defaults.kept_loops}},
                   "only the hole policy that keeps a number of loops takes it");
  if (options.policy != HolePolicy::BY_SIZE)
    sentences.add ({{"the largest hole", options.largest_hole != defaults.largest_hole},
                    {"the unit of the largest hole", options.unit != defaults.unit}},
                   "only the hole policy that chooses by size takes it");
}

void
addNeighbors (const Options& options, const Report& report, Sentences& sentences)
{
  const Options defaults;
  const NeighborOptions &neighbors = options.neighbors, &usual = defaults.neighbors;
  const Change kind{"the neighbourhood", neighbors.kind != usual.kind};
  const Change k{"the number of neighbours", neighbors.k != usual.k};
  const Change radius{"the ball radius", neighbors.ball_radius != usual.ball_radius};
  const ScatterPolicy usual_scatter = defaults.scatter;
  if (report.is_view) {
    sentences.add ({kind,
                    k,
                    radius,
                    {"the filter of sheets", !options.filter_sheets},
                    {"the policy for scatter", options.scatter != usual_scatter}},
                   "a scan is connected as its sensor saw it, without neighbours");
    return;
  }
  if (areInBalls (neighbors.kind))
    sentences.add ({k}, "neighbours are searched in balls");
  else
    sentences.add ({radius}, "neighbours are not searched in balls");
  // Surfaces are made of Delaunay stars.
  if (report.topology == Topology::SURFACE && neighbors.kind == Neighborhood::NEAREST)
    sentences.add ({kind}, "the mesh was not made as a disc");
}

} // namespace

std::vector<std::string>
describeUnusedOptions (const Options& options, const Report& report, bool has_plane_normals)
{
  Sentences sentences;
  if (options.disc.as_published)
    sentences.add ({{"the policy for scatter", options.scatter != Options{}.scatter}},
                   "the method of TW 385 keeps all points");
  addNeighbors (options, report, sentences);
  const bool may_face_by_normals =
      options.facing == Facing::AUTO || options.facing == Facing::NORMALS;
  if (report.is_view && !may_face_by_normals)
    sentences.add ({{"the normals of the input", has_plane_normals}},
                   "a scan is connected as its sensor saw it, without tangent planes, and another "
                   "facing is asked for");
  if (report.topology == Topology::DISC) {
    addBoundaryAndDomain (options.disc, sentences);
    addSolver (options.disc.solver, sentences);
  }
  else
    addDisc (options.disc, sentences);
  addHoles (options.holes, sentences);
  return sentences.take ();
}

} // namespace pcl::floater
