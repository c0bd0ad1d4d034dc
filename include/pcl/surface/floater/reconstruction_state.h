// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// State of FloaterReconstruction that does not depend on the type of the points.
#pragma once

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/reconstruct.h>
#include <pcl/surface/floater/report.h>
#include <pcl/surface/floater/texture_coordinates.h>
#include <pcl/types.h>
#include <pcl_floater/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pcl {
struct PolygonMesh;
struct TextureMesh;

namespace floater {
/** \brief The options of FloaterReconstruction and the results of its last run.
 *
 * It has nothing but a pointer to them, and no member is inline: options and results may be added
 * without a change of the size of the class, or of what programs have compiled of it. Not so the
 * fields of DiscOptions and of Report, which programs read and write themselves. */
class PCL_FLOATER_EXPORT ReconstructionState
{
public:
  /** \brief What a point is in the mesh, with names and values of
   * pcl::GreedyProjectionTriangulation. */
  enum PointState
  {
    NONE = -1,    ///< not used: not selected, or with a NaN or infinite coordinate
    FREE = 0,     ///< in no triangle
    FRINGE = 1,   ///< never returned: a finished mesh has no fringe
    BOUNDARY = 2, ///< on a boundary loop of the mesh
    COMPLETED = 3 ///< surrounded by triangles
  };

  /** \brief The kind of surface that the points are taken for; default AUTO. With DISC, a run ends
   * with RunStatus::NO_BOUNDARY, NOT_A_DISC or UNREACHABLE if the surface is not a disc. */
  void setTopology (Topology topology);
  Topology getTopology () const; ///< as asked for; getReport() has that of the mesh

  /** \brief Which boundary loops of a surface stay open; default AUTO: those that look
   * like boundaries, not like gaps of the sampling. Topology::DISC takes AUTO and KEEP_LARGEST
   * only, which mean the same there. */
  void setHolePolicy (HolePolicy policy);
  HolePolicy getHolePolicy () const; ///< see setHolePolicy()

  /** \brief HolePolicy::KEEP_COUNT: boundary loops that stay open, the most likely boundaries of
   * the whole surface; 0 or more, default 1. */
  void setKeptLoops (int loops);
  int getKeptLoops () const; ///< see setKeptLoops()

  /** \brief HolePolicy::BY_SIZE: width of the widest hole that is filled, above 0, in local
   * spacings or in units of the cloud. No default would do: without a size, a run with this policy
   * ends with RunStatus::INVALID_OPTION. Other policies do not read it. */
  void setLargestHole (double size, LengthUnit unit = LengthUnit::SPACINGS);
  double getLargestHole () const; ///< see setLargestHole(); 0: none was set
  /** \brief HolePolicy::BY_SIZE: the unit of getLargestHole(). */
  LengthUnit getLargestHoleUnit () const;

  /** \brief The place of the sensor, for a cloud that is one scan, in the frame of the cloud. The
   * points are connected as they were seen from there, and the mesh faces the sensor; every point
   * must be visible from there. Sets ViewUse::GIVEN. */
  void setViewPoint (double x, double y, double z);
  const std::array<double, 3>& getViewPoint () const; ///< the given one, or (0, 0, 0)

  /** \brief Whether a cloud of one scan is connected as its sensor saw it; default AUTO: if the
   * spacing of its points tells so. The origin of the sensor in the cloud is tried, and where
   * points are noisy or uneven, the place is searched. With NEVER, the mesh does not face the
   * sensor either. */
  void setViewUse (ViewUse use);
  ViewUse getViewUse () const; ///< see setViewUse()

  /** \brief Which side of each component of the mesh is its front; default AUTO: that which the
   * evidence tells. With NORMALS, the points need normals, else a run ends with
   * RunStatus::INVALID_OPTION; they are not used for tangent planes unless setUseInputNormals()
   * asks for that. Where a choice decides nothing, a warning says so, and AUTO decides. getReport()
   * has in facing_parts which rule turned how many parts, and how sure that is. */
  void setFacing (Facing facing);
  Facing getFacing () const; ///< see setFacing()

