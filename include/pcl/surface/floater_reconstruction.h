// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surface reconstruction from unorganized points, as a class of PCL.
#pragma once

#include <pcl/TextureMesh.h>
#include <pcl/surface/floater/reconstruction_state.h>
#include <pcl/surface/reconstruction.h>
#include <pcl_floater/export.h>

#include <string>
#include <vector>

static_assert (
    EIGEN_DEFAULT_ALIGN_BYTES == PCL_FLOATER_EIGEN_ALIGNMENT,
    "this program is compiled for another instruction set than pcl_floater, such as with "
    "-mavx or -march=native: arrays of points that one of them makes and the other frees "
    "would end the program; compile both with the same flags");

namespace pcl {
/** \brief Reconstructs a surface from an unorganized point cloud, whose points are its vertices.
 *
 * \code
 * pcl::FloaterReconstruction<pcl::PointXYZ> floater;
 * floater.setInputCloud (cloud);
 * pcl::PolygonMesh mesh;
 * floater.reconstruct (mesh);
 * if (floater.getStatus () != pcl::floater::RunStatus::SUCCESS)
 *   std::cerr << floater.getMessage () << '\n';
 * \endcode
 *
 * There are three methods:
 *
 * - \b Consensus, by default: the neighbours of each point, projected on its tangent plane, have a
 *   Delaunay star there. The surface is put together from the triangles on which the stars of
 *   neighbouring points agree. It may be open or closed, with holes, handles or several components.
 *   Boundary loops that are gaps in the sampling are filled by minimum-cost triangulations.
 * - \b Disc: a surface with one boundary loop and no handles, however bent, is laid out in the
 * plane by Floater's meshless parameterization. The boundary loop is laid on a convex curve, and
 * every other point is a convex combination of its neighbours: one sparse linear system. The
 * Delaunay triangulation of the parameters gives the triangles.
 * - \b View: a single scan, of which every point is visible from the place of its sensor, is the
 *   Delaunay triangulation of its rays, without the triangles in gaps of the view and across depth
 *   steps. Noise along the rays does not disturb it.
 *
 * The view method is used where the spacing of the points tells that they are one scan (see
 * setViewUse()), or if the viewpoint is given. The disc method is used for Topology::DISC and where
 * the boundary loop is given. getReport() tells which method made the mesh, and why.
 *
 * After the first two methods, points without a triangle are inserted, edges are flipped in space,
 * folds are repaired, and every component is turned to face outwards: bodies where they are seen
 * from outside, walls of hollows into the hollow, terrain up, one scan towards the sensor if the
 * sensor_origin_ of the cloud is set.
 *
 * Sources: M. S. Floater, "Parametrization and smooth approximation of surface triangulations",
 * 1997; M. S. Floater and M. Reimers, "Meshless parameterization and surface reconstruction", 2001;
 * M. S. Floater, "Mean value coordinates", 2003; "Efficient triangulation of point clouds using
 * Floater parameterization", report TW 385, K.U.Leuven, 2004, called TW 385 below.
 *
 * - \b Input: points of a surface, of which x, y and z are read. Points with a NaN or an infinity,
 *   all but one of equal points, and outliers (see setRemoveOutliers()) are in no triangle.
 *   setIndices() selects points; an index given twice counts once.
 * - \b Output: the whole input cloud, unchanged and in its order, with every field of PointT; and
 *   one consistently oriented manifold of triangles. Their indices count in the whole cloud, also
 *   with setIndices(). The order of the points and the number of threads do not change the result.
 * - \b Failure: the output is empty, the cause is in getStatus() and getMessage(), and one line is
 *   printed by PCL_ERROR; by PCL_WARN if the run was cancelled. Warnings about a mesh are in
 *   getReport().warnings and are printed by PCL_WARN. reconstruct() does not throw.
 * - \b Search: a kd-tree of its own, in parallel. A method given to
 *   setSearchMethod() is used instead, in one thread; each run sets its input cloud.
 * - \b Results are those of the last call of reconstruct(), also after another cloud or option has
 *   been set. A run changes no option.
 * - \b Types: the library holds the class for all of PCL_XYZ_POINT_TYPES. For a type of your own,
 *   define PCL_NO_PRECOMPILE before the first header of PCL, and link FLANN::FLANN as well.
 *
 * The setters of the options and the getters of the results are those of
 * floater::ReconstructionState. A copy of an object has its options and its results.
 *
 * FloaterMeshConstruction is the same for programs that are built on pcl::MeshConstruction.
 *
 * An object may be used for one cloud after another, but by one thread at a time.
 * \ingroup surface
 */
template <typename PointT>
class PCL_FLOATER_EXPORT FloaterReconstruction : public SurfaceReconstruction<PointT>,
                                                 public floater::ReconstructionState
{
public:
  using Ptr = shared_ptr<FloaterReconstruction<PointT>>;
  using ConstPtr = shared_ptr<const FloaterReconstruction<PointT>>;
  using PointCloud = pcl::PointCloud<PointT>;

  /** \brief All options at their defaults, which need no tuning. */
  FloaterReconstruction () { check_tree_ = false; }

  /** \brief Reconstructs the surface of setInputCloud() and setIndices().
   * \param[out] output the whole input cloud and the triangles; its header is that of the input */
  void reconstruct (pcl::PolygonMesh& output) override;

  /** \brief Reconstructs the surface of setInputCloud() and setIndices().
   * \param[out] points the whole input cloud; not the object given to setInputCloud()
   * \param[out] polygons the triangles, as indices of the whole cloud */
  void reconstruct (PointCloud& points, std::vector<pcl::Vertices>& polygons) override;

  /** \brief Reconstructs the surface of setInputCloud() and setIndices(), with texture coordinates,
   * whether or not setComputeTextureCoordinates() asks for them.
   * \param[out] output the whole input cloud; one list of polygons; three coordinates for each of
   * them, in the order of their corners; and one white material without a file: set its tex_file.
   * pcl::io::saveOBJFile() of PCL writes it if the points have normals. Empty after a failure */
  void reconstruct (pcl::TextureMesh& output);

  /** \brief Reconstructs the surface of setInputCloud() and setIndices(), without copying the cloud.
   * \param[out] polygons the triangles, as indices of the whole cloud */
  void reconstruct (std::vector<pcl::Vertices>& polygons);

protected:
  using SurfaceReconstruction<PointT>::check_tree_;
  using SurfaceReconstruction<PointT>::fake_indices_;
  using SurfaceReconstruction<PointT>::indices_;
  using SurfaceReconstruction<PointT>::input_;
  using SurfaceReconstruction<PointT>::tree_;

  std::string getClassName () const override { return "FloaterReconstruction"; }

  void performReconstruction (pcl::PolygonMesh& output) override;

  void performReconstruction (PointCloud& points, std::vector<pcl::Vertices>& polygons) override;

private:
  /// Does the work of a run, turns exceptions into failures, and prints failure and warnings.
  /// \return false if there is no mesh
  template <typename Work>
  bool guarded (const Work& work);

  /// Makes the triangles; after a failure there are none, and the report has the reason.
  void triangulate (std::vector<pcl::Vertices>& polygons);
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/surface/impl/floater_reconstruction.hpp>
#endif
