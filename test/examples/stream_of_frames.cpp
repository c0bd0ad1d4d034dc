// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A loop as in a node of a robot: frames of a depth camera come in one after another, and one
// object makes a mesh of each. Pixels without a depth are NaN, as drivers deliver them.
#include "sample_clouds.h"

#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <Eigen/Geometry>

#include <iostream>
#include <limits>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// A camera that looks along z at a ball, which rolls along before a wall.
class Camera
{
public:
  static constexpr int WIDTH = 160, HEIGHT = 120;

  /// The next frame: organized, in the frame of the map, with the place of the camera.
  Cloud::Ptr next ()
  {
    ++frame_;
    const Cloud::Ptr cloud (new Cloud (WIDTH, HEIGHT));
    cloud->is_dense = false;
    cloud->sensor_origin_ = place_.homogeneous ();
    for (int row = 0; row < HEIGHT; ++row)
      for (int column = 0; column < WIDTH; ++column)
        cloud->at (column, row).getVector3fMap () = place_ + measure (column, row);
    return cloud;
  }

private:
  /// From the camera to what the pixel shows.
  Eigen::Vector3f measure (int column, int row)
  {
    constexpr float FOCAL_LENGTH = 130.0F, NOISE = 0.002F, RADIUS = 0.8F;
    const Eigen::Vector3f ray ((static_cast<float> (column) - WIDTH / 2.0F) / FOCAL_LENGTH,
                               (static_cast<float> (row) - HEIGHT / 2.0F) / FOCAL_LENGTH, 1.0F);
    if (jitter_ () > 0.24F) // nothing came back
      return Eigen::Vector3f::Constant (std::numeric_limits<float>::quiet_NaN ());
    float depth = 6.0F / (1.0F - 0.3F * ray.x ()); // of the wall, which stands at an angle
    const Eigen::Vector3f centre (-1.5F + 0.5F * static_cast<float> (frame_), 0.0F, 3.5F);
    const float along = ray.dot (centre) / ray.squaredNorm ();
    const float off = (along * ray - centre).norm ();
    if (off < RADIUS)
      depth = along - std::sqrt ((RADIUS * RADIUS - off * off) / ray.squaredNorm ());
    return (depth + NOISE * depth * jitter_ ()) * ray;
  }

  const Eigen::Vector3f place_{4.0F, 2.0F, 1.5F};
  int frame_ = -1;
  Jitter jitter_;
};

int
main ()
{
  Camera camera;
  std::size_t wrong = 0;

  // One object for all frames. The triangles are indices of the frame, which is not copied.
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  std::vector<pcl::Vertices> triangles;
  for (int frame = 0; frame < 6; ++frame) {
    const Cloud::Ptr cloud = camera.next (); // in a node, the callback of a topic has it
    floater.setInputCloud (cloud);
    floater.reconstruct (triangles);
    if (floater.getStatus () != pcl::floater::RunStatus::SUCCESS) {
      std::cerr << "frame " << frame << ": " << floater.getMessage () << '\n';
      continue; // the next frame may be better
    }
    const pcl::floater::Report& report = floater.getReport ();
    std::cout << "frame " << frame << ": " << report.non_finite.size () << " pixels without depth, "
              << triangles.size () << " triangles, "
              << (report.is_view ? "as the camera saw them\n" : "by neighbourhoods\n");

    // At most two triangles of each pixel.
    wrong += report.is_view && triangles.size () > cloud->size () ? 0 : 1;
  }
  return wrong == 0 ? 0 : 1;
}
