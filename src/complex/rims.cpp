// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/rims.h"

#include "neighborhoods/planar_star.h"
#include "neighborhoods/tangent_frame.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double EMPTY_SECTOR = 130.0; // degrees; 180 less the bend of a hole 6 spacings wide
constexpr double LEAVES_PLANE = 0.75;  // sine; neighbours on another sheet do not fill a sector
constexpr double SAME_SHEET = 0.3;     // cosine between normals
constexpr double OPEN = 0.8; // share of points with an empty sector at a true boundary ...
constexpr double WIDE = 6.0; // ... which is that many steps wide, a regular polygon of 19 sides
constexpr double ALL_OPEN = 0.97; // the same where it is small ...
constexpr double SMALL = 4.0;     // ... a polygon of 13 sides
constexpr double HALF_OPEN = 0.5; // the same where it is long: ragged and noisy borders ...
constexpr double LONG = 2.0;      // ... of more points than twice the root of those of its piece
constexpr double SHORT = 1.0;     // as long as that, a loop is no hole but the border of its piece
constexpr std::size_t WIDTH_POINTS = 256; // at most, evenly taken, for the width
constexpr double DEGREE = 3.14159265358979323846 / 180.0;

// What the automatic policy takes for the end of the surface.
bool
isBoundary (const Rim& rim, const std::vector<std::size_t>& piece_points)
{
  const auto count = static_cast<double> (rim.points.size ());
  const double steps = rim.width * count / rim.length;
  const double length = count / std::sqrt (static_cast<double> (piece_points[rim.piece]));
  return (rim.open_share >= OPEN && (steps >= WIDE || length >= SHORT)) ||
         (rim.open_share >= ALL_OPEN && steps >= SMALL) ||
         (rim.open_share >= HALF_OPEN && length >= LONG);
}

// Tells whether a point sees a wide empty sector among its neighbours, all or those on its sheet.
class SectorTest
{
public:
  SectorTest (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
              const std::vector<Eigen::Vector3f>& normals)
      : positions_ (positions), near_ (near), normals_ (normals)
  {
  }

  bool hasEmptySector (Index p, bool same_sheet)
  {
    const Eigen::Vector3d normal = normals_[p].cast<double> ();
    const TangentFrame frame (normal);
    neighbors_.clear ();
    for (Index q : near_.row (p)) {
      const Eigen::Vector3d offset = positions_[q] - positions_[p];
      const Eigen::Vector3d other = normals_[q].cast<double> ();
      const double limit = LEAVES_PLANE * offset.norm ();
      if (!same_sheet ||
          (std::abs (normal.dot (offset)) <= limit && std::abs (other.dot (offset)) <= limit &&
           std::abs (normal.dot (other)) >= SAME_SHEET))
        neighbors_.push_back ({frame.project (offset), q});
    }
    star_.order (neighbors_);
    return star_.openingAngle () > EMPTY_SECTOR * DEGREE;
  }

private:
  const std::vector<Eigen::Vector3d>& positions_;
  const FlatLists& near_;
  const std::vector<Eigen::Vector3f>& normals_;
  PlanarStar star_;
  std::vector<PlanarNeighbor> neighbors_;
};

double
widthOf (const std::vector<Index>& points, const std::vector<Eigen::Vector3d>& positions)
{
  const std::size_t step = (points.size () + WIDTH_POINTS - 1) / WIDTH_POINTS;
  double sqr_width = 0.0;
  for (std::size_t i = 0; i < points.size (); i += step)
    for (std::size_t j = 0; j < i; j += step)
      sqr_width =
          std::max (sqr_width, (positions[points[i]] - positions[points[j]]).squaredNorm ());
  return std::sqrt (sqr_width);
}

// Boundaries before all others, then by how much of the rim sees an empty sector.
std::vector<Rim*>
bySize (std::vector<Rim>& rims, const std::vector<std::size_t>& piece_points)
{
  std::vector<Rim*> sorted;
  sorted.reserve (rims.size ());
  for (Rim& rim : rims)
    sorted.push_back (&rim);
  const auto key = [&piece_points] (const Rim* rim) {
    return std::make_tuple (isBoundary (*rim, piece_points), rim->empty_share * rim->length,
                            rim->length);
  };
  std::stable_sort (sorted.begin (), sorted.end (),
                    [&key] (const Rim* a, const Rim* b) { return key (b) < key (a); });
  return sorted;
}

} // namespace

std::vector<Rim>
findRims (const SurfaceMesh& mesh, const std::vector<Index>& pieces,
          const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
          const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing)
{
  std::vector<Rim> rims;
  SectorTest test (positions, near, normals);
  for (std::vector<Index>& loop : boundaryLoops (mesh)) {
    Rim rim{{}, pieces[mesh.triangle_of[loop.front ()]], 0.0, widthOf (loop, positions), 0.0, 0.0,
            0.0};
    std::size_t open = 0, empty = 0;
    for (std::size_t i = 0; i < loop.size (); ++i) {
      const Index p = loop[i];
      rim.length += (positions[loop[(i + 1) % loop.size ()]] - positions[p]).norm ();
      rim.spacing += spacing[p];
      open += test.hasEmptySector (p, true) ? 1 : 0;
      empty += test.hasEmptySector (p, false) ? 1 : 0;
    }
    const auto count = static_cast<double> (loop.size ());
    rim.spacing /= count;
    rim.open_share = static_cast<double> (open) / count;
    rim.empty_share = static_cast<double> (empty) / count;
    rim.points = std::move (loop);
    rims.push_back (std::move (rim));
  }
  return rims;
}

void
chooseRims (std::vector<Rim>& rims, const std::vector<std::size_t>& piece_points,
            const Options& options, double unit)
{
  std::vector<Rim*> sorted = bySize (rims, piece_points);
  switch (options.holes) {
  case HolePolicy::CLOSE_ALL:
    return;
  case HolePolicy::KEEP_LARGEST: {
    std::vector<std::uint8_t> has_one (piece_points.size (), 0);
    for (Rim* rim : sorted) {
      rim->stays = has_one[rim->piece] == 0;
      has_one[rim->piece] = 1;
    }
    return;
  }
  case HolePolicy::KEEP_COUNT:
    for (std::size_t i = 0; i < sorted.size (); ++i)
      sorted[i]->stays = i < static_cast<std::size_t> (options.kept_loops);
    return;
  case HolePolicy::BY_SIZE:
    for (Rim& rim : rims)
      rim.stays =
          (options.largest_hole > 0.0 && rim.width > options.largest_hole * rim.spacing) ||
          (options.largest_hole_length > 0.0 && rim.width > options.largest_hole_length * unit);
    return;
  case HolePolicy::AUTO:
    for (Rim& rim : rims)
      rim.stays = isBoundary (rim, piece_points);
    return;
  }
}

} // namespace floater
} // namespace pcl
