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

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>

namespace {
using Positions = std::vector<Eigen::Vector3d>;
using Polygons = std::vector<std::array<std::size_t, 3>>;
using Stages = std::vector<std::pair<const char*, double>>; // seconds since the begin, at the end

double
now ()
{
  return std::chrono::duration<double> (std::chrono::steady_clock::now ().time_since_epoch ())
      .count ();
}

rusage
usage ()
{
  rusage used{};
  ::getrusage (RUSAGE_SELF, &used);
  return used;
}

double
cpuSeconds ()
{
  const rusage used = usage ();
  return static_cast<double> (used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double> (used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

#ifdef PEER_GP3
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

Polygons
greedyProjection (const pcl::PointCloud<pcl::PointXYZ>::Ptr& cloud, unsigned threads,
                  Stages& stages)
{
  constexpr double RADIUS = 5.0; // in spacings
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree (new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud (cloud);
  const double spacing = meanSpacing (*cloud, *tree);
  stages.emplace_back ("spacing", now ());

  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation (threads);
  estimation.setInputCloud (cloud);
  estimation.setSearchMethod (tree);
  estimation.setKSearch (20); // as many as ours
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute (normals);
  const pcl::PointCloud<pcl::PointNormal>::Ptr joined (new pcl::PointCloud<pcl::PointNormal>);
  pcl::concatenateFields (*cloud, normals, *joined);
  stages.emplace_back ("normals", now ());

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
  pcl::PolygonMesh mesh;
  gp3.reconstruct (mesh);
  stages.emplace_back ("triangles", now ());
  Polygons triangles;
  for (const pcl::Vertices& polygon : mesh.polygons)
    triangles.push_back ({static_cast<std::size_t> (polygon.vertices[0]),
                          static_cast<std::size_t> (polygon.vertices[1]),
                          static_cast<std::size_t> (polygon.vertices[2])});
  return triangles;
}

// The method with its points in the form that it takes; making that form is not measured.
std::function<Polygons (Stages&)>
makeMethod (const Positions& positions, unsigned threads)
{
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud (new pcl::PointCloud<pcl::PointXYZ>);
  for (const Eigen::Vector3d& p : positions) {
    pcl::PointXYZ point;
    point.getVector3fMap () = p.cast<float> ();
    cloud->push_back (point);
  }
  return [cloud, threads] (Stages& stages) { return greedyProjection (cloud, threads, stages); };
}
#else
std::function<Polygons (Stages&)>
makeMethod (const Positions& positions, unsigned /*threads*/)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  for (const Eigen::Vector3d& p : positions)
    points.emplace_back (p.x (), p.y (), p.z ());
  return [points = std::move (points)] (Stages& /*none*/) {
    constexpr double RADIUS_RATIO = 5.0, BETA = 0.52;
    Polygons facets;
    CGAL::advancing_front_surface_reconstruction (points.begin (), points.end (),
                                                  std::back_inserter (facets), RADIUS_RATIO, BETA);
    return facets;
  };
}
#endif

void
run (const std::string& file, unsigned threads)
{
  std::function<Polygons (Stages&)> method;
  std::size_t points = 0;
  {
    pcl::floater::Cloud cloud = pcl::floater::readCloud (file);
    cloud.fields.clear ();
    pcl::floater::Triangles none;
    pcl::floater::removeNonFinitePoints (cloud, none);
    points = cloud.size ();
    method = makeMethod (cloud.positions (), threads);
  }
  Stages stages;
  const double cpu_before = cpuSeconds (), begin = now ();
  const Polygons triangles = method (stages);
  const double seconds = now () - begin, cpu = cpuSeconds () - cpu_before;
  if (triangles.empty ())
    throw std::runtime_error ("there is no triangle");
  std::vector<bool> is_used (points, false);
  for (const auto& triangle : triangles)
    for (const std::size_t p : triangle)
      is_used.at (p) = true;
  std::printf (
      "{\"seconds\": %.6f, \"cpu_seconds\": %.6f, \"peak_bytes\": %ld, \"triangles\": %zu, "
      "\"used_points\": %td, \"stages\": {",
      seconds, cpu, 1024 * usage ().ru_maxrss, triangles.size (),
      std::count (is_used.begin (), is_used.end (), true));
  double before = begin;
  for (const auto& [stage, end] : stages) {
    std::printf ("%s\"%s\": %.6f", before == begin ? "" : ", ", stage, end - before);
    before = end;
  }
  std::printf ("}}\n");
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
