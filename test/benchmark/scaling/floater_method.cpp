// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Ours, through the class that users of PCL call.
#include "method_run.h"
#include "pcl_points.h"

#include <pcl/console/print.h>
#include <pcl/surface/floater_reconstruction.h>

#include <stdexcept>

namespace pcl
{
namespace floater
{
namespace
{
constexpr const char* DISC_NAME = "floater-disc";

class FloaterMethod : public Method
{
public:
  FloaterMethod (Topology topology, int threads)
  {
    floater_.setTopology (topology);
    floater_.setNumberOfThreads (static_cast<unsigned int> (threads));
  }

  void prepare (const std::vector<Eigen::Vector3d>& points) override
  {
    floater_.setInputCloud (toPcl (points));
  }

  void run () override
  {
    floater_.reconstruct (mesh_);
    if (floater_.getStatus () != RunStatus::SUCCESS)
      throw std::runtime_error (floater_.getMessage ());
  }

  Triangles triangles () const override { return fromPcl (mesh_.polygons); }

  std::vector<StageTime> stages () const override
  {
    std::vector<StageTime> stages;
    for (std::size_t i = 0; i < static_cast<std::size_t> (Stage::COUNT); ++i)
      stages.push_back (
          {stageName (static_cast<Stage> (i)), floater_.getReport ().statistics.seconds[i]});
    return stages;
  }

private:
  pcl::FloaterReconstruction<pcl::PointXYZ> floater_;
  pcl::PolygonMesh mesh_;
};

} // namespace
} // namespace floater
} // namespace pcl

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  pcl::console::setVerbosityLevel (pcl::console::L_ERROR);
  return runMethod (argc, argv, {"floater", DISC_NAME}, [] (const std::string& name, int threads) {
    return std::make_unique<FloaterMethod> (name == DISC_NAME ? Topology::DISC : Topology::AUTO,
                                            threads);
  });
}
