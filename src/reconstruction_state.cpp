// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/surface/floater/reconstruction_state.h>

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

} // namespace

struct ReconstructionState::Data
{
  Options options;
  pcl::Indices prescribed_loop; // as given: may hold indices that the core's type cannot
  Report report;
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
  Result result = reconstruct (std::move (input), options);
  data_->report = std::move (result.report);
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
