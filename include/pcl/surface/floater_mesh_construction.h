// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// FloaterReconstruction for programs that are built on pcl::MeshConstruction.
#pragma once

#include <pcl/surface/floater_reconstruction.h>
#include <pcl/surface/reconstruction.h>

#include <string>
#include <vector>

namespace pcl {
/** \brief FloaterReconstruction as a pcl::MeshConstruction, the base of
 * pcl::GreedyProjectionTriangulation and pcl::OrganizedFastMesh: takes their place in a program.
 *
 * \code
 * pcl::MeshConstruction<pcl::PointXYZ>::Ptr mesher (new
 * pcl::FloaterMeshConstruction<pcl::PointXYZ>); mesher->setInputCloud (cloud);
 * std::vector<pcl::Vertices> triangles;
 * mesher->reconstruct (triangles);
 * \endcode
 *
 * Each run takes the cloud, the indices and the search method of this object. Options are set, and
 * results are read, in floater().
 *
 * It does what FloaterReconstruction does: it needs no normals, does not throw, and after a failure
 * the output is empty, also without an input cloud.
 * \ingroup surface
 */
template <typename PointT>
class FloaterMeshConstruction : public MeshConstruction<PointT>
{
public:
  using Ptr = shared_ptr<FloaterMeshConstruction<PointT>>;
  using ConstPtr = shared_ptr<const FloaterMeshConstruction<PointT>>;

  /** \brief All options at their defaults, which need no tuning. */
  FloaterMeshConstruction () { check_tree_ = false; }

  /** \brief What makes the mesh, to set its options and to read its results. */
  FloaterReconstruction<PointT>& floater () { return floater_; }
  /** \brief What makes the mesh, to read its options and results. */
  const FloaterReconstruction<PointT>& floater () const { return floater_; }

  /** \brief Reconstructs the surface of setInputCloud() and setIndices().
   * \param[out] output the whole input cloud and the triangles; its header is that of the input */
  void reconstruct (pcl::PolygonMesh& output) override { performReconstruction (output); }

  /** \brief Reconstructs the surface of setInputCloud() and setIndices().
   * \param[out] polygons the triangles, as indices of the whole cloud */
  void reconstruct (std::vector<pcl::Vertices>& polygons) override
  {
    performReconstruction (polygons);
  }

protected:
  using MeshConstruction<PointT>::check_tree_;
  using MeshConstruction<PointT>::fake_indices_;
  using MeshConstruction<PointT>::indices_;
  using MeshConstruction<PointT>::input_;
  using MeshConstruction<PointT>::tree_;

  std::string getClassName () const override { return "FloaterMeshConstruction"; }

  void performReconstruction (pcl::PolygonMesh& output) override
  {
    passInput ();
    floater_.reconstruct (output);
  }

  void performReconstruction (std::vector<pcl::Vertices>& polygons) override
  {
    passInput ();
    floater_.reconstruct (polygons);
  }

private:
  void passInput ()
  {
    floater_.setInputCloud (input_);
    floater_.setIndices (fake_indices_ ? pcl::IndicesPtr () : indices_);
    floater_.setSearchMethod (tree_);
  }

  FloaterReconstruction<PointT> floater_;
};

} // namespace pcl