  /** \brief Length that no edge of the mesh exceeds, in units of the cloud, 0 or more; default 0:
   * no limit. Triangles with a longer edge are cut off the finished mesh, and where they were there
   * is a boundary, also of a disc. The mesh stays a manifold: at a point where only a corner holds
   * parts of it together, the one with most triangles stays. getStatistics() counts what is cut
   * off, getUnusedIndices() has points that lose all their triangles. If nothing is left, the run
   * ends with RunStatus::DEGENERATE. */
  void setMaximumEdgeLength (double length);
  double getMaximumEdgeLength () const; ///< see setMaximumEdgeLength()

  /** \brief As setMaximumEdgeLength(), in local spacings: the mean of those of the two ends of the
   * edge; 0 or more; default 0: no limit. Edges of a good mesh are up to about 3 long, and up to 6
   * where the sampling is uneven. */
  void setMaximumEdgeRatio (double spacings);
  double getMaximumEdgeRatio () const; ///< see setMaximumEdgeRatio()

  /** \brief Whether triangles are taken out until no two cross each other; default false. It is the
   * last resort after setRemoveSelfIntersections(), for those who simulate, print or trace rays: at
   * such places the mesh gets holes, mostly of a few triangles. getStatistics() counts them. */
  void setOpenSelfIntersections (bool open);
  bool getOpenSelfIntersections () const; ///< see setOpenSelfIntersections()

  /** \brief Components of the mesh with fewer points are left out, 0 or more; default 0: none.
   * Components are counted after long edges and crossing triangles were cut off. */
  void setMinimumComponentSize (int points);
  int getMinimumComponentSize () const; ///< see setMinimumComponentSize()

  /** \brief Whether points that lie off any surface are left out of the mesh; default true.
   * getOutlierIndices() has them. */
  void setRemoveOutliers (bool remove_outliers);
  bool getRemoveOutliers () const; ///< see setRemoveOutliers()

  /** \brief What becomes of regions that are no surface at any scale, such as leaves and grass;
   * default AUTO: left out of a surface where it certainly is none. getScatterIndices() has their points. */
  void setScatterPolicy (ScatterPolicy policy);
  ScatterPolicy getScatterPolicy () const; ///< see setScatterPolicy()

  /** \brief Whether points are connected as they lie when projected on local planes, where noise is
   * strong; default true. The vertices of the mesh are not moved. */
  void setDenoise (bool denoise);
  bool getDenoise () const; ///< see setDenoise()

  /** \brief Number of nearest neighbours of each point, 6 to 200; default 20. Not for balls. */
  void setKSearch (int k);
  int getKSearch () const; ///< see setKSearch()

  /** \brief Which points a point of a disc is a convex combination of; default NEAREST_DELAUNAY. A
   * surface takes Delaunay stars in any case. With BALL and BALL_DELAUNAY, the points in a ball
   * replace the k nearest in all stages (TW 385, sections 2.1 and 6). */
  void setNeighborhood (Neighborhood neighborhood);
  Neighborhood getNeighborhood () const; ///< see setNeighborhood()

  /** \brief Radius of balls, in mean distances of a point to its 6 nearest, 1 to 10; default 2.25,
   * which gives about 20 neighbours. */
  void setBallRadius (double spacings);
  double getBallRadius () const; ///< see setBallRadius()

  /** \brief All that only a disc takes: how its boundary loop is found, or the loop itself; the
   * curve on which it is laid; weights and solver of the linear system. Another surface does not
   * read them. With DiscOptions::tw385(), the run is the method of TW 385 and nothing else, with
   * pcl::search::KdTree and pcl::NormalEstimation where no other search method and no normals are
   * given. They replace all that were set before, a loop of setPrescribedLoop() as well: to
   * keep what was set, change a copy of getDiscOptions(). */
  void setDiscOptions (const DiscOptions& options);
  const DiscOptions& getDiscOptions () const; ///< see setDiscOptions()

  /** \brief Gives the boundary loop: cloud indices in order, either way round, each once, 3 or
   * more. The surface is then made as a disc. Default empty: the loop is found. Not with
   * Topology::SURFACE. It is BoundaryOptions::loop of getDiscOptions() in the type of PCL's
   * indices: the later call of the two setters counts. */
  void setPrescribedLoop (const pcl::Indices& loop);
  const pcl::Indices& getPrescribedLoop () const; ///< see setPrescribedLoop()

