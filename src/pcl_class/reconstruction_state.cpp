// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/surface/floater/reconstruction_state.h>
#include <pcl/surface/floater/vertex_normals.h>

#include "core/disjoint_sets.h"
#include "core/problem.h"
#include "pcl_class/pcl_neighborhoods.h"
#include "pcl_class/reconstruction_data.h"

#include <pcl/PolygonMesh.h>
#include <pcl/TextureMesh.h>
#include <pcl/console/print.h>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

namespace pcl::floater {
namespace {
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
  std::vector<bool> is_used (size);
  for (const std::array<std::uint32_t, 3>& t : triangles) {
    sets.join (t[0], t[1]);
    sets.join (t[0], t[2]);
    for (const std::uint32_t p : t)
      is_used[p] = true;
  }
  const std::vector<Index> numbers =
      std::move (sets).number ([&is_used] (Index first) { return is_used[first]; });
  return {numbers.begin (), numbers.end ()}; // NONE becomes -1
}

// Whether each of `size` points is on a boundary loop of a consistently oriented manifold.
std::vector<bool>
boundaryOf (const std::vector<std::array<std::uint32_t, 3>>& triangles, std::size_t size)
{
  // Each triangle at a point steps from one neighbour to the next. The steps of an open fan add up
  // to last minus first neighbour, the steps of a closed one to 0.
  std::vector<std::uint32_t> way (size, 0);
  for (const std::array<std::uint32_t, 3>& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      way[t[i]] += t[(i + 2) % 3] - t[(i + 1) % 3];
  std::vector<bool> is_boundary (size);
  for (std::size_t p = 0; p < size; ++p)
    is_boundary[p] = way[p] != 0;
  return is_boundary;
}

// State of each point.
// \param components from componentsOf ()
// \param is_selected of each point: was to be reconstructed
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

// The texture coordinates, as the second half of a run that asks for them.
class TexturePart
{
public:
  // Copies the positions, and scales the progress of the reconstruction to the first half.
  TexturePart (bool is_wanted, double largest_stretch, const Input& input, Options& options)
      : is_wanted_ (is_wanted)
  {
    if (!is_wanted)
      return;
    positions_.assign (input.cloud_size,
                       Eigen::Vector3d::Constant (std::numeric_limits<double>::quiet_NaN ()));
    for (std::size_t i = 0; i < input.positions.size (); ++i)
      positions_[input.cloud_index[i]] = input.positions[i];
    texture_options_.largest_stretch = largest_stretch;
    texture_options_.cancelled_callback = options.cancelled_callback;
    const std::function<void (double)> tell = options.progress_callback;
    if (!tell)
      return;
    constexpr double FIRST_PART = 0.5;
    options.progress_callback = [tell] (double done) { tell (FIRST_PART * done); };
    texture_options_.progress_callback = [tell] (double done) {
      tell (FIRST_PART + (1.0 - FIRST_PART) * done);
    };
  }

  // Its failure becomes the failure of the run.
  TextureCoordinates compute (int threads, Result& result)
  {
    Report& report = result.report;
    if (!is_wanted_ || report.status != RunStatus::SUCCESS)
      return {};
    texture_options_.threads = threads;
    texture_options_.whole_discs = report.topology == Topology::DISC;
    TextureCoordinates texture =
        computeTextureCoordinates (positions_, result.triangles, texture_options_);
    if (texture.status != RunStatus::SUCCESS) {
      result.triangles.clear ();
      report.status = texture.status;
      report.message = "texture coordinates: " + texture.message;
    }
    else if (texture.flipped > 0)
      report.warnings.push_back (std::to_string (texture.flipped) +
                                 " triangles are upside down in the texture: they are too small "
                                 "beside the mesh for 32 bits");
    return texture;
  }

private:
  bool is_wanted_;
  std::vector<Eigen::Vector3d> positions_; // of the whole cloud
  TextureOptions texture_options_;
};

// PCL has TextureMesh::tex_coord_indices from 1.12.1 on.
template <typename Mesh>
auto
setCoordinateIndices (Mesh& mesh, int) -> decltype (mesh.tex_coord_indices, void ())
{
  mesh.tex_coord_indices.assign (1, mesh.tex_polygons.front ());
  pcl::index_t next = 0;
  for (pcl::Vertices& polygon : mesh.tex_coord_indices.front ())
    for (auto& index : polygon.vertices)
      index = next++;
}

template <typename Mesh>
void
setCoordinateIndices (Mesh&, long)
{
}

} // namespace

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

const TextureCoordinates&
ReconstructionState::getTextureCoordinates () const
{
  return data_->texture;
}

void
ReconstructionState::makeTextureMesh (pcl::PolygonMesh& mesh, pcl::TextureMesh& output) const
{
  output = pcl::TextureMesh ();
  output.header = mesh.header;
  output.cloud = std::move (mesh.cloud);
  output.tex_polygons.push_back (std::move (mesh.polygons));
  // One for each corner, in order, so that all versions of PCL write correct OBJ files.
  output.tex_coordinates.emplace_back ();
  for (const std::array<std::uint32_t, 3>& corners : data_->texture.corners)
    for (const std::uint32_t corner : corners)
      output.tex_coordinates.front ().push_back (data_->texture.coordinates[corner]);
  setCoordinateIndices (output, 0);
  pcl::TexMaterial material;
  material.tex_name = "surface";
  material.tex_Ka = {};
  material.tex_Kd.r = material.tex_Kd.g = material.tex_Kd.b = 1.0F;
  material.tex_Ks = {};
  material.tex_d = 1.0F;
  material.tex_Ns = 0.0F;
  material.tex_illum = 1;
  output.tex_materials.push_back (material);
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

const std::vector<Eigen::Vector3f>&
ReconstructionState::getNormals () const
{
  return data_->normals;
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
  data_->texture = TextureCoordinates ();
  data_->parts.clear ();
  data_->states.clear ();
  data_->normals.clear ();
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
  data_->normals.clear ();
  data_->texture = TextureCoordinates ();
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
  // Negative indices become too large by the conversion.
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
  Options options = data_->options; // a callback may set options for the next run
  std::vector<bool> is_selected (input.cloud_size, false);
  for (const std::uint32_t p : input.cloud_index)
    is_selected[p] = true;
  std::unique_ptr<PclNeighborhoods> by_pcl; // TW 385 as built from PCL
  if (options.disc.as_published && input.search == nullptr) {
    by_pcl = std::make_unique<PclNeighborhoods> (input);
    input.search = &by_pcl->search ();
    if (input.normals.empty ())
      input.normals = by_pcl->normals (options.neighbors.k);
  }
  std::vector<Eigen::Vector3d>
      positions; // of the whole cloud; reconstruct () consumes those of the input
  if (data_->compute_normals) {
    positions.resize (input.cloud_size);
    for (std::size_t i = 0; i < input.positions.size (); ++i)
      positions[input.cloud_index[i]] = input.positions[i];
  }
  TexturePart texture (data_->computes_texture, data_->largest_stretch, input, options);
  Result result = reconstruct (std::move (input), options);
  data_->texture = texture.compute (options.threads, result);
  data_->report = std::move (result.report);
  if (data_->report.status == RunStatus::SUCCESS) {
    data_->parts = componentsOf (result.triangles, is_selected.size ());
    data_->states =
        statesOf (result.triangles, data_->parts, is_selected, data_->report.non_finite);
    if (!positions.empty ())
      data_->normals = vertexNormals (positions, result.triangles, options.threads);
  }
  return std::move (result.triangles);
}

void
ReconstructionState::printOutcome (const std::string& class_name) const
{
  const Report& report = data_->report;
  const char* const name = class_name.c_str ();
  if (report.status == RunStatus::CANCELLED) // as requested: no error
    PCL_WARN ("[pcl::%s::performReconstruction] %s: %s\n", name, statusName (report.status),
              report.message.c_str ());
  else if (report.status != RunStatus::SUCCESS)
    PCL_ERROR ("[pcl::%s::performReconstruction] %s: %s\n", name, statusName (report.status),
               report.message.c_str ());
  else
    for (const std::string& warning : report.warnings)
      PCL_WARN ("[pcl::%s::performReconstruction] %s\n", name, warning.c_str ());
}

} // namespace pcl::floater
