// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Passes the points of PCL's clouds to the core, and indices back.
#pragma once

#include <pcl/PCLPointCloud2.h>
#include <pcl/search/search.h>
#include <pcl/surface/floater_reconstruction.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <utility>
#include <vector>

namespace pcl {
namespace floater {
/// Adapts a search method of PCL to the core.
template <typename PointT>
class SearchMethod : public NeighborSearch
{
public:
  SearchMethod (typename pcl::search::Search<PointT>::Ptr search,
                typename pcl::PointCloud<PointT>::ConstPtr cloud)
      : search_ (std::move (search)), cloud_ (std::move (cloud))
  {
  }

  void build (const std::vector<std::uint32_t>& cloud_indices) override
  {
    search_->setInputCloud (
        cloud_, pcl::make_shared<pcl::Indices> (cloud_indices.begin (), cloud_indices.end ()));
  }

  void nearest (std::uint32_t cloud_index, int k,
                std::vector<std::uint32_t>& cloud_indices) override
  {
    // By point: an index would count among the points given to build ().
    copyFound (search_->nearestKSearch ((*cloud_)[cloud_index], k, found_, sqr_distances_),
               cloud_indices);
  }

  bool within (std::uint32_t cloud_index, double radius,
               std::vector<std::uint32_t>& cloud_indices) override
  {
    copyFound (search_->radiusSearch ((*cloud_)[cloud_index], radius, found_, sqr_distances_),
               cloud_indices);
    return true;
  }

private:
  void copyFound (int found, std::vector<std::uint32_t>& cloud_indices) const
  {
    const std::size_t count =
        std::min (static_cast<std::size_t> (std::max (found, 0)), found_.size ());
    cloud_indices.assign (found_.data (), found_.data () + count);
  }

  typename pcl::search::Search<PointT>::Ptr search_;
  typename pcl::PointCloud<PointT>::ConstPtr cloud_;
  pcl::Indices found_;
  std::vector<float> sqr_distances_;
};

/// Writes normals into the fields normal_x, normal_y and normal_z of a cloud. Appends these fields
/// to its points if they have none of type float.
/// \param normals one for each point of the cloud
inline void
writeNormals (const std::vector<Eigen::Vector3f>& normals, pcl::PCLPointCloud2& cloud)
{
  std::array<std::size_t, 3> offsets{};
  const std::array<const char*, 3> names{"normal_x", "normal_y", "normal_z"};
  std::size_t step = cloud.point_step;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = std::find_if (
        cloud.fields.begin (), cloud.fields.end (), [&] (const pcl::PCLPointField& field) {
          return field.name == names[axis] && field.datatype == pcl::PCLPointField::FLOAT32;
        });
    if (found != cloud.fields.end ()) {
      offsets[axis] = found->offset;
      continue;
    }
    pcl::PCLPointField field;
    field.name = names[axis];
    field.offset = static_cast<std::uint32_t> (step);
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back (field);
    offsets[axis] = step;
    step += sizeof (float);
  }
  if (step != cloud.point_step) {
    std::vector<std::uint8_t> data (normals.size () * step);
    for (std::size_t p = 0; p < normals.size (); ++p)
      std::copy_n (cloud.data.begin () + static_cast<std::ptrdiff_t> (p * cloud.point_step),
                   cloud.point_step, data.begin () + static_cast<std::ptrdiff_t> (p * step));
    cloud.data = std::move (data);
    cloud.point_step = static_cast<std::uint32_t> (step);
    cloud.row_step = cloud.point_step * cloud.width;
  }
  for (std::size_t p = 0; p < normals.size (); ++p)
    for (std::size_t axis = 0; axis < 3; ++axis)
      std::memcpy (cloud.data.data () + p * step + offsets[axis],
                   &normals[p][static_cast<Eigen::Index> (axis)], sizeof (float));
}

} // namespace floater

template <typename PointT>
template <typename Work>
bool
FloaterReconstruction<PointT>::guarded (const Work& work)
{
  beginRun ();
  try {
    // Checked here: the base class dereferences a null pointer, and accepts an empty cloud.
    if (!input_)
      fail (floater::RunStatus::NO_INPUT, "no input cloud: call setInputCloud () first");
    else if (input_->empty ())
      fail (floater::RunStatus::NO_INPUT, "the input cloud is empty");
    else
      work ();
  }
  catch (...) {
    failByException ();
  }
  try {
    printOutcome (getClassName ());
  }
  catch (const std::bad_alloc&) {
    // No memory to print; the report has the same message.
  }
  return getStatus () == floater::RunStatus::SUCCESS;
}

template <typename PointT>
void
FloaterReconstruction<PointT>::reconstruct (pcl::PolygonMesh& output)
{
  if (guarded ([this, &output] { SurfaceReconstruction<PointT>::reconstruct (output); }))
    return;
  output.cloud.width = output.cloud.height = output.cloud.row_step = 0;
  output.cloud.data.clear ();
  output.polygons.clear ();
}

