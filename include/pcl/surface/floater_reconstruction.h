// SPDX-License-Identifier: GPL-3.0-or-later
// Surface reconstruction from unorganized points, as a class of PCL.
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
/** \brief Reconstructs a surface from an unorganized point cloud. The vertices of the mesh are the
 * points of the cloud.
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
 *
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
 *   with setIndices(). The result does not depend on the order of the points or on the number of
 *   threads.
 * - \b Failure: the output is empty, the cause is in getStatus() and getMessage(), and one line is
 *   printed by PCL_ERROR. A run that is cancelled prints its line by PCL_WARN. Warnings about a
 * mesh are in getReport().warnings and are printed by PCL_WARN. reconstruct() does not throw.
 * - \b Search: a kd-tree of its own, in parallel. A method given to
 *   setSearchMethod() is used instead, in one thread; each run sets its input cloud.
 * - \b Results (getStatus() and below) are those of the last call of reconstruct(), also after
 *   another cloud or option has been set. A run changes no option.
 * - \b Types: the library holds the class for all of PCL_XYZ_POINT_TYPES. For a type of your own,
 *   define PCL_NO_PRECOMPILE before the first header of PCL, and link FLANN::FLANN as well.
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

  /** \brief All options at their defaults, which need no tuning. */
  FloaterReconstruction () { check_tree_ = false; }

  /** \brief Reconstructs the surface of setInputCloud() and setIndices().
   * \param[out] output the whole input cloud and the triangles; its header is that of the input */
  void reconstruct (pcl::PolygonMesh& output) override;

  /** \brief Reconstructs the surface of setInputCloud() and setIndices().
   * \param[out] points the whole input cloud; not the object given to setInputCloud()
   * \param[out] polygons the triangles, as indices of the whole cloud */
  void reconstruct (PointCloud& points, std::vector<pcl::Vertices>& polygons) override;

  /** \brief The kind of surface that the points are taken for; default AUTO. With DISC, a run ends
   * with RunStatus::NO_BOUNDARY, NOT_A_DISC or UNREACHABLE if the surface is not a disc. */
  void setTopology (floater::Topology topology) { options_.topology = topology; }
  /** \brief The kind of surface asked for; getReport() has the one that was made. */
  floater::Topology getTopology () const { return options_.topology; }

  /** \brief Which boundary loops of a surface stay open; default AUTO: those that look
   * like boundaries, not like gaps of the sampling. Topology::DISC takes AUTO and KEEP_LARGEST
   * only, which mean the same there. */
  void setHolePolicy (floater::HolePolicy policy) { options_.holes.policy = policy; }
  /** \brief Which boundary loops of a surface stay open. */
  floater::HolePolicy getHolePolicy () const { return options_.holes.policy; }

  /** \brief HolePolicy::KEEP_COUNT: boundary loops that stay open, the most likely boundaries of
   * the whole surface; 0 or more, default 1. */
  void setKeptLoops (int loops) { options_.holes.kept_loops = loops; }
  /** \brief HolePolicy::KEEP_COUNT: boundary loops that stay open. */
  int getKeptLoops () const { return options_.holes.kept_loops; }

  /** \brief HolePolicy::BY_SIZE: width of the widest hole that is filled, above 0. It has no
   * default that would do: without a size, a run with this policy ends with
   * RunStatus::INVALID_OPTION. \param size in the unit; other policies do not read it \param unit
   * local spacings, or units of the cloud */
  void setLargestHole (double size, floater::LengthUnit unit = floater::LengthUnit::SPACINGS)
  {
    options_.holes.largest_hole = size;
    options_.holes.unit = unit;
  }
  /** \brief HolePolicy::BY_SIZE: width of the widest hole that is filled; 0 if none was set. */
  double getLargestHole () const { return options_.holes.largest_hole; }
  /** \brief HolePolicy::BY_SIZE: the unit of getLargestHole(). */
  floater::LengthUnit getLargestHoleUnit () const { return options_.holes.unit; }

  /** \brief The place of the sensor, for a cloud that is one scan, in the frame of the cloud. The
   * points are connected as they were seen from there, and the mesh faces the sensor; every point
   * must be visible from there. Sets ViewUse::GIVEN. */
  void setViewPoint (double x, double y, double z)
  {
    options_.view.use = floater::ViewUse::GIVEN;
    options_.view.viewpoint = {x, y, z};
  }
  /** \brief The place that was given; (0, 0, 0) if there is none. getReport() has the one that was
   * used. */
  const std::array<double, 3>& getViewPoint () const { return options_.view.viewpoint; }

  /** \brief Whether a cloud of one scan is connected as its sensor saw it; default AUTO: if the
   * spacing of its points tells so. The origin of the sensor in the cloud is tried, and where
   * points are noisy or uneven, the place is searched. With NEVER, the mesh does not face the
   * sensor either. */
  void setViewUse (floater::ViewUse use) { options_.view.use = use; }
  /** \brief Whether a cloud of one scan is connected as its sensor saw it. */
  floater::ViewUse getViewUse () const { return options_.view.use; }

  /** \brief Length that no edge of the mesh exceeds, in units of the cloud, 0 or more; default 0:
   * no limit. Triangles with a longer edge are cut off the finished mesh, and where they were there
   * is a boundary, also of a disc. The mesh stays a manifold: at a point where only a corner holds
   * parts of it together, the one with most triangles stays. getStatistics() counts what is cut
   * off, getUnusedIndices() has points that lose all their triangles. If nothing is left, the run
   * ends with RunStatus::INVALID_OPTION. */
  void setMaximumEdgeLength (double length) { options_.trimming.maximum_edge_length = length; }
  /** \brief Length that no edge of the mesh exceeds, in units of the cloud; 0: no limit. */
  double getMaximumEdgeLength () const { return options_.trimming.maximum_edge_length; }

  /** \brief As setMaximumEdgeLength(), in local spacings: the mean of those of the two ends of the
   * edge; 0 or more; default 0: no limit. Edges of a good mesh are up to about 3 long, and up to 6
   * where the sampling is uneven. */
  void setMaximumEdgeRatio (double spacings) { options_.trimming.maximum_edge_ratio = spacings; }
  /** \brief Length that no edge of the mesh exceeds, in local spacings; 0: no limit. */
  double getMaximumEdgeRatio () const { return options_.trimming.maximum_edge_ratio; }

  /** \brief Whether triangles are taken out until no two cross each other; default false. It is the
   * last resort after setRemoveSelfIntersections(), for those who simulate, print or trace rays: at
   * such places the mesh gets holes, mostly of a few triangles. getStatistics() counts them. */
  void setOpenSelfIntersections (bool open) { options_.trimming.open_self_intersections = open; }
  /** \brief Whether triangles are taken out until no two cross each other. */
  bool getOpenSelfIntersections () const { return options_.trimming.open_self_intersections; }

  /** \brief Components of the mesh with fewer points are left out, 0 or more; default 0: none.
   * Components are counted after long edges and crossing triangles were cut off. */
  void setMinimumComponentSize (int points) { options_.trimming.minimum_component_size = points; }
  /** \brief Components of the mesh with fewer points are left out. */
  int getMinimumComponentSize () const { return options_.trimming.minimum_component_size; }

  /** \brief Whether points that lie off any surface are left out of the mesh; default true.
   * getOutlierIndices() has them. */
  void setRemoveOutliers (bool remove_outliers) { options_.remove_outliers = remove_outliers; }
  /** \brief Whether points that lie off any surface are left out of the mesh. */
  bool getRemoveOutliers () const { return options_.remove_outliers; }

  /** \brief What becomes of points around which the cloud is flat at no scale, such as leaves and
   * grass; default KEEP. getScatterIndices() has them. */
  void setScatterPolicy (floater::ScatterPolicy policy) { options_.scatter = policy; }
  /** \brief What becomes of points around which the cloud is flat at no scale. */
  floater::ScatterPolicy getScatterPolicy () const { return options_.scatter; }

  /** \brief Whether points are connected as they lie when projected on local planes, where noise is
   * strong; default true. The vertices of the mesh are not moved. */
  void setDenoise (bool denoise) { options_.denoise = denoise; }
  /** \brief Whether strong noise is projected away before points are connected. */
  bool getDenoise () const { return options_.denoise; }

  /** \brief Number of nearest neighbours of each point, 6 to 200; default 20. Not for balls. */
  void setKSearch (int k) { options_.neighbors.k = k; }
  /** \brief Number of nearest neighbours of each point. */
  int getKSearch () const { return options_.neighbors.k; }

  /** \brief Which points a point of a disc is a convex combination of; default NEAREST_DELAUNAY. A
   * surface takes Delaunay stars in any case. With BALL and BALL_DELAUNAY, the points in a ball
   * replace the k nearest in all stages (TW 385, sections 2.1 and 6). */
  void setNeighborhood (floater::Neighborhood neighborhood)
  {
    options_.neighbors.kind = neighborhood;
  }
  /** \brief Which points a point of a disc is a convex combination of. */
  floater::Neighborhood getNeighborhood () const { return options_.neighbors.kind; }

  /** \brief Radius of balls, in mean distances of a point to its 6 nearest, 1 to 10; default 2.25,
   * which gives about 20 neighbours. */
  void setBallRadius (double spacings) { options_.neighbors.ball_radius = spacings; }
  /** \brief Radius of balls, in mean distances of a point to its 6 nearest. */
  double getBallRadius () const { return options_.neighbors.ball_radius; }

  /** \brief All that only a disc takes: how its boundary loop is found, or the loop itself; the
   * curve on which it is laid; weights and solver of the linear system. Another surface does not
   * read them. They replace all that were set before, a loop of setPrescribedLoop() as well: to
   * keep what was set, change a copy of getDiscOptions(). */
  void setDiscOptions (const floater::DiscOptions& options)
  {
    options_.disc = options;
    prescribed_loop_.assign (options.boundary.loop.begin (), options.boundary.loop.end ());
  }
  /** \brief All that only a disc takes, the given boundary loop among them. */
  const floater::DiscOptions& getDiscOptions () const { return options_.disc; }

  /** \brief Gives the boundary loop: cloud indices in order, either way round, each once, 3 or
   * more. The surface is then made as a disc. Default empty: the loop is found. Not with
   * Topology::SURFACE. It is BoundaryOptions::loop of getDiscOptions() in the type of PCL's
   * indices: the later call of the two setters counts. */
  void setPrescribedLoop (const pcl::Indices& loop)
  {
    prescribed_loop_ = loop;
    options_.disc.boundary.loop.assign (loop.begin (), loop.end ());
  }
  /** \brief The given boundary loop; empty: the loop is found. */
  const pcl::Indices& getPrescribedLoop () const { return prescribed_loop_; }

  /** \brief Whether neighbours on another sheet of the surface are dropped; default true. */
  void setFilterSheets (bool filter_sheets) { options_.filter_sheets = filter_sheets; }
  /** \brief Whether neighbours on another sheet of the surface are dropped. */
  bool getFilterSheets () const { return options_.filter_sheets; }

  /** \brief Whether edges are flipped in space towards Delaunay, and folds repaired; default true.
   */
  void setFlipEdges (bool flip_edges) { options_.flip_edges = flip_edges; }
  /** \brief Whether edges are flipped in space and folds repaired. */
  bool getFlipEdges () const { return options_.flip_edges; }

  /** \brief Whether the mesh is changed where its triangles cross each other, by flips of edges and
   * by moving points to other triangles; default true. Not without setFlipEdges, and not where
   * noise makes the true triangles cross each other, too: for scans that are connected as their
   * sensor saw them, and where noisy points were projected to connect them (see setDenoise).
   * Report::check tells how many pairs are left. */
  void setRemoveSelfIntersections (bool remove) { options_.remove_self_intersections = remove; }
  /** \brief Whether the mesh is changed where its triangles cross each other. */
  bool getRemoveSelfIntersections () const { return options_.remove_self_intersections; }

  /** \brief Number of threads; default 0: one for each core. The result is the same. */
  void setNumberOfThreads (unsigned int nr_threads = 0)
  {
    options_.threads = static_cast<int> (nr_threads);
  }
  /** \brief Number of threads; 0: one for each core. */
  unsigned int getNumberOfThreads () const { return static_cast<unsigned int> (options_.threads); }

  /** \brief Number of blocks in which the nearest neighbours are searched, 0 or more; default 0:
   * one block up to 262,144 points, above that blocks of at most 131,072 points. It changes the
   * time and the memory of the search only; the result is the same. Discs, balls and a search
   * method of one's own have one block. */
  void setNumberOfBlocks (int blocks = 0) { options_.blocks = blocks; }
  /** \brief Number of blocks in which the nearest neighbours are searched; 0: chosen. */
  int getNumberOfBlocks () const { return options_.blocks; }

  /** \brief Called when a stage of a run begins, by the thread that called reconstruct(); default
   * none. An exception from it ends the run with RunStatus::INTERNAL_ERROR. */
  void setStageCallback (std::function<void (floater::Stage)> callback)
  {
    options_.stage_callback = std::move (callback);
  }
  /** \brief The function that is called when a stage begins; empty if there is none. */
  const std::function<void (floater::Stage)>& getStageCallback () const
  {
    return options_.stage_callback;
  }

  /** \brief Called with the fraction of the run that is done, from 0 to 1 and never decreasing:
   * when a stage begins, up to 20 times a second within it, and with 1 at the end; default none.
   * The fraction is estimated from typical runs, and does not move while a linear system is solved.
   * Thread and exceptions are as for setStageCallback(). */
  void setProgressCallback (std::function<void (double fraction)> callback)
  {
    options_.progress_callback = std::move (callback);
  }
  /** \brief The function that is called with the fraction done; empty if there is none. */
  const std::function<void (double)>& getProgressCallback () const
  {
    return options_.progress_callback;
  }

  /** \brief Asked whether the run is to be cancelled, as often as the progress callback is called;
   * default none. If it returns true, the run ends with RunStatus::CANCELLED and an empty mesh,
   * mostly within a tenth of a second; direct solvers, CGAL's triangulation and a search method of
   * PCL are waited for. It may read an atomic variable that another thread sets. Thread and
   * exceptions are as for setStageCallback(). */
  void setCancelledCallback (std::function<bool ()> callback)
  {
    options_.cancelled_callback = std::move (callback);
  }
  /** \brief The function that is asked whether to cancel; empty if there is none. */
  const std::function<bool ()>& getCancelledCallback () const
  {
    return options_.cancelled_callback;
  }

  /** \brief Outcome of the last run; NOT_RUN before the first. */
  floater::RunStatus getStatus () const { return report_.status; }

  /** \brief Cause of a failure and what to do, in one sentence; empty after SUCCESS. */
  const std::string& getMessage () const { return report_.message; }

  /** \brief The whole report on the last run. */
  const floater::Report& getReport () const { return report_; }

  /** \brief Counts, times and figures of the last run. */
  const floater::Statistics& getStatistics () const { return report_.statistics; }

  /** \brief The mesh as examined at the end of the last run: components, genus, boundary loops with
   * their sizes, folds and more. */
  const floater::MeshCheck& getMeshCheck () const { return report_.check; }

  /** \brief The longest boundary loop in order, each point once; empty if the surface is closed. */
  pcl::Indices getBoundaryLoop () const;

  /** \brief Position of every cloud point in the plane, if the mesh was made as a disc; NaN where a
   * point was not used. Else empty. */
  const std::vector<Eigen::Vector2d>& getParameters () const { return report_.parameters; }

  /** \brief Finite points, neither duplicates nor outliers, that are in no triangle; ascending. */
  pcl::Indices getUnusedIndices () const;

  /** \brief Points left out of the mesh because they lie off any surface; ascending. */
  pcl::Indices getOutlierIndices () const;

  /** \brief Points around which the cloud is flat at no scale, such as leaves; ascending. With
   * ScatterPolicy::DROP they are left out of the mesh. */
  pcl::Indices getScatterIndices () const;

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
  /// Runs a reconstruction and turns exceptions into failures. Prints failure and warnings.
  /// \return false if there is no mesh
  bool guarded (const std::function<void ()>& reconstruction);

  /// Records a failure. \return false
  bool fail (floater::RunStatus status, const std::string& message);

  /// Makes points for the core.
  /// \return false, with the failure recorded, if the input cannot be used
  bool makeInput (floater::Input& input);

  /// Makes the triangles, or none and a report that says why.
  void triangulate (std::vector<pcl::Vertices>& polygons);

  floater::Options options_;
  pcl::Indices prescribed_loop_; // as given: may hold indices that the core's type cannot
  floater::Report report_;
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/surface/impl/floater_reconstruction.hpp>
#endif
