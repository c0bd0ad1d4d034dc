// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/surface/floater/reconstruction_state.h>

#include "core/disjoint_sets.h"
#include "pcl_neighborhoods.h"
#include "problem_of_exception.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
pcl::Indices
toPcl (const std::vector<std::uint32_t>& indices)
{
  return pcl::Indices (indices.begin (), indices.end ());
}

// The component of each of `size` points, from 0 in the order of their first points, or -1.
std::vector<int>
componentsOf (const std::vector<std::array<std::uint32_t, 3>>& triangles, std::size_t size)
{
  DisjointSets sets (size);
  std::vector<int> components (size, -1);
  for (const std::array<std::uint32_t, 3>& t : triangles) {
    sets.join (t[0], t[1]);
    sets.join (t[0], t[2]);
    for (const std::uint32_t p : t)
      components[p] = 0;
  }
  // The smallest element of a set represents it, and so has its number before the others.
  int count = 0;
  for (std::size_t p = 0; p < size; ++p)
    if (components[p] == 0) {
      const std::size_t first = sets.find (static_cast<std::uint32_t> (p));
      components[p] = first == p ? count++ : components[first];
    }
  return components;
}

// Whether each of `size` points is on a boundary loop of a consistently oriented manifold.
std::vector<bool>
boundaryOf (const std::vector<std::array<std::uint32_t, 3>>& triangles, std::size_t size)
{
  // Around a point, each triangle leads from one neighbour to the next. The steps of an open fan
  // add up to the way from its first to its last neighbour, those of a closed one to 0.
  std::vector<std::uint32_t> way (size, 0);
  for (const std::array<std::uint32_t, 3>& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      way[t[i]] += t[(i + 2) % 3] - t[(i + 1) % 3];
  std::vector<bool> is_boundary (size);
  for (std::size_t p = 0; p < size; ++p)
    is_boundary[p] = way[p] != 0;
  return is_boundary;
}

// The state of each point.
// \param components as of componentsOf
// \param is_selected of each point: it was to be reconstructed
std::vector<std::int8_t>
statesOf (const std::vector<std::array<std::uint32_t, 3>>& triangles,
          const std::vector<int>& components, const std::vector<bool>& is_selected,
          const std::vector<std::uint32_t>& non_finite)
{
  using State = ReconstructionState::PointState;
  const std::size_t size = is_selected.size ();
  const std::vector<bool> is_boundary = boundaryOf (triangles, size);
  std::vector<std::int8_t> states (size, State::NONE);
  for (std::size_t p = 0; p < size; ++p)
    if (components[p] >= 0)
      states[p] = is_boundary[p] ? State::BOUNDARY : State::COMPLETED;
    else if (is_selected[p])
      states[p] = State::FREE;
  for (const std::uint32_t p : non_finite)
    states[p] = State::NONE;
  return states;
}

} // namespace

struct ReconstructionState::Data
{
  Options options;
  pcl::Indices prescribed_loop; // as given: may hold indices that the core's type cannot
  bool use_input_normals = false;
  Report report;
  std::vector<int> parts;          // of each point; empty if there is no mesh
  std::vector<std::int8_t> states; // PointState of each point; empty if there is no mesh
};

ReconstructionState::ReconstructionState () : data_ (std::make_unique<Data> ()) {}

ReconstructionState::ReconstructionState (const ReconstructionState& other)
    : data_ (std::make_unique<Data> (*other.data_))
{
}

ReconstructionState&
ReconstructionState::operator= (const ReconstructionState& other)
{
  *data_ = *other.data_;
  return *this;
}

ReconstructionState::~ReconstructionState () = default;

void
ReconstructionState::setTopology (Topology topology)
{
  data_->options.topology = topology;
}

Topology
ReconstructionState::getTopology () const
{
  return data_->options.topology;
}

void
ReconstructionState::setHolePolicy (HolePolicy policy)
{
  data_->options.holes.policy = policy;
}

HolePolicy
ReconstructionState::getHolePolicy () const
{
  return data_->options.holes.policy;
}