template <typename PointT>
void
FloaterReconstruction<PointT>::reconstruct (PointCloud& points,
                                            std::vector<pcl::Vertices>& polygons)
{
  if (guarded ([&] { SurfaceReconstruction<PointT>::reconstruct (points, polygons); }))
    return;
  points.clear ();
  polygons.clear ();
}

template <typename PointT>
void
FloaterReconstruction<PointT>::reconstruct (std::vector<pcl::Vertices>& polygons)
{
  const auto work = [&] {
    if (!this->initCompute ())
      return;
    triangulate (polygons);
    this->deinitCompute ();
  };
  if (!guarded (work))
    polygons.clear ();
}

template <typename PointT>
void
FloaterReconstruction<PointT>::reconstruct (pcl::TextureMesh& output)
{
  const bool is_asked_for = getComputeTextureCoordinates ();
  setComputeTextureCoordinates (true);
  pcl::PolygonMesh mesh;
  reconstruct (mesh);
  setComputeTextureCoordinates (is_asked_for);
  output = pcl::TextureMesh ();
  output.header = mesh.header;
  if (getStatus () != floater::RunStatus::SUCCESS)
    return;
  try {
    makeTextureMesh (mesh, output);
  }
  catch (const std::bad_alloc&) {
    output = pcl::TextureMesh ();
    failByException ();
  }
}

template <typename PointT>
void
FloaterReconstruction<PointT>::performReconstruction (pcl::PolygonMesh& output)
{
  triangulate (output.polygons); // the base class copies the cloud
  if (!getNormals ().empty ())
    floater::writeNormals (getNormals (), output.cloud);
}

template <typename PointT>
void
FloaterReconstruction<PointT>::performReconstruction (PointCloud& points,
                                                      std::vector<pcl::Vertices>& polygons)
{
  triangulate (polygons);
  points = *input_;
  if constexpr (pcl::traits::has_normal<PointT>::value)
    for (std::size_t p = 0; p < getNormals ().size (); ++p) {
      const Eigen::Vector3f& normal = getNormals ()[p];
      points[p].normal_x = normal.x ();
      points[p].normal_y = normal.y ();
      points[p].normal_z = normal.z ();
    }
}

template <typename PointT>
void
FloaterReconstruction<PointT>::triangulate (std::vector<pcl::Vertices>& polygons)
{
  polygons.clear ();
  const std::size_t size = input_->size ();
  // If memory runs out, PCLBase continues with too few indices.
  if (fake_indices_ && indices_->size () != size)
    throw std::bad_alloc ();
  if (!checkCloud (size, *indices_))
    return;
  floater::Input input;
  input.cloud_size = size;
  Eigen::Map<Eigen::Vector3d> (input.sensor_origin.data ()) =
      input_->sensor_origin_.template head<3> ().template cast<double> ();
  input.positions.reserve (indices_->size ());
  input.cloud_index.reserve (indices_->size ());
  std::vector<bool> taken (size, false);
  for (pcl::index_t index : *indices_) {
    const auto row = static_cast<std::size_t> (index);
    if (taken[row])
      continue;
    taken[row] = true;
    const PointT& point = (*input_)[row];
    input.positions.emplace_back (point.x, point.y, point.z);
    input.cloud_index.push_back (static_cast<std::uint32_t> (row));
  }
  const bool for_planes = getUseInputNormals ();
  const bool for_facing = getFacing () == floater::Facing::NORMALS ||
                          (getFacing () == floater::Facing::AUTO && for_planes);
  if constexpr (pcl::traits::has_normal<PointT>::value) {
    std::vector<Eigen::Vector3f> normals;
    if (for_planes || for_facing) {
      normals.reserve (size);
      for (const PointT& point : *input_)
        normals.emplace_back (point.normal_x, point.normal_y, point.normal_z);
    }
    if (for_planes)
      input.normals = normals;
    if (for_facing)
      input.facing_normals = std::move (normals);
  }
  else if (for_planes) {
    fail (floater::RunStatus::INVALID_OPTION,
          "the points have no normals that could be used: take a point type with normals, or call "
          "setUseInputNormals (false)");
    return;
  }
  floater::SearchMethod<PointT> search (tree_, input_);
  if (tree_)
    input.search = &search;

  const std::vector<std::array<std::uint32_t, 3>> triangles = triangulatePoints (std::move (input));
  polygons.resize (triangles.size ());
  for (std::size_t t = 0; t < polygons.size (); ++t)
    polygons[t].vertices.assign (triangles[t].begin (), triangles[t].end ());
}

} // namespace pcl

// For the library only: with PCL_NO_PRECOMPILE, PCL_INSTANTIATE does nothing.
#define PCL_INSTANTIATE_FloaterReconstruction(T)                                                   \
  template class PCL_FLOATER_EXPORT pcl::FloaterReconstruction<T>;
