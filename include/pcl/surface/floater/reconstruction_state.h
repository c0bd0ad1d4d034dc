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

  /** \name Options
   * Meaning, unit, range and default are those of the named field. A getter has what was set.
   * \{ */
  void setTopology (Topology topology);   ///< Options::topology
  Topology getTopology () const;          ///< as asked for; getReport() has that of the mesh
  void setHolePolicy (HolePolicy policy); ///< HoleOptions::policy
  HolePolicy getHolePolicy () const;      ///< see setHolePolicy()
  void setKeptLoops (int loops);          ///< HoleOptions::kept_loops
  int getKeptLoops () const;              ///< see setKeptLoops()
  /// HoleOptions::largest_hole and its unit
  void setLargestHole (double size, LengthUnit unit = LengthUnit::SPACINGS);
  double getLargestHole () const;                   ///< see setLargestHole(); 0: none was set
  LengthUnit getLargestHoleUnit () const;           ///< HoleOptions::unit
  void setViewPoint (double x, double y, double z); ///< ViewOptions::viewpoint; sets ViewUse::GIVEN
  const std::array<double, 3>& getViewPoint () const; ///< the given one, or (0, 0, 0)
  void setViewUse (ViewUse use);                      ///< ViewOptions::use
  ViewUse getViewUse () const;                        ///< see setViewUse()
  void setFacing (Facing facing);                     ///< Options::facing
  Facing getFacing () const;                          ///< see setFacing()
  void setMaximumEdgeLength (double length);          ///< TrimmingOptions::maximum_edge_length
  double getMaximumEdgeLength () const;               ///< see setMaximumEdgeLength()
  void setMaximumEdgeRatio (double spacings);         ///< TrimmingOptions::maximum_edge_ratio
  double getMaximumEdgeRatio () const;                ///< see setMaximumEdgeRatio()
  void setOpenSelfIntersections (bool open);          ///< TrimmingOptions::open_self_intersections
  bool getOpenSelfIntersections () const;             ///< see setOpenSelfIntersections()
  void setMinimumComponentSize (int points);          ///< TrimmingOptions::minimum_component_size
  int getMinimumComponentSize () const;               ///< see setMinimumComponentSize()
  void setRemoveOutliers (bool remove_outliers);      ///< Options::remove_outliers
  bool getRemoveOutliers () const;                    ///< see setRemoveOutliers()
  void setScatterPolicy (ScatterPolicy policy);       ///< Options::scatter
  ScatterPolicy getScatterPolicy () const;            ///< see setScatterPolicy()
  void setDenoise (bool denoise);                     ///< Options::denoise
  bool getDenoise () const;                           ///< see setDenoise()
  void setKSearch (int k);                            ///< NeighborOptions::k
  int getKSearch () const;                            ///< see setKSearch()
  void setNeighborhood (Neighborhood neighborhood);   ///< NeighborOptions::kind
  Neighborhood getNeighborhood () const;              ///< see setNeighborhood()
  void setBallRadius (double spacings);               ///< NeighborOptions::ball_radius
  double getBallRadius () const;                      ///< see setBallRadius()
  void setFilterSheets (bool filter_sheets);          ///< Options::filter_sheets
  bool getFilterSheets () const;                      ///< see setFilterSheets()
  void setFlipEdges (bool flip_edges);                ///< Options::flip_edges
  bool getFlipEdges () const;                         ///< see setFlipEdges()
  void setRemoveSelfIntersections (bool remove);      ///< Options::remove_self_intersections
  bool getRemoveSelfIntersections () const;           ///< see setRemoveSelfIntersections()
  void setLargestStretch (double stretch);            ///< TextureOptions::largest_stretch
  double getLargestStretch () const;                  ///< see setLargestStretch()
  void setNumberOfThreads (unsigned int nr_threads = 0);        ///< Options::threads
  unsigned int getNumberOfThreads () const;                     ///< see setNumberOfThreads()
  void setStageCallback (std::function<void (Stage)> callback); ///< Options::stage_callback
  const std::function<void (Stage)>& getStageCallback () const; ///< see setStageCallback()
  /// Options::progress_callback
  void setProgressCallback (std::function<void (double fraction)> callback);
  const std::function<void (double)>& getProgressCallback () const; ///< see setProgressCallback()
  void setCancelledCallback (std::function<bool ()> callback);      ///< Options::cancelled_callback
  const std::function<bool ()>& getCancelledCallback () const;      ///< see setCancelledCallback()

  /** \brief Options::disc. With DiscOptions::tw385(), the run is the method of TW 385 and nothing else,
   * with pcl::search::KdTree and pcl::NormalEstimation where no other search method and no normals
   * are given. They replace all that were set before, a loop of setPrescribedLoop() as well: to keep
   * what was set, change a copy of getDiscOptions(). */
  void setDiscOptions (const DiscOptions& options);
  const DiscOptions& getDiscOptions () const; ///< see setDiscOptions()

  /** \brief BoundaryOptions::loop of getDiscOptions() in the type of PCL's indices: the later call of
   * the two setters counts. Not with Topology::SURFACE. */
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

  /** \brief Whether the mesh gets normals of its vertices, see vertexNormals(); default false. A
   * pcl::PolygonMesh then has them in the fields normal_x, normal_y and normal_z of its cloud, and a
   * pcl::PointCloud in those of its points, if their type has normals. Normals of the input are
   * replaced in the output, a curvature is not. Takes 64 bytes per point and a tenth of a run. */
  void setComputeNormals (bool compute);
  bool getComputeNormals () const; ///< see setComputeNormals()

  /** \brief Whether texture coordinates of the mesh are computed; default false.
   * getTextureCoordinates() has them, and reconstruct() of a pcl::TextureMesh in any case. A disc
   * (Topology::DISC) is laid out in one piece, any other mesh in charts with little stretch. Takes
   * about as long as the reconstruction. */
  void setComputeTextureCoordinates (bool compute);
  bool getComputeTextureCoordinates () const; ///< see setComputeTextureCoordinates()
  /** \} */

  /** \name Results of the last run
   * Of lists of indices, each is a field of Report in the type of PCL's indices.
   * \{ */
  RunStatus getStatus () const;              ///< Report::status; NOT_RUN before the first run
  const std::string& getMessage () const;    ///< Report::message
  const Report& getReport () const;          ///< the whole report
  const Statistics& getStatistics () const;  ///< Report::statistics
  const MeshCheck& getMeshCheck () const;    ///< Report::check
  pcl::Indices getBoundaryLoop () const;     ///< Report::loop
  pcl::Indices getUnusedIndices () const;    ///< Report::unused
  pcl::Indices getOutlierIndices () const;   ///< Report::outliers
  pcl::Indices getScatterIndices () const;   ///< Report::scatter
  pcl::Indices getNonFiniteIndices () const; ///< Report::non_finite
  const std::vector<Eigen::Vector2d>& getParameters () const;      ///< Report::parameters
  std::vector<std::array<pcl::index_t, 2>> getDuplicates () const; ///< Report::duplicates

  /** \brief The normal of each point of the whole cloud in the mesh, (0, 0, 0) for points in no
   * triangle. Empty if there is no mesh, or if setComputeNormals() did not ask for them. */
  const std::vector<Eigen::Vector3f>& getNormals () const;

  /** \brief Texture coordinates of the mesh, parallel to its triangles; their status is NOT_RUN if none
   * were asked for. Points are indices of the whole cloud. */
  const TextureCoordinates& getTextureCoordinates () const;

  /** \brief The component of the mesh that each point of the whole cloud is in: they are numbered
   * from 0 in the order of their first points; -1 for points in no triangle. Empty if there is no
   * mesh. pcl::GreedyProjectionTriangulation numbers the points of setIndices() instead. */
  std::vector<int> getPartIDs () const;

  /** \brief The PointState of each point of the whole cloud, otherwise as getPartIDs(). */
  std::vector<int> getPointStates () const;
  /** \} */

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
