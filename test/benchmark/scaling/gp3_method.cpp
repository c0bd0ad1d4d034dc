// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// pcl::GreedyProjectionTriangulation with the settings of PCL's tutorial. What it needs and a user
// has to find first, a radius and normals, is part of its time.
#include "method_run.h"
#include "pcl_points.h"
#include "stopwatch.h"

#include <pcl/common/angles.h>
#include <pcl/common/io.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/impl/gp3.hpp>

#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double MU = 2.5;           // search radius, in distances to the nearest neighbour
constexpr double RADIUS = 5.0;       // largest search radius, in spacings
constexpr int SPACING_NEIGHBORS = 6; // the spacing is the mean distance to so many
constexpr int NORMAL_NEIGHBORS = 20; // as many as ours
constexpr int LARGEST_NEIGHBORHOOD = 100;
constexpr float SURFACE_ANGLE = 45.0F, SMALLEST_ANGLE = 10.0F, LARGEST_ANGLE = 120.0F; // degrees

class Gp3Method : public Method
{
public:
  explicit Gp3Method (int threads) : threads_ (threads) {}

  void prepare (const std::vector<Eigen::Vector3d>& points) override { cloud_ = toPcl (points); }

  void run () override
  {
    const Stopwatch stopwatch;
    const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree (new pcl::search::KdTree<pcl::PointXYZ>);
    tree->setInputCloud (cloud_);
    const double spacing = meanSpacing (*tree);
    const double spacing_end = stopwatch.seconds ();
    const pcl::PointCloud<pcl::PointNormal>::Ptr with_normals = addNormals (tree);
    const double normals_end = stopwatch.seconds ();
    triangulate (with_normals, RADIUS * spacing);
    stages_ = {{"spacing", spacing_end},
               {"normals", normals_end - spacing_end},
               {"triangles", stopwatch.seconds () - normals_end}};
  }

  Triangles triangles () const override { return fromPcl (mesh_.polygons); }

  std::vector<StageTime> stages () const override { return stages_; }

private:
  // Mean over the points of their mean distance to the nearest others.
  double meanSpacing (const pcl::search::KdTree<pcl::PointXYZ>& tree) const
  {
    pcl::Indices found;
    std::vector<float> sqr_distances;
    double sum = 0.0;
    for (const pcl::PointXYZ& point : *cloud_) {
      tree.nearestKSearch (point, SPACING_NEIGHBORS + 1, found, sqr_distances);
      for (const float sqr_distance : sqr_distances)
        sum += std::sqrt (static_cast<double> (sqr_distance)); // 0 of the point itself
    }
    return sum / (static_cast<double> (cloud_->size ()) * SPACING_NEIGHBORS);
  }

  pcl::PointCloud<pcl::PointNormal>::Ptr
  addNormals (const pcl::search::KdTree<pcl::PointXYZ>::Ptr& tree) const
  {
    pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation (
        static_cast<unsigned int> (threads_));
    estimation.setInputCloud (cloud_);
    estimation.setSearchMethod (tree);
    estimation.setKSearch (NORMAL_NEIGHBORS);
    pcl::PointCloud<pcl::Normal> normals;
    estimation.compute (normals);
    pcl::PointCloud<pcl::PointNormal>::Ptr joined (new pcl::PointCloud<pcl::PointNormal>);
    pcl::concatenateFields (*cloud_, normals, *joined);
    return joined;
  }

  void triangulate (const pcl::PointCloud<pcl::PointNormal>::Ptr& cloud, double radius)
  {
    pcl::GreedyProjectionTriangulation<pcl::PointNormal> gp3;
    gp3.setSearchRadius (radius);
    gp3.setMu (MU);
    gp3.setMaximumNearestNeighbors (LARGEST_NEIGHBORHOOD);
    gp3.setMaximumSurfaceAngle (pcl::deg2rad (SURFACE_ANGLE));
    gp3.setMinimumAngle (pcl::deg2rad (SMALLEST_ANGLE));
    gp3.setMaximumAngle (pcl::deg2rad (LARGEST_ANGLE));
    gp3.setNormalConsistency (false);
    gp3.setInputCloud (cloud);
    gp3.setSearchMethod (pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>> ());
    gp3.reconstruct (mesh_);
  }

  int threads_;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_;
  pcl::PolygonMesh mesh_;
  std::vector<StageTime> stages_;
};

} // namespace
} // namespace floater
} // namespace pcl

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  return runMethod (argc, argv, {"gp3"}, [] (const std::string& /*name*/, int threads) {
    return std::make_unique<Gp3Method> (threads);
  });
}