void
ReconstructionState::setKeptLoops (int loops)
{
  data_->options.holes.kept_loops = loops;
}

int
ReconstructionState::getKeptLoops () const
{
  return data_->options.holes.kept_loops;
}

void
ReconstructionState::setLargestHole (double size, LengthUnit unit)
{
  data_->options.holes.largest_hole = size;
  data_->options.holes.unit = unit;
}

double
ReconstructionState::getLargestHole () const
{
  return data_->options.holes.largest_hole;
}

LengthUnit
ReconstructionState::getLargestHoleUnit () const
{
  return data_->options.holes.unit;
}

void
ReconstructionState::setViewPoint (double x, double y, double z)
{
  data_->options.view.use = ViewUse::GIVEN;
  data_->options.view.viewpoint = {x, y, z};
}

const std::array<double, 3>&
ReconstructionState::getViewPoint () const
{
  return data_->options.view.viewpoint;
}

void
ReconstructionState::setViewUse (ViewUse use)
{
  data_->options.view.use = use;
}

ViewUse
ReconstructionState::getViewUse () const
{
  return data_->options.view.use;
}

void
ReconstructionState::setMaximumEdgeLength (double length)
{
  data_->options.trimming.maximum_edge_length = length;
}

double
ReconstructionState::getMaximumEdgeLength () const
{
  return data_->options.trimming.maximum_edge_length;
}

void
ReconstructionState::setMaximumEdgeRatio (double spacings)
{
  data_->options.trimming.maximum_edge_ratio = spacings;
}

double
ReconstructionState::getMaximumEdgeRatio () const
{
  return data_->options.trimming.maximum_edge_ratio;
}

void
ReconstructionState::setOpenSelfIntersections (bool open)
{
  data_->options.trimming.open_self_intersections = open;
}

bool
ReconstructionState::getOpenSelfIntersections () const
{
  return data_->options.trimming.open_self_intersections;
}

void
ReconstructionState::setMinimumComponentSize (int points)
{
  data_->options.trimming.minimum_component_size = points;
}

int
ReconstructionState::getMinimumComponentSize () const
{
  return data_->options.trimming.minimum_component_size;
}

void
ReconstructionState::setRemoveOutliers (bool remove_outliers)
{
  data_->options.remove_outliers = remove_outliers;
}

bool
ReconstructionState::getRemoveOutliers () const
{
  return data_->options.remove_outliers;
}

void
ReconstructionState::setScatterPolicy (ScatterPolicy policy)
{
  data_->options.scatter = policy;
}

ScatterPolicy
ReconstructionState::getScatterPolicy () const
{
  return data_->options.scatter;
}

void
ReconstructionState::setDenoise (bool denoise)
{
  data_->options.denoise = denoise;
}

bool
ReconstructionState::getDenoise () const
{
  return data_->options.denoise;
}

void
ReconstructionState::setKSearch (int k)
{
  data_->options.neighbors.k = k;
}

int
ReconstructionState::getKSearch () const
{
  return data_->options.neighbors.k;
}

void
ReconstructionState::setNeighborhood (Neighborhood neighborhood)
{
  data_->options.neighbors.kind = neighborhood;
}

Neighborhood
ReconstructionState::getNeighborhood () const
{
  return data_->options.neighbors.kind;
}

void
ReconstructionState::setBallRadius (double spacings)
{
  data_->options.neighbors.ball_radius = spacings;
}

double
ReconstructionState::getBallRadius () const
{
  return data_->options.neighbors.ball_radius;
}

void
ReconstructionState::setDiscOptions (const DiscOptions& options)
{
  data_->options.disc = options;
  data_->prescribed_loop.assign (options.boundary.loop.begin (), options.boundary.loop.end ());
}

const DiscOptions&
ReconstructionState::getDiscOptions () const
{
  return data_->options.disc;
}

void
ReconstructionState::setPrescribedLoop (const pcl::Indices& loop)
{
  data_->prescribed_loop = loop;
  data_->options.disc.boundary.loop.assign (loop.begin (), loop.end ());
}