  /** \brief Whether the normals of the points are those of their tangent planes, instead of planes
   * through their neighbours; default false. For point types with normals only: with others, a run
   * ends with RunStatus::INVALID_OPTION. Lengths do not matter. Where a normal is zero or not
   * finite, the plane is fitted. A scan that is connected as its sensor saw it needs no planes.
   * With Facing::AUTO, the mesh also faces where the normals point to; where they contradict each
   * other, as if they had never been oriented, a warning says so and they decide nothing. */
  void setUseInputNormals (bool use);
  bool getUseInputNormals () const; ///< see setUseInputNormals()

  /** \brief Whether neighbours on another sheet of the surface are dropped; default true. */
  void setFilterSheets (bool filter_sheets);
  bool getFilterSheets () const; ///< see setFilterSheets()

  /** \brief Whether edges are flipped in space towards Delaunay, and folds repaired; default true.
   */
  void setFlipEdges (bool flip_edges);
  bool getFlipEdges () const; ///< see setFlipEdges()

  /** \brief Whether the mesh is changed where its triangles cross each other, by flips of edges and
   * by moving points to other triangles; default true. Not without setFlipEdges, and not where
   * noise makes the true triangles cross each other, too: for scans that are connected as their
   * sensor saw them, and where noisy points were projected to connect them (see setDenoise).
   * Report::check tells how many pairs are left. */
  void setRemoveSelfIntersections (bool remove);
  bool getRemoveSelfIntersections () const; ///< see setRemoveSelfIntersections()

  /** \brief Whether the mesh gets normals of its vertices; default false. They are the means of the
   * normals of the triangles around a point, weighted by their angles there, and point to the front
   * of the mesh; see vertexNormals(). A pcl::PolygonMesh then has them in the fields normal_x,
   * normal_y and normal_z of its cloud, and a pcl::PointCloud in those of its points, if their type
   * has normals. Normals of the input are replaced in the output, a curvature is not. Points in no
   * triangle have (0, 0, 0). Takes 64 bytes per point and a tenth of the time of a run. */
  void setComputeNormals (bool compute);
  bool getComputeNormals () const; ///< see setComputeNormals()
  /** \brief Whether texture coordinates of the mesh are computed; default false.
   * getTextureCoordinates() has them, and reconstruct() of a pcl::TextureMesh in any case. A disc
   * (Topology::DISC) is laid out in one piece, any other mesh in charts with little stretch. Takes
   * about as long as the reconstruction. */
  void setComputeTextureCoordinates (bool compute);
  bool getComputeTextureCoordinates () const; ///< see setComputeTextureCoordinates()

  /** \brief Mean stretch above which a chart of the texture is cut, 1 or more; see
   * TextureOptions::largest_stretch, also for the default. */
  void setLargestStretch (double stretch);
  double getLargestStretch () const; ///< see setLargestStretch()

  /** \brief Number of threads; default 0: one for each core. The result is the same. */
  void setNumberOfThreads (unsigned int nr_threads = 0);
  unsigned int getNumberOfThreads () const; ///< see setNumberOfThreads()

  /** \brief Called when a stage of a run begins, by the thread that called reconstruct(); default
   * none. An exception from it ends the run with RunStatus::INTERNAL_ERROR. */
  void setStageCallback (std::function<void (Stage)> callback);
  const std::function<void (Stage)>& getStageCallback () const; ///< see setStageCallback()

  /** \brief Called with the fraction of the run that is done, from 0 to 1 and never decreasing:
   * when a stage begins, up to 20 times a second within it, and with 1 at the end; default none.
   * The fraction is estimated from typical runs, and does not move while a linear system is solved.
   * Thread and exceptions are as for setStageCallback(). */
  void setProgressCallback (std::function<void (double fraction)> callback);
  const std::function<void (double)>& getProgressCallback () const; ///< see setProgressCallback()

  /** \brief Asked whether the run is to be cancelled, as often as the progress callback is called;
   * default none. If it returns true, the run ends with RunStatus::CANCELLED and an empty mesh,
   * mostly within a tenth of a second; direct solvers, CGAL's triangulation and a search method of
   * PCL are waited for. It may read an atomic variable that another thread sets. Thread and
   * exceptions are as for setStageCallback(). */
  void setCancelledCallback (std::function<bool ()> callback);
  const std::function<bool ()>& getCancelledCallback () const; ///< see setCancelledCallback()

  /** \brief Outcome of the last run; NOT_RUN before the first. */
  RunStatus getStatus () const;

