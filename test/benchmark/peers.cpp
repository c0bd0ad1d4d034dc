// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// pcl_floater_peers METHOD CLOUD THREADS: runs another method once, and prints what it took as
// JSON. gp3: pcl::GreedyProjectionTriangulation with the settings of PCL's tutorial. The radius and
// the normals, which a user has to find first, are part of its time. afs: CGAL's advancing front
// with its default settings, in one thread.
#include "cloud_reader.h"

#ifdef PEER_GP3
#include <pcl/common/angles.h>
#include <pcl/common/io.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/impl/gp3.hpp>
#else
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

#include <sys/resource.h>

#include <chrono>
#include <cstdio>

namespace {
using Positions = std::vector<Eigen::Vector3d>;

#ifdef PEER_GP3
using Polygons = std::vector<std::array<pcl::index_t, 3>>;

// Mean over the points of their mean distance to the six nearest others.
double
meanSpacing (const pcl::PointCloud<pcl::PointXYZ>& cloud,
             const pcl::search::KdTree<pcl::PointXYZ>& tree)
{
  constexpr int NEIGHBORS = 6;
  pcl::Indices found;
  std::vector<float> sqr_distances;
  double sum = 0.0;
  for (const pcl::PointXYZ& point : cloud) {
    tree.nearestKSearch (point, NEIGHBORS + 1, found, sqr_distances);
    for (const float sqr_distance : sqr_distances)
      sum += std::sqrt (static_cast<double> (sqr_distance)); // 0 of the point itself
  }
  return sum / (static_cast<double> (cloud.size ()) * NEIGHBORS);
}

// The points in the form that the method takes; making that form is not measured.
pcl::PointCloud<pcl::PointXYZ>::Ptr
formOf (const Positions& positions)
{
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud (new pcl::PointCloud<pcl::PointXYZ>);
  for (const Eigen::Vector3d& p : positions) {
    pcl::PointXYZ point;
    point.getVector3fMap () = p.cast<float> ();
    cloud->push_back (point);
  }
  return cloud;
}

Polygons
triangulate (const pcl::PointCloud<pcl::PointXYZ>::Ptr& cloud, unsigned threads)
{
  constexpr double RADIUS = 5.0; // in spacings
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree (new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud (cloud);
  const double spacing = meanSpacing (*cloud, *tree);

  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation (threads);
  estimation.setInputCloud (cloud);
  estimation.setSearchMethod (tree);
  estimation.setKSearch (20); // as many as ours
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute (normals);
  const pcl::PointCloud<pcl::PointNormal>::Ptr joined (new pcl::PointCloud<pcl::PointNormal>);
  pcl::concatenateFields (*cloud, normals, *joined);

  pcl::GreedyProjectionTriangulation<pcl::PointNormal> gp3;
  gp3.setSearchRadius (RADIUS * spacing);
  gp3.setMu (2.5);
  gp3.setMaximumNearestNeighbors (100);
  gp3.setMaximumSurfaceAngle (pcl::deg2rad (45.0));
  gp3.setMinimumAngle (pcl::deg2rad (10.0));
  gp3.setMaximumAngle (pcl::deg2rad (120.0));
  gp3.setNormalConsistency (false);
  gp3.setInputCloud (joined);
  gp3.setSearchMethod (pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>> ());
  std::vector<pcl::Vertices> polygons;
  gp3.reconstruct (polygons);
  Polygons triangles;
  for (const pcl::Vertices& polygon : polygons)
    triangles.push_back ({polygon.vertices[0], polygon.vertices[1], polygon.vertices[2]});
  return triangles;
}
#else
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polygons = std::vector<std::array<std::size_t, 3>>;

std::vector<Kernel::Point_3>
formOf (const Positions& positions)
{
  std::vector<Kernel::Point_3> points;
  for (const Eigen::Vector3d& p : positions)
    points.emplace_back (p.x (), p.y (), p.z ());
  return points;
}

Polygons
triangulate (const std::vector<Kernel::Point_3>& points, unsigned /*threads*/)
{
  constexpr double RADIUS_RATIO = 5.0, BETA = 0.52;
  Polygons facets;
  CGAL::advancing_front_surface_reconstruction (points.begin (), points.end (),
                                                std::back_inserter (facets), RADIUS_RATIO, BETA);
  return facets;
}

#endif

void
run (const std::string& file, unsigned threads)
{
  pcl::floater::Cloud cloud = pcl::floater::readCloud (file);
  cloud.fields.clear ();
  pcl::floater::Triangles none;
  pcl::floater::removeNonFinitePoints (cloud, none);
  std::vector<bool> is_used (cloud.size (), false);
  const auto points = formOf (cloud.positions ());
  cloud = {};
  const auto begin = std::chrono::steady_clock::now ();
  const auto triangles = triangulate (points, threads);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now () - begin;
  if (triangles.empty ())
    throw std::runtime_error ("there is no triangle");
  for (const auto& triangle : triangles)
    for (const auto p : triangle)
      is_used.at (static_cast<std::size_t> (p)) = true;
  rusage used{};
  ::getrusage (RUSAGE_SELF, &used);
  std::printf (
      "{\"seconds\": %.6f, \"peak_bytes\": %ld, \"triangles\": %zu, \"used_points\": %td}\n",
      seconds.count (), 1024 * used.ru_maxrss, triangles.size (),
      std::count (is_used.begin (), is_used.end (), true));
}

} // namespace

int
main (int argc, char** argv)
{
  if (argc != 3) {
    std::fprintf (stderr, "Usage: %s CLOUD THREADS (0: one for each core)\n", argv[0]);
    return 1;
  }
  try {
    run (argv[1], static_cast<unsigned> (std::stoul (argv[2])));
  }
  catch (const std::exception& error) {
    std::fprintf (stderr, "%s: %s: %s\n", argv[0], argv[1], error.what ());
    return 2;
  }
  return 0;
}