const pcl::Indices&
ReconstructionState::getPrescribedLoop () const
{
  return data_->prescribed_loop;
}

void
ReconstructionState::setUseInputNormals (bool use)
{
  data_->use_input_normals = use;
}

bool
ReconstructionState::getUseInputNormals () const
{
  return data_->use_input_normals;
}

void
ReconstructionState::setFilterSheets (bool filter_sheets)
{
  data_->options.filter_sheets = filter_sheets;
}

bool
ReconstructionState::getFilterSheets () const
{
  return data_->options.filter_sheets;
}

void
ReconstructionState::setFlipEdges (bool flip_edges)
{
  data_->options.flip_edges = flip_edges;
}

bool
ReconstructionState::getFlipEdges () const
{
  return data_->options.flip_edges;
}

void
ReconstructionState::setRemoveSelfIntersections (bool remove)
{
  data_->options.remove_self_intersections = remove;
}

bool
ReconstructionState::getRemoveSelfIntersections () const
{
  return data_->options.remove_self_intersections;
}

void
ReconstructionState::setNumberOfThreads (unsigned int nr_threads)
{
  data_->options.threads = static_cast<int> (nr_threads);
}

unsigned int
ReconstructionState::getNumberOfThreads () const
{
  return static_cast<unsigned int> (data_->options.threads);
}

void
ReconstructionState::setNumberOfBlocks (int blocks)
{
  data_->options.blocks = blocks;
}

int
ReconstructionState::getNumberOfBlocks () const
{
  return data_->options.blocks;
}

void
ReconstructionState::setStageCallback (std::function<void (Stage)> callback)
{
  data_->options.stage_callback = std::move (callback);
}

const std::function<void (Stage)>&
ReconstructionState::getStageCallback () const
{
  return data_->options.stage_callback;
}

void
ReconstructionState::setProgressCallback (std::function<void (double fraction)> callback)
{
  data_->options.progress_callback = std::move (callback);
}

const std::function<void (double)>&
ReconstructionState::getProgressCallback () const
{
  return data_->options.progress_callback;
}

void
ReconstructionState::setCancelledCallback (std::function<bool ()> callback)
{
  data_->options.cancelled_callback = std::move (callback);
}

const std::function<bool ()>&
ReconstructionState::getCancelledCallback () const
{
  return data_->options.cancelled_callback;
}

RunStatus
ReconstructionState::getStatus () const
{
  return data_->report.status;
}

const std::string&
ReconstructionState::getMessage () const
{
  return data_->report.message;
}

const Report&
ReconstructionState::getReport () const
{
  return data_->report;
}

const Statistics&
ReconstructionState::getStatistics () const
{
  return data_->report.statistics;
}

const MeshCheck&
ReconstructionState::getMeshCheck () const
{
  return data_->report.check;
}

pcl::Indices
ReconstructionState::getBoundaryLoop () const
{
  return toPcl (data_->report.loop);
}

const std::vector<Eigen::Vector2d>&
ReconstructionState::getParameters () const
{
  return data_->report.parameters;
}

std::vector<int>
ReconstructionState::getPartIDs () const
{
  return data_->parts;
}

std::vector<int>
ReconstructionState::getPointStates () const
{
  return {data_->states.begin (), data_->states.end ()};
}

pcl::Indices
ReconstructionState::getUnusedIndices () const
{
  return toPcl (data_->report.unused);
}

pcl::Indices
ReconstructionState::getOutlierIndices () const
{
  return toPcl (data_->report.outliers);
}

pcl::Indices
ReconstructionState::getScatterIndices () const
{
  return toPcl (data_->report.scatter);
}

pcl::Indices
ReconstructionState::getNonFiniteIndices () const
{
  return toPcl (data_->report.non_finite);
}

std::vector<std::array<pcl::index_t, 2>>
ReconstructionState::getDuplicates () const
{
  std::vector<std::array<pcl::index_t, 2>> duplicates;
  duplicates.reserve (data_->report.duplicates.size ());
  for (const std::array<std::uint32_t, 2>& pair : data_->report.duplicates)
    duplicates.push_back (
        {static_cast<pcl::index_t> (pair[0]), static_cast<pcl::index_t> (pair[1])});
  return duplicates;
}

