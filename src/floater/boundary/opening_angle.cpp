// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/opening_angle.h"

#include "core/parallel.h"
#include "core/tangent_frame.h"
#include "local/planar_star.h"

namespace pcl::floater {
std::vector<Index>
openingAnglePoints (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                    const std::vector<Eigen::Vector3f>& normals, double opening_angle,
                    const RunContext& run)
{
  std::vector<std::uint8_t> wide (positions.size (), 0);
  parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
    PlanarStar star;
    std::vector<PlanarNeighbor> planar;
    for (std::size_t p = first; p < last; ++p) {
      const TangentFrame frame (normals[p].cast<double> ());
      planar.clear ();
      for (Index q : neighbors.row (p)) {
        const Eigen::Vector2d projected = frame.project (positions[q] - positions[p]);
        if (projected != Eigen::Vector2d::Zero ())
          planar.push_back ({projected, q});
      }
      star.make (planar);
      wide[p] = star.openingAngle () > opening_angle ? 1 : 0;
    }
  });
  std::vector<Index> points;
  for (std::size_t p = 0; p < wide.size (); ++p)
    if (wide[p] != 0)
      points.push_back (static_cast<Index> (p));
  return points;
}

} // namespace pcl::floater
