// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary/opening_angle.h"

#include "common/parallel.h"
#include "neighborhoods/planar_star.h"
#include "neighborhoods/tangent_frame.h"

namespace pcl
{
namespace floater
{
std::vector<Index>
openingAnglePoints (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
                    const std::vector<Eigen::Vector3f>& normals, double opening_angle, int threads)
{
  std::vector<std::uint8_t> wide (positions.size (), 0);
  parallelRanges (positions.size (), threads, [&] (std::size_t first, std::size_t last) {
    PlanarStar star;
    std::vector<PlanarNeighbor> neighbors;
    for (std::size_t p = first; p < last; ++p) {
      const TangentFrame frame (normals[p].cast<double> ());
      neighbors.clear ();
      for (Index q : near.row (p)) {
        const Eigen::Vector2d projected = frame.project (positions[q] - positions[p]);
        if (projected != Eigen::Vector2d::Zero ())
          neighbors.push_back ({projected, q});
      }
      star.make (neighbors);
      wide[p] = star.openingAngle () > opening_angle ? 1 : 0;
    }
  });
  std::vector<Index> points;
  for (std::size_t p = 0; p < wide.size (); ++p)
    if (wide[p] != 0)
      points.push_back (static_cast<Index> (p));
  return points;
}

} // namespace floater
} // namespace pcl
