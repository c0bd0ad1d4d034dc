// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's advancing front surface reconstruction with its default settings. It has one thread.
#include "method_run.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <iterator>

namespace pcl
{
namespace floater
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr double RADIUS_RATIO = 5.0, BETA = 0.52;

class AfsMethod : public Method
{
public:
  void prepare (const std::vector<Eigen::Vector3d>& points) override
  {
    points_.reserve (points.size ());
    for (const Eigen::Vector3d& p : points)
      points_.emplace_back (p.x (), p.y (), p.z ());
  }

  void run () override
  {
    CGAL::advancing_front_surface_reconstruction (points_.begin (), points_.end (),
                                                  std::back_inserter (facets_), RADIUS_RATIO, BETA);
  }

  Triangles triangles () const override
  {
    Triangles triangles;
    triangles.reserve (facets_.size ());
    for (const auto& [a, b, c] : facets_)
      triangles.push_back ({static_cast<std::uint32_t> (a), static_cast<std::uint32_t> (b),
                            static_cast<std::uint32_t> (c)});
    return triangles;
  }

private:
  std::vector<Kernel::Point_3> points_;
  std::vector<std::array<std::size_t, 3>> facets_;
};

} // namespace
} // namespace floater
} // namespace pcl

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  return runMethod (argc, argv, {"afs"}, [] (const std::string& /*name*/, int /*one*/) {
    return std::make_unique<AfsMethod> ();
  });
}