void
ReconstructionState::beginRun ()
{
  data_->report = Report ();
  data_->parts.clear ();
  data_->states.clear ();
}

void
ReconstructionState::fail (RunStatus status, const std::string& message)
{
  data_->report.status = status;
  data_->report.message = message;
}

void
ReconstructionState::failByException () noexcept
{
  data_->parts.clear ();
  data_->states.clear ();
  try {
    const Problem problem = problemOfException ();
    fail (problem.status, problem.message);
  }
  catch (const std::bad_alloc&) {
    data_->report.status = RunStatus::OUT_OF_MEMORY;
    data_->report.message = NO_MEMORY;
  }
}

bool
ReconstructionState::checkCloud (std::size_t size, const pcl::Indices& indices)
{
  constexpr std::size_t MAX_POINTS = std::numeric_limits<std::uint32_t>::max ();
  data_->report.statistics.cloud_points = size;
  if (size > MAX_POINTS) {
    fail (RunStatus::OUT_OF_MEMORY, "the cloud has more than " + std::to_string (MAX_POINTS) +
                                        " points; reconstruct parts of it");
    return false;
  }
  const std::string outside_the_cloud =
      " is outside the cloud of " + std::to_string (size) + (size == 1 ? " point" : " points");
  // The conversion makes negative indices too large.
  const auto is_outside = [size] (pcl::index_t index) {
    return static_cast<std::size_t> (index) >= size;
  };
  const auto outside = std::find_if (indices.begin (), indices.end (), is_outside);
  if (outside != indices.end ()) {
    fail (RunStatus::INVALID_INDICES, "index " + std::to_string (*outside) + outside_the_cloud);
    return false;
  }
  const pcl::Indices& loop = data_->prescribed_loop;
  const auto outside_in_loop = std::find_if (loop.begin (), loop.end (), is_outside);
  if (outside_in_loop != loop.end ()) {
    fail (RunStatus::INVALID_LOOP, "point " + std::to_string (*outside_in_loop) +
                                       " of the given boundary loop" + outside_the_cloud);
    return false;
  }
  return true;
}

std::vector<std::array<std::uint32_t, 3>>
ReconstructionState::triangulatePoints (Input&& input)
{
  const Options options = data_->options; // a callback may set options for the next run
  std::vector<bool> is_selected (input.cloud_size, false);
  for (const std::uint32_t p : input.cloud_index)
    is_selected[p] = true;
  std::unique_ptr<PclNeighborhoods> by_pcl; // TW 385 as a user of PCL would put it together
  if (options.disc.as_published && input.search == nullptr) {
    by_pcl = std::make_unique<PclNeighborhoods> (input);
    input.search = &by_pcl->search ();
    if (input.normals.empty ())
      input.normals = by_pcl->normals (options.neighbors.k);
  }
  Result result = reconstruct (std::move (input), options);
  data_->report = std::move (result.report);
  if (data_->report.status == RunStatus::SUCCESS) {
    data_->parts = componentsOf (result.triangles, is_selected.size ());
    data_->states =
        statesOf (result.triangles, data_->parts, is_selected, data_->report.non_finite);
  }
  return std::move (result.triangles);
}

void
ReconstructionState::printOutcome (const std::string& class_name) const
{
  const Report& report = data_->report;
  const char* const name = class_name.c_str ();
  if (report.status == RunStatus::CANCELLED) // as asked for: no error
    PCL_WARN ("[pcl::%s::performReconstruction] %s: %s\n", name, statusName (report.status),
              report.message.c_str ());
  else if (report.status != RunStatus::SUCCESS)
    PCL_ERROR ("[pcl::%s::performReconstruction] %s: %s\n", name, statusName (report.status),
               report.message.c_str ());
  else
    for (const std::string& warning : report.warnings)
      PCL_WARN ("[pcl::%s::performReconstruction] %s\n", name, warning.c_str ());
}

} // namespace floater
} // namespace pcl
