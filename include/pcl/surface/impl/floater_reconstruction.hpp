// SPDX-License-Identifier: GPL-3.0-or-later
// Passes the points of PCL's clouds to the core, and indices back.
#pragma once

#include <pcl/console/print.h>
#include <pcl/search/search.h>
#include <pcl/surface/floater_reconstruction.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <new>

namespace pcl
{
namespace floater
{
/// Lets the core use a search method of PCL.
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
    // By point, not by index: an index would count among the points given to build ().
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
    cloud_indices.resize (count);
    for (std::size_t i = 0; i < count; ++i)
      cloud_indices[i] = static_cast<std::uint32_t> (found_[i]);
  }

  typename pcl::search::Search<PointT>::Ptr search_;
  typename pcl::PointCloud<PointT>::ConstPtr cloud_;
  pcl::Indices found_;
  std::vector<float> sqr_distances_;
};

} // namespace floater

template <typename PointT>
bool
FloaterReconstruction<PointT>::fail (floater::RunStatus status, const std::string& message)
{
  report_.status = status;
  report_.message = message;
  return false;
}

template <typename PointT>
bool
FloaterReconstruction<PointT>::guarded (const std::function<void ()>& reconstruction)
{
  report_ = floater::Report ();
  try {
    // Checked here: the base class dereferences a null pointer, and accepts an empty cloud.
    if (!input_)
      fail (floater::RunStatus::NO_INPUT, "no input cloud: call setInputCloud () first");
    else if (input_->empty ())
      fail (floater::RunStatus::NO_INPUT, "the input cloud is empty");
    else
      reconstruction ();
  }
  catch (const std::bad_alloc&) {
    report_.status = floater::RunStatus::OUT_OF_MEMORY;
    report_.message = "out of memory"; // so short that the string takes no memory
  }
  catch (const std::exception& error) {
    fail (floater::RunStatus::INTERNAL_ERROR, std::string ("unexpected error: ") + error.what ());
  }
  catch (...) {
    fail (floater::RunStatus::INTERNAL_ERROR, "unexpected error of unknown type");
  }
  const bool has_mesh = report_.status == floater::RunStatus::SUCCESS;
  try {
    if (report_.status == floater::RunStatus::CANCELLED) // as asked for: no error
      PCL_WARN ("[pcl::%s::performReconstruction] %s: %s\n", getClassName ().c_str (),
                floater::statusName (report_.status), report_.message.c_str ());
    else if (!has_mesh)
      PCL_ERROR ("[pcl::%s::performReconstruction] %s: %s\n", getClassName ().c_str (),
                 floater::statusName (report_.status), report_.message.c_str ());
    else
      for (const std::string& warning : report_.warnings)
        PCL_WARN ("[pcl::%s::performReconstruction] %s\n", getClassName ().c_str (),
                  warning.c_str ());
  }
  catch (const std::bad_alloc&) {
    // No memory to print; the report tells the same.
  }
  return has_mesh;
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
FloaterReconstruction<PointT>::performReconstruction (pcl::PolygonMesh& output)
{
  triangulate (output.polygons); // the base class copies the cloud
}

template <typename PointT>
void
FloaterReconstruction<PointT>::performReconstruction (PointCloud& points,
                                                      std::vector<pcl::Vertices>& polygons)
{
  triangulate (polygons);
  points = *input_;
}

template <typename PointT>
bool
FloaterReconstruction<PointT>::makeInput (floater::Input& input)
{
  constexpr std::size_t MAX_POINTS = std::numeric_limits<std::uint32_t>::max ();
  const std::size_t size = input_->size ();
  report_.statistics.cloud_points = size;
  const std::string outside_the_cloud =
      " is outside the cloud of " + std::to_string (size) + (size == 1 ? " point" : " points");
  if (size > MAX_POINTS)
    return fail (floater::RunStatus::OUT_OF_MEMORY, "the cloud has more than " +
                                                        std::to_string (MAX_POINTS) +
                                                        " points; reconstruct parts of it");
  // If memory runs out, PCLBase continues with fewer indices than there are points.
  if (fake_indices_ && indices_->size () != size)
    throw std::bad_alloc ();

  // The conversion makes negative indices too large.
  const auto is_outside = [size] (pcl::index_t index) {
    return static_cast<std::size_t> (index) >= size;
  };
  const auto outside = std::find_if (indices_->begin (), indices_->end (), is_outside);
  if (outside != indices_->end ())
    return fail (floater::RunStatus::INVALID_INDICES,
                 "index " + std::to_string (*outside) + outside_the_cloud);
  const auto outside_in_loop =
      std::find_if (prescribed_loop_.begin (), prescribed_loop_.end (), is_outside);
  if (outside_in_loop != prescribed_loop_.end ())
    return fail (floater::RunStatus::INVALID_LOOP, "point " + std::to_string (*outside_in_loop) +
                                                       " of the given boundary loop" +
                                                       outside_the_cloud);

  input.cloud_size = size;
  for (std::size_t axis = 0; axis < 3; ++axis)
    input.sensor_origin[axis] =
        static_cast<double> (input_->sensor_origin_[static_cast<Eigen::Index> (axis)]);
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
  return true;
}

template <typename PointT>
void
FloaterReconstruction<PointT>::triangulate (std::vector<pcl::Vertices>& polygons)
{
  polygons.clear ();
  floater::Input input;
  if (!makeInput (input))
    return;
  floater::SearchMethod<PointT> search (tree_, input_);
  if (tree_)
    input.search = &search;

  floater::Result result = floater::reconstruct (std::move (input), options_);
  report_ = std::move (result.report);
  polygons.resize (result.triangles.size ());
  for (std::size_t t = 0; t < polygons.size (); ++t)
    polygons[t].vertices.assign (result.triangles[t].begin (), result.triangles[t].end ());
}

template <typename PointT>
pcl::Indices
FloaterReconstruction<PointT>::getBoundaryLoop () const
{
  return pcl::Indices (report_.loop.begin (), report_.loop.end ());
}

template <typename PointT>
pcl::Indices
FloaterReconstruction<PointT>::getUnusedIndices () const
{
  return pcl::Indices (report_.unused.begin (), report_.unused.end ());
}

template <typename PointT>
pcl::Indices
FloaterReconstruction<PointT>::getOutlierIndices () const
{
  return pcl::Indices (report_.outliers.begin (), report_.outliers.end ());
}

template <typename PointT>
pcl::Indices
FloaterReconstruction<PointT>::getScatterIndices () const
{
  return pcl::Indices (report_.scatter.begin (), report_.scatter.end ());
}

template <typename PointT>
pcl::Indices
FloaterReconstruction<PointT>::getNonFiniteIndices () const
{
  return pcl::Indices (report_.non_finite.begin (), report_.non_finite.end ());
}

template <typename PointT>
std::vector<std::array<pcl::index_t, 2>>
FloaterReconstruction<PointT>::getDuplicates () const
{
  std::vector<std::array<pcl::index_t, 2>> duplicates;
  duplicates.reserve (report_.duplicates.size ());
  for (const std::array<std::uint32_t, 2>& pair : report_.duplicates)
    duplicates.push_back (
        {static_cast<pcl::index_t> (pair[0]), static_cast<pcl::index_t> (pair[1])});
  return duplicates;
}

} // namespace pcl

// For the library only: with PCL_NO_PRECOMPILE, PCL_INSTANTIATE does nothing.
#define PCL_INSTANTIATE_FloaterReconstruction(T)                                                   \
  template class PCL_FLOATER_EXPORT pcl::FloaterReconstruction<T>;
