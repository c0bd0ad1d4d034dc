// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A run that tells how far it is, and one that another thread cancels.
#include "sample_clouds.h"

#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <atomic>
#include <iostream>
#include <thread>

int
main ()
{
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setInputCloud (makeTorus<pcl::PointXYZ> ());
  pcl::PolygonMesh mesh;

  // Both are called by the thread that calls reconstruct ().
  floater.setStageCallback (
      [] (pcl::floater::Stage stage) { std::cout << pcl::floater::stageName (stage) << '\n'; });
  double last = 0.0;
  floater.setProgressCallback ([&last] (double fraction) { last = fraction; });
  floater.reconstruct (mesh);
  const bool is_done = last == 1.0 && !mesh.polygons.empty ();

  // The run asks an atomic variable that another thread sets: a button, say.
  std::atomic<bool> is_cancelled{false};
  floater.setCancelledCallback ([&is_cancelled] { return is_cancelled.load (); });
  std::thread button ([&is_cancelled] { is_cancelled = true; });
  button.join (); // here, so that this example always ends in the same way
  floater.reconstruct (mesh);
  const bool was_cancelled = floater.getStatus () == pcl::floater::RunStatus::CANCELLED;
  std::cout << floater.getMessage () << '\n';

  return is_done && was_cancelled && mesh.polygons.empty () ? 0 : 1;
}
