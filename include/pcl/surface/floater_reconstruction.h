// SPDX-License-Identifier: GPL-3.0-or-later
// Surface reconstruction by Floater's meshless parameterization, as a class of PCL.
#pragma once

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/reconstruct.h>
#include <pcl/surface/floater/report.h>
#include <pcl/surface/reconstruction.h>
#include <pcl/types.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace pcl
{
/** \brief Triangulates an unorganized point cloud so that its points are the vertices of the mesh.
 *
 * The points are laid out flat by one sparse linear system (M. S. Floater, M. Reimers: Meshless
 * parameterization and surface reconstruction, 2001; in the form of report TW 385, K.U.Leuven),
 * triangulated there by Delaunay, and the triangles are carried back to the points:
 *
 * \code
 * pcl::FloaterReconstruction<pcl::PointXYZ> floater;
 * floater.setInputCloud (cloud);
 * pcl::PolygonMesh mesh;
 * floater.reconstruct (mesh);
 * if (floater.getStatus () != pcl::floater::Status::OK)
 *   std::cerr << floater.getMessage () << '\n';
 * \endcode
 *
 * That is the method for a disc, one component of surface with one border however it is bent. Any
 * other surface, closed or with holes, handles or several components, is made of the triangles on
 * which the Delaunay stars of neighbouring points agree, and holes are closed by the same
 * parameterization of a patch around them. Which of the two, setTopology() says; by default the
 * points do.
 *
 * - \b Input: points of a surface. Only x, y, z are read. Points with a NaN or infinity, and all
 * but one of equal points, stay in the cloud but in no triangle. So do outliers, which
 *   setRemoveOutliers() is about. setIndices() selects points; an index given twice counts once.
 * - \b Output: the whole input cloud, unchanged and in its order, with every field of PointT; one
 *   consistently oriented manifold of triangles, whose indices count in the whole cloud also with
 *   setIndices(). The order of points and the number of threads make no difference.
 * - \b Failure: an empty cloud, no polygons, one line by PCL_ERROR, and the cause in getStatus()
 *   and getMessage(). What is odd about a mesh, getReport().warnings, is also given by PCL_WARN.
 *   No exception leaves reconstruct().
 * - \b Search: its own kd-tree, in parallel; for balls, PCL's octree. A method given to
 * setSearchMethod() is asked instead, by one thread; like for all of PCL's classes its input cloud
 * is then set by each run.
 * - \b Results (getStatus() and below) are those of the last call of reconstruct(), also after
 *   another cloud or option has been set. A run changes no parameter.
 * - \b Types: the library holds the class for all of PCL_XYZ_POINT_TYPES. For a type of your own
 *   define PCL_NO_PRECOMPILE before the first header of PCL, and link FLANN::FLANN, too.
 *
 * An object may be used for one cloud after another, but by one thread at a time.
 * \ingroup surface
 */
template <typename PointT>
class PCL_FLOATER_EXPORT FloaterReconstruction : public SurfaceReconstruction<PointT>
{
public:
  using Ptr = shared_ptr<FloaterReconstruction<PointT>>;
  using ConstPtr = shared_ptr<const FloaterReconstruction<PointT>>;
  using PointCloud = pcl::PointCloud<PointT>;

  /** \brief All parameters at their defaults, which need no tuning. */
  FloaterReconstruction () { check_tree_ = false; }

  /** \brief Reconstructs the surface of setInputCloud() and setIndices().
   * \param[out] output the whole input cloud and the triangles; its header is that of the input */
  void reconstruct (pcl::PolygonMesh& output) override;

  /** \brief Reconstructs the surface of setInputCloud() and setIndices().
   * \param[out] points the whole input cloud; not the object given to setInputCloud()
   * \param[out] polygons the triangles, as indices of the whole cloud */
  void reconstruct (PointCloud& points, std::vector<pcl::Vertices>& polygons) override;

  /** \brief What surface the points are taken for; default AUTO: as they tell. DISC lays all out in
   * the plane, with Status::NO_BOUNDARY or NOT_A_DISC where that cannot be; SURFACE takes any.
   * Which one a run has taken, and why, is in getReport(). */
  void setTopology (floater::Topology topology) { options_.topology = topology; }
  floater::Topology getTopology () const { return options_.topology; }

  /** \brief Which holes of a surface stay open; default AUTO: those where the sampling ends. A disc
   * has none: with Topology::DISC only AUTO and KEEP_LARGEST are taken, which are then the same. */
  void setHolePolicy (floater::HolePolicy policy) { options_.holes.policy = policy; }
  floater::HolePolicy getHolePolicy () const { return options_.holes.policy; }

  /** \brief HolePolicy::KEEP_COUNT: boundary loops that stay, the largest ones of the whole
   * surface; 0 or more, default 1. */
  void setKeptLoops (int loops) { options_.holes.kept_loops = loops; }
  int getKeptLoops () const { return options_.holes.kept_loops; }

  /** \brief HolePolicy::BY_SIZE: width of the widest hole that is closed, in local spacings;
   * default 0: not looked at. This or setLargestHoleLength() must be above 0; if both are, a hole
   * is closed that exceeds neither. */
  void setLargestHole (double spacings) { options_.holes.largest_hole = spacings; }
  double getLargestHole () const { return options_.holes.largest_hole; }

  /** \brief HolePolicy::BY_SIZE: the same in units of the cloud; default 0: not looked at. */
  void setLargestHoleLength (double length) { options_.holes.largest_hole_length = length; }
  double getLargestHoleLength () const { return options_.holes.largest_hole_length; }

  /** \brief Whether points that lie off any surface are left out of the mesh; default true. They
   * are in getOutlierIndices(). */
  void setRemoveOutliers (bool remove_outliers) { options_.remove_outliers = remove_outliers; }
  bool getRemoveOutliers () const { return options_.remove_outliers; }

  /** \brief Whether points are connected as they lie in their local planes where noise is strong;
   * default true. The points themselves stay where they are. */
  void setDenoise (bool denoise) { options_.denoise = denoise; }
  bool getDenoise () const { return options_.denoise; }

  /** \brief Nearest neighbours of each point, 6 to 200; default 20. */
  void setKNearest (int k) { options_.neighbors.k = k; }
  int getKNearest () const { return options_.neighbors.k; }

  /** \brief Which points a point is a convex combination of; default NEAREST_DELAUNAY. Balls, of a
   * radius that follows the local density, replace the k nearest everywhere. */
  void setNeighborhood (floater::Neighborhood neighborhood)
  {
    options_.neighbors.kind = neighborhood;
  }
  floater::Neighborhood getNeighborhood () const { return options_.neighbors.kind; }

  /** \brief Radius of balls in mean distances of a point to its 6 nearest, 1 to 10; default 2.25,
   * about 20 neighbours. */
  void setBallRadius (double spacings) { options_.neighbors.ball_radius = spacings; }
  double getBallRadius () const { return options_.neighbors.ball_radius; }

  /** \brief Above 0 and below 360 degrees, default 160: a point of the boundary sees a wider sector
   * without neighbours. */
  void setOpeningAngle (double degrees) { options_.boundary.opening_angle = degrees; }
  double getOpeningAngle () const { return options_.boundary.opening_angle; }

  /** \brief How boundary points become one loop; default SPANNING_TREE. */
  void setBoundaryMethod (floater::BoundaryMethod method) { options_.boundary.method = method; }
  floater::BoundaryMethod getBoundaryMethod () const { return options_.boundary.method; }

  /** \brief Distance over which clusters of boundary points grow (BoundaryMethod::TWO_SEGMENTS), as
   * a fraction of the diagonal of the bounding box: above 0, at most 1; default 0.05. */
  void setClusterTolerance (double fraction) { options_.boundary.cluster_tolerance = fraction; }
  double getClusterTolerance () const { return options_.boundary.cluster_tolerance; }

  /** \brief Nearest boundary points that such a cluster takes in at a time, 1 or more; default 10.
   */
  void setClusterK (int k) { options_.boundary.cluster_k = k; }
  int getClusterK () const { return options_.boundary.cluster_k; }

  /** \brief Gives the boundary loop, which makes the surface a disc: cloud indices in order, either
   * way round, each once, 3 or more. Empty, the default: it is found from the points. Not for
   * Topology::SURFACE. */
  void setPrescribedLoop (const pcl::Indices& loop) { prescribed_loop_ = loop; }
  const pcl::Indices& getPrescribedLoop () const { return prescribed_loop_; }

  /** \brief Convex curve on which the loop is laid; default CIRCLE. */
  void setDomain (floater::Domain domain) { options_.domain.curve = domain; }
  floater::Domain getDomain () const { return options_.domain.curve; }

  /** \brief Sides of Domain::POLYGON, 3 or more; default 6. */
  void setPolygonSides (int sides) { options_.domain.polygon_sides = sides; }
  int getPolygonSides () const { return options_.domain.polygon_sides; }

  /** \brief How the points of the loop share that curve; default CHORD_LENGTH. */
  void setLoopSpacing (floater::LoopSpacing spacing) { options_.domain.loop_spacing = spacing; }
  floater::LoopSpacing getLoopSpacing () const { return options_.domain.loop_spacing; }

  /** \brief Weights of a point in its neighbours; default MEAN_VALUE. */
  void setWeighting (floater::Weighting weighting) { options_.weighting = weighting; }
  floater::Weighting getWeighting () const { return options_.weighting; }

  /** \brief What solves the linear system; default UMFPACK. Status::SOLVER_UNAVAILABLE if the
   * library was built without it. */
  void setSolver (floater::Solver solver) { options_.solver.method = solver; }
  floater::Solver getSolver () const { return options_.solver.method; }

  /** \brief Order of the unknowns; default AUTOMATIC. */
  void setOrdering (floater::Ordering ordering) { options_.solver.ordering = ordering; }
  floater::Ordering getOrdering () const { return options_.solver.ordering; }

  /** \brief Relative residual |b - A u| / |b| at which iterative solvers stop, above 0 and below 1;
   * default 1e-15. A residual as small as rounding lets it be will do. */
  void setTolerance (double tolerance) { options_.solver.tolerance = tolerance; }
  double getTolerance () const { return options_.solver.tolerance; }

  /** \brief Iterations of an iterative solver, 1 or more, after which it gives up with
   * Status::NOT_CONVERGED; default 1000. */
  void setMaxIterations (int iterations) { options_.solver.max_iterations = iterations; }
  int getMaxIterations () const { return options_.solver.max_iterations; }

  /** \brief Entries kept in a row of each factor of Solver::BICGSTAB_ILUT, 1 or more; default 15.
   */
  void setIlutFill (int entries) { options_.solver.ilut_fill = entries; }
  int getIlutFill () const { return options_.solver.ilut_fill; }

  /** \brief Share of their row, 0 to 1, below which entries of these factors are dropped; default
   * 1e-2. */
  void setIlutDropTolerance (double share) { options_.solver.ilut_drop = share; }
  double getIlutDropTolerance () const { return options_.solver.ilut_drop; }

  /** \brief Whether neighbours on another sheet of the surface are dropped; default true. */
  void setFilterSheets (bool filter_sheets) { options_.filter_sheets = filter_sheets; }
  bool getFilterSheets () const { return options_.filter_sheets; }

  /** \brief Whether edges are flipped on the surface towards Delaunay; default true. */
  void setFlipEdges (bool flip_edges) { options_.flip_edges = flip_edges; }
  bool getFlipEdges () const { return options_.flip_edges; }

  /** \brief Threads of a run; default 0: all cores. Changes time only, not the result. */
  void setNumberOfThreads (int threads = 0) { options_.threads = threads; }
  int getNumberOfThreads () const { return options_.threads; }

  /** \brief ComponentSets in which a surface is made, each of nearest neighbours and a little
   * around it; default 0: one up to 262144 points, then of at most 131072 points each. Changes time
   * and memory only, not the result. With a search method of one's own, balls or a disc there is
   * one. */
  void setNumberOfBlocks (int blocks = 0) { options_.blocks = blocks; }
  int getNumberOfBlocks () const { return options_.blocks; }

  /** \brief Called as each stage of a run begins, by the thread that called reconstruct(). An
   * exception from it ends the run with Status::INTERNAL_ERROR. Default: empty. */
  void setStageCallback (std::function<void (floater::Stage)> callback)
  {
    options_.stage_callback = std::move (callback);
  }
  const std::function<void (floater::Stage)>& getStageCallback () const
  {
    return options_.stage_callback;
  }

  /** \brief Called with the share of the run that is done, from 0 to 1 and never less than before:
   * when a stage begins, up to 20 times a second within it, and with 1 at the end. An estimate from
   * typical runs; the solver of a disc is one step. Else as setStageCallback(). */
  void setProgressCallback (std::function<void (double fraction)> callback)
  {
    options_.progress_callback = std::move (callback);
  }
  const std::function<void (double)>& getProgressCallback () const
  {
    return options_.progress_callback;
  }

  /** \brief Asked as often, whether the run is to be stopped: true ends it with Status::CANCELLED
   * and an empty mesh, mostly within a tenth of a second; direct solvers, CGAL's triangulation and
   * a search method of PCL are waited for. Another thread may set what it reads, if that is atomic.
   * Else as setStageCallback(). */
  void setCancelledCallback (std::function<bool ()> callback)
  {
    options_.cancelled_callback = std::move (callback);
  }
  const std::function<bool ()>& getCancelledCallback () const
  {
    return options_.cancelled_callback;
  }

  /** \brief Outcome of the last run; NOT_RUN before the first. */
  floater::Status getStatus () const { return report_.status; }

  /** \brief Cause of a failure and what to do, in one sentence; empty if the status is OK. */
  const std::string& getMessage () const { return report_.message; }

  /** \brief All that the last run told. */
  const floater::Report& getReport () const { return report_; }

  /** \brief Counts, times and figures of the solver. */
  const floater::Statistics& getStatistics () const { return report_.statistics; }

  /** \brief What the mesh is, as examined at the end of the last run: components, genus, boundary
   * loops with their sizes, folds and more. */
  const floater::MeshCheck& getMeshCheck () const { return report_.check; }

  /** \brief The longest boundary loop in order, each point once; empty if the surface is closed. */
  pcl::Indices getBoundaryLoop () const;

  /** \brief Place of every point of the cloud in the plane, if the surface was made as a disc; NaN
   * where a point was not used. Else empty. */
  const std::vector<Eigen::Vector2d>& getParameters () const { return report_.parameters; }

  /** \brief Finite points, neither duplicates nor outliers, that are in no triangle; ascending. */
  pcl::Indices getUnusedIndices () const;

  /** \brief Points left out of the mesh since they lie off any surface; ascending. */
  pcl::Indices getOutlierIndices () const;

  /** \brief Points with a NaN or infinite coordinate; ascending. */
  pcl::Indices getNonFiniteIndices () const;

  /** \brief Pairs (point, the equal point that stands for it in the mesh); ascending. */
  std::vector<std::array<pcl::index_t, 2>> getDuplicates () const;

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
  /// Runs a reconstruction with all guards; false, with the failure told, if there is no mesh.
  bool guarded (const std::function<void ()>& reconstruction);

  /// Records a failure. \return false
  bool fail (floater::Status status, const std::string& message);

  /// Points and options for the core; false, with the failure recorded, if there is nothing to run.
  bool makeInput (floater::Input& input, floater::Options& options);

  /// Triangles of the cloud, or none and a report that says why.
  void triangulate (std::vector<pcl::Vertices>& polygons);

  floater::Options options_;     // but for the loop
  pcl::Indices prescribed_loop_; // apart, for indices that the core's type cannot hold
  floater::Report report_;
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/surface/impl/floater_reconstruction.hpp>
#endif
