// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/surface/floater/reconstruction_state.h>
#include <pcl/surface/floater/vertex_normals.h>

#include "core/disjoint_sets.h"
#include "core/problem.h"
#include "pcl_class/reconstruction_data.h"

#include <pcl/PolygonMesh.h>
#include <pcl/TextureMesh.h>
#include <pcl/console/print.h>
#include <pcl/features/impl/normal_3d.hpp>
#include <pcl/features/normal_3d.h>
#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/impl/floater_reconstruction.hpp>

namespace pcl::floater {
namespace {
constexpr float NAN_32 = std::numeric_limits<float>::quiet_NaN ();

// The whole cloud; points that are not selected are not finite.
pcl::PointCloud<pcl::PointXYZ>::Ptr
cloudOf (const Input& input)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>> ();
  cloud->resize (input.cloud_size, pcl::PointXYZ (NAN_32, NAN_32, NAN_32));
  cloud->is_dense = false;
  for (std::size_t row = 0; row < input.positions.size (); ++row)
    (*cloud)[input.cloud_index[row]].getVector3fMap () = input.positions[row].cast<float> ();
  return cloud;
}

// For each point of the whole cloud, by pcl::NormalEstimation: normal of the plane through it and its k
// nearest; NaN for points that are not selected or not finite.
Normals
estimateNormals (const Input& input, int k)
{
  const auto cloud = cloudOf (input);
  Normals normals (cloud->size (), Vector3f::Constant (NAN_32));
  if (std::none_of (cloud->begin (), cloud->end (),
                    [] (const pcl::PointXYZ& point) { return pcl::isFinite (point); }))
    return normals;
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud (cloud);
  estimation.setSearchMethod (pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>> ());
  estimation.setKSearch (k + 1); // PCL counts the point itself
  pcl::PointCloud<pcl::Normal> estimated;
  estimation.compute (estimated);
  for (std::size_t p = 0; p < estimated.size (); ++p)
    normals[p] = estimated[p].getNormalVector3fMap ();
  return normals;
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

// State of each point.
// \param triangles a consistently oriented manifold
// \param components from componentsOf ()
// \param is_selected of each point: was to be reconstructed
std::vector<std::int8_t>
statesOf (const std::vector<std::array<std::uint32_t, 3>>& triangles,
          const std::vector<int>& components, const std::vector<bool>& is_selected,
          const std::vector<std::uint32_t>& non_finite)
{
  using State = ReconstructionState::PointState;
  const std::size_t size = is_selected.size ();
  // Each triangle at a point steps from one neighbour to the next. The steps of an open fan add up
  // to last minus first neighbour, the steps of a closed one to 0.
  std::vector<std::uint32_t> way (size, 0);
  for (const std::array<std::uint32_t, 3>& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      way[t[i]] += t[(i + 2) % 3] - t[(i + 1) % 3];
  std::vector<std::int8_t> states (size, State::NONE);
  for (std::size_t p = 0; p < size; ++p)
    if (components[p] >= 0)
      states[p] = way[p] != 0 ? State::BOUNDARY : State::COMPLETED;
    else if (is_selected[p])
      states[p] = State::FREE;
  for (const std::uint32_t p : non_finite)
    states[p] = State::NONE;
  return states;
}

// Options of the texture coordinates, whose progress becomes the second half of that of a run.
TextureOptions
textureOptions (double largest_stretch, Options& options)
{
  constexpr double FIRST_PART = 0.5;
  TextureOptions texture;
  texture.largest_stretch = largest_stretch;
  texture.threads = options.threads;
  texture.cancelled_callback = options.cancelled_callback;
  if (const std::function<void (double)> tell = options.progress_callback) {
    options.progress_callback = [tell] (double done) { tell (FIRST_PART * done); };
    texture.progress_callback = [tell] (double done) {
      tell (FIRST_PART + (1.0 - FIRST_PART) * done);
    };
  }
  return texture;
}

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

void
ReconstructionState::makeTextureMesh (pcl::PolygonMesh& mesh, pcl::TextureMesh& output) const
{
  output = pcl::TextureMesh ();
  output.header = mesh.header;
  output.cloud = std::move (mesh.cloud);
  output.tex_polygons.push_back (std::move (mesh.polygons));
  // One for each corner, in order, so that all versions of PCL write correct OBJ files.
  output.tex_coordinates.emplace_back ();
  for (const std::array<std::uint32_t, 3>& corners : data_->mesh.texture.corners)
    for (const std::uint32_t corner : corners)
      output.tex_coordinates.front ().push_back (data_->mesh.texture.coordinates[corner]);
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

void
ReconstructionState::beginRun ()
{
  data_->report = {};
  data_->mesh = {};
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
  data_->mesh = {};
  Problem problem = problemOfException ();
  data_->report.status = problem.status;
  data_->report.message = std::move (problem.message);
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
  const auto areInside = [&] (const pcl::Indices& some, RunStatus status, const char* what,
                              const char* where) {
    for (const pcl::index_t index : some)
      if (static_cast<std::size_t> (index) >= size) { // also negative ones, by the conversion
        fail (status, what + std::to_string (index) + where + outside_the_cloud);
        return false;
      }
    return true;
  };
  return areInside (indices, RunStatus::INVALID_INDICES, "index ", "") &&
         areInside (data_->prescribed_loop, RunStatus::INVALID_LOOP, "point ",
                    " of the given boundary loop");
}

std::vector<std::array<std::uint32_t, 3>>
ReconstructionState::triangulatePoints (Input&& input)
{
  Options options = data_->options; // a callback may set options for the next run
  std::vector<bool> is_selected (input.cloud_size, false);
  for (const std::uint32_t p : input.cloud_index)
    is_selected[p] = true;
  // TW 385 as built from PCL; the core's own are faster. Both copy the points, in single precision.
  std::unique_ptr<NeighborSearch> by_pcl;
  if (options.disc.as_published && input.search == nullptr) {
    by_pcl = std::make_unique<SearchMethod<pcl::PointXYZ>> (
        pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>> (), cloudOf (input));
    input.search = by_pcl.get ();
    if (input.normals.empty ())
      input.normals = estimateNormals (input, options.neighbors.k);
  }
  const bool computes_normals = data_->compute_normals, computes_texture = data_->computes_texture;
  Positions positions; // of the whole cloud; those of the input are consumed
  if (computes_normals || computes_texture) {
    positions.assign (input.cloud_size,
                      Vector3d::Constant (std::numeric_limits<double>::quiet_NaN ()));
    for (std::size_t i = 0; i < input.positions.size (); ++i)
      positions[input.cloud_index[i]] = input.positions[i];
  }
  TextureOptions texture_options;
  if (computes_texture)
    texture_options = textureOptions (data_->largest_stretch, options);
  Result result = reconstruct (std::move (input), options);
  if (computes_texture && result.report.status == RunStatus::SUCCESS) {
    texture_options.whole_discs = result.report.topology == Topology::DISC;
    data_->mesh.texture = computeTextureCoordinates (positions, result.triangles, texture_options);
    Report& report = result.report;
    if (data_->mesh.texture.status != RunStatus::SUCCESS) { // becomes the failure of the run
      result.triangles.clear ();
      report.status = data_->mesh.texture.status;
      report.message = "texture coordinates: " + data_->mesh.texture.message;
    }
    else if (data_->mesh.texture.flipped > 0)
      report.warnings.push_back (std::to_string (data_->mesh.texture.flipped) +
                                 " triangles are upside down in the texture: they are too small "
                                 "beside the mesh for 32 bits");
  }
  data_->report = std::move (result.report);
  if (data_->report.status == RunStatus::SUCCESS) {
    data_->mesh.parts = componentsOf (result.triangles, is_selected.size ());
    data_->mesh.states =
        statesOf (result.triangles, data_->mesh.parts, is_selected, data_->report.non_finite);
    if (computes_normals)
      data_->mesh.normals = vertexNormals (positions, result.triangles, options.threads);
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

PCL_INSTANTIATE (FloaterReconstruction, PCL_XYZ_POINT_TYPES)
