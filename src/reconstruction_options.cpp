// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The setters and getters of options.
#include "reconstruction_data.h"

#include <utility>

namespace pcl::floater {
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
ReconstructionState::setComputeTextureCoordinates (bool compute)
{
  data_->computes_texture = compute;
}

bool
ReconstructionState::getComputeTextureCoordinates () const
{
  return data_->computes_texture;
}

void
ReconstructionState::setLargestStretch (double stretch)
{
  data_->largest_stretch = stretch;
}

double
ReconstructionState::getLargestStretch () const
{
  return data_->largest_stretch;
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
ReconstructionState::setFacing (Facing facing)
{
  data_->options.facing = facing;
}

Facing
ReconstructionState::getFacing () const
{
  return data_->options.facing;
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
ReconstructionState::setComputeNormals (bool compute)
{
  data_->compute_normals = compute;
}

bool
ReconstructionState::getComputeNormals () const
{
  return data_->compute_normals;
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

} // namespace pcl::floater