  /** \brief Cause of a failure and what to do, in one sentence; empty after SUCCESS. */
  const std::string& getMessage () const;

  /** \brief The whole report on the last run. */
  const Report& getReport () const;

  /** \brief Counts, times and figures of the last run. */
  const Statistics& getStatistics () const;

  /** \brief The mesh as examined at the end of the last run: components, genus, boundary loops with
   * their sizes, folds and more. */
  const MeshCheck& getMeshCheck () const;

  /** \brief The longest boundary loop in order, each point once; empty if the surface is closed. */
  pcl::Indices getBoundaryLoop () const;

  /** \brief Position of every cloud point in the plane, if the mesh was made as a disc; NaN where a
   * point was not used. Else empty. */
  const std::vector<Eigen::Vector2d>& getParameters () const;

  /** \brief The normal of each point of the whole cloud in the mesh, (0, 0, 0) for points in no
   * triangle. Empty if there is no mesh, or if setComputeNormals() did not ask for them. */
  const std::vector<Eigen::Vector3f>& getNormals () const;
  /** \brief Texture coordinates of the mesh of the last run, parallel to its triangles; its status
   * is NOT_RUN if none were asked for. Points are indices of the whole cloud. */
  const TextureCoordinates& getTextureCoordinates () const;

  /** \brief The component of the mesh that each point of the whole cloud is in: they are numbered
   * from 0 in the order of their first points; -1 for points in no triangle. Empty if there is no
   * mesh. As that of pcl::GreedyProjectionTriangulation, which numbers the points of setIndices()
   * instead. */
  std::vector<int> getPartIDs () const;

  /** \brief The PointState of each point of the whole cloud. Empty if there is no mesh. As that of
   * pcl::GreedyProjectionTriangulation, which numbers the points of setIndices() instead. */
  std::vector<int> getPointStates () const;

  /** \brief Finite points, neither duplicates nor outliers, that are in no triangle; ascending. */
  pcl::Indices getUnusedIndices () const;

  /** \brief Points left out of the mesh because they lie off any surface; ascending. */
  pcl::Indices getOutlierIndices () const;

  /** \brief Points of regions that are no surface at any scale, such as leaves; ascending. They
   * are left out of the mesh, but with ScatterPolicy::KEEP. */
  pcl::Indices getScatterIndices () const;

  /** \brief Points with a NaN or infinite coordinate; ascending. */
  pcl::Indices getNonFiniteIndices () const;

  /** \brief Pairs (point, the equal point that stands for it in the mesh); ascending. */
  std::vector<std::array<pcl::index_t, 2>> getDuplicates () const;

protected:
  /** \brief All options at their defaults, and no run yet. */
  ReconstructionState ();
  /** \brief The same options and results. A callback is copied as well. */
  ReconstructionState (const ReconstructionState& other);
  /** \brief The same options and results. */
  ReconstructionState& operator= (const ReconstructionState& other);
  /** \brief Not virtual: an object is deleted as what it is. */
  ~ReconstructionState ();

  /** \brief Forgets the results of the last run. */
  void beginRun ();

  /** \brief Records a failure. */
  void fail (RunStatus status, const std::string& message);

  /** \brief Records what the exception that is being handled means. To be called in a handler. */
  void failByException () noexcept;

  /** \brief Checks a cloud before its points are read.
   * \param size number of its points
   * \param indices those that are to be reconstructed
   * \return false, with the failure recorded, if the cloud is too large, or an index or the given
   * boundary loop is outside of it */
  bool checkCloud (std::size_t size, const pcl::Indices& indices);

  /** \brief Reconstructs with the options. Records the report, and what each point is in the mesh.
   * \return the triangles, none after a failure */
  std::vector<std::array<std::uint32_t, 3>> triangulatePoints (Input&& input);

  /** \brief The mesh with the texture coordinates of the last run.
   * \param[in,out] mesh of that run; moved from */
  void makeTextureMesh (pcl::PolygonMesh& mesh, pcl::TextureMesh& output) const;

  /** \brief Prints a failure or the warnings.
   * \param class_name of whom they are */
  void printOutcome (const std::string& class_name) const;

private:
  struct Data;
  std::unique_ptr<Data> data_; // never null
};

} // namespace floater
} // namespace pcl
