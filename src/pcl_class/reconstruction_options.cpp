// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The setters and getters of options.
#include "pcl_class/reconstruction_data.h"

#include <utility>

namespace pcl::floater {
// A setter and a getter of a member of the data.
#define PCL_FLOATER_OPTION(Name, Type, parameter, member)                                          \
  void ReconstructionState::set##Name (Type parameter)                                             \
  {                                                                                                \
    data_->member = parameter;                                                                     \
  }                                                                                                \
  Type ReconstructionState::get##Name () const                                                     \
  {                                                                                                \
    return data_->member;                                                                          \
  }
#define PCL_FLOATER_CALLBACK(Name, Type, member)                                                   \
  void ReconstructionState::set##Name (Type callback)                                              \
  {                                                                                                \
    data_->member = std::move (callback);                                                          \
  }                                                                                                \
  const Type& ReconstructionState::get##Name () const                                              \
  {                                                                                                \
    return data_->member;                                                                          \
  }

// clang-format off
PCL_FLOATER_OPTION (Topology, Topology, topology, options.topology)
PCL_FLOATER_OPTION (HolePolicy, HolePolicy, policy, options.holes.policy)
PCL_FLOATER_OPTION (ComputeTextureCoordinates, bool, compute, computes_texture)
PCL_FLOATER_OPTION (LargestStretch, double, stretch, largest_stretch)
PCL_FLOATER_OPTION (KeptLoops, int, loops, options.holes.kept_loops)
PCL_FLOATER_OPTION (ViewUse, ViewUse, use, options.view.use)
PCL_FLOATER_OPTION (Facing, Facing, facing, options.facing)
PCL_FLOATER_OPTION (MaximumEdgeLength, double, length, options.trimming.maximum_edge_length)
PCL_FLOATER_OPTION (MaximumEdgeRatio, double, spacings, options.trimming.maximum_edge_ratio)
PCL_FLOATER_OPTION (OpenSelfIntersections, bool, open, options.trimming.open_self_intersections)
PCL_FLOATER_OPTION (MinimumComponentSize, int, points, options.trimming.minimum_component_size)
PCL_FLOATER_OPTION (RemoveOutliers, bool, remove_outliers, options.remove_outliers)
PCL_FLOATER_OPTION (ScatterPolicy, ScatterPolicy, policy, options.scatter)
PCL_FLOATER_OPTION (Denoise, bool, denoise, options.denoise)
PCL_FLOATER_OPTION (KSearch, int, k, options.neighbors.k)
PCL_FLOATER_OPTION (Neighborhood, Neighborhood, neighborhood, options.neighbors.kind)
PCL_FLOATER_OPTION (BallRadius, double, spacings, options.neighbors.ball_radius)
PCL_FLOATER_OPTION (UseInputNormals, bool, use, use_input_normals)
PCL_FLOATER_OPTION (ComputeNormals, bool, compute, compute_normals)
PCL_FLOATER_OPTION (FilterSheets, bool, filter_sheets, options.filter_sheets)
PCL_FLOATER_OPTION (FlipEdges, bool, flip_edges, options.flip_edges)
PCL_FLOATER_OPTION (RemoveSelfIntersections, bool, remove, options.remove_self_intersections)
PCL_FLOATER_CALLBACK (StageCallback, std::function<void (Stage)>, options.stage_callback)
PCL_FLOATER_CALLBACK (ProgressCallback, std::function<void (double)>, options.progress_callback)
PCL_FLOATER_CALLBACK (CancelledCallback, std::function<bool ()>, options.cancelled_callback)
// clang-format on
#undef PCL_FLOATER_OPTION
#undef PCL_FLOATER_CALLBACK

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
ReconstructionState::setNumberOfThreads (unsigned int nr_threads)
{
  data_->options.threads = static_cast<int> (nr_threads);
}

unsigned int
ReconstructionState::getNumberOfThreads () const
{
  return static_cast<unsigned int> (data_->options.threads);
}

} // namespace pcl::floater
