// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The setters and getters of options, and the getters of results.
#include "pcl_class/reconstruction_data.h"

namespace pcl::floater {
#define PCL_FLOATER_GETTER(Name, Type, value)                                                      \
  Type ReconstructionState::get##Name () const                                                     \
  {                                                                                                \
    return value;                                                                                  \
  }
// A setter and a getter of a member of the data.
#define PCL_FLOATER_OPTION(Name, Type, parameter, member)                                          \
  void ReconstructionState::set##Name (Type parameter)                                             \
  {                                                                                                \
    data_->member = parameter;                                                                     \
  }                                                                                                \
  PCL_FLOATER_GETTER (Name, Type, data_->member)
#define PCL_FLOATER_CALLBACK(Name, Type, member)                                                   \
  void ReconstructionState::set##Name (Type callback)                                              \
  {                                                                                                \
    data_->member = std::move (callback);                                                          \
  }                                                                                                \
  PCL_FLOATER_GETTER (Name, const Type&, data_->member)

namespace {
using Place = std::array<double, 3>;

pcl::Indices
toPcl (const std::vector<std::uint32_t>& indices)
{
  return pcl::Indices (indices.begin (), indices.end ());
}
} // namespace

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
PCL_FLOATER_GETTER (LargestHole, double, data_->options.holes.largest_hole)
PCL_FLOATER_GETTER (LargestHoleUnit, LengthUnit, data_->options.holes.unit)
PCL_FLOATER_GETTER (ViewPoint, const Place&, data_->options.view.viewpoint)
PCL_FLOATER_GETTER (DiscOptions, const DiscOptions&, data_->options.disc)
PCL_FLOATER_GETTER (PrescribedLoop, const pcl::Indices&, data_->prescribed_loop)
PCL_FLOATER_GETTER (NumberOfThreads, unsigned int, static_cast<unsigned int> (data_->options.threads))

PCL_FLOATER_GETTER (Status, RunStatus, data_->report.status)
PCL_FLOATER_GETTER (Message, const std::string&, data_->report.message)
PCL_FLOATER_GETTER (Report, const Report&, data_->report)
PCL_FLOATER_GETTER (Statistics, const Statistics&, data_->report.statistics)
PCL_FLOATER_GETTER (MeshCheck, const MeshCheck&, data_->report.check)
PCL_FLOATER_GETTER (BoundaryLoop, pcl::Indices, toPcl (data_->report.loop))
PCL_FLOATER_GETTER (Parameters, const std::vector<Vector2d>&, data_->report.parameters)
PCL_FLOATER_GETTER (Normals, const Normals&, data_->mesh.normals)
PCL_FLOATER_GETTER (TextureCoordinates, const TextureCoordinates&, data_->mesh.texture)
PCL_FLOATER_GETTER (PartIDs, std::vector<int>, data_->mesh.parts)
PCL_FLOATER_GETTER (PointStates, std::vector<int>, std::vector<int> (data_->mesh.states.begin (), data_->mesh.states.end ()))
PCL_FLOATER_GETTER (UnusedIndices, pcl::Indices, toPcl (data_->report.unused))
PCL_FLOATER_GETTER (OutlierIndices, pcl::Indices, toPcl (data_->report.outliers))
PCL_FLOATER_GETTER (ScatterIndices, pcl::Indices, toPcl (data_->report.scatter))
PCL_FLOATER_GETTER (NonFiniteIndices, pcl::Indices, toPcl (data_->report.non_finite))
// clang-format on
#undef PCL_FLOATER_OPTION
#undef PCL_FLOATER_CALLBACK
#undef PCL_FLOATER_GETTER

void
ReconstructionState::setLargestHole (double size, LengthUnit unit)
{
  data_->options.holes.largest_hole = size;
  data_->options.holes.unit = unit;
}

void
ReconstructionState::setViewPoint (double x, double y, double z)
{
  data_->options.view = {ViewUse::GIVEN, {x, y, z}};
}

void
ReconstructionState::setDiscOptions (const DiscOptions& options)
{
  data_->options.disc = options;
  data_->prescribed_loop.assign (options.boundary.loop.begin (), options.boundary.loop.end ());
}

void
ReconstructionState::setPrescribedLoop (const pcl::Indices& loop)
{
  data_->prescribed_loop = loop;
  data_->options.disc.boundary.loop.assign (loop.begin (), loop.end ());
}

void
ReconstructionState::setNumberOfThreads (unsigned int nr_threads)
{
  data_->options.threads = static_cast<int> (nr_threads);
}

std::vector<std::array<pcl::index_t, 2>>
ReconstructionState::getDuplicates () const
{
  std::vector<std::array<pcl::index_t, 2>> duplicates;
  duplicates.reserve (data_->report.duplicates.size ());
  for (const auto& [point, other] : data_->report.duplicates)
    duplicates.push_back ({static_cast<pcl::index_t> (point), static_cast<pcl::index_t> (other)});
  return duplicates;
}

} // namespace pcl::floater
