// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/facing.h"

#include "mesh/facing_objects.h"
#include "mesh/visibility.h"

namespace pcl::floater {
namespace {
// Confidence in rooms, since a box may have windows; and the share of all directions in which only one
// side of a bowl or of half a body is visible, at which either is as likely: by generated clouds.
constexpr double ROOM_CERTAINTY = 0.8, BOWL = 0.3;

// Whether a sheet with this mean normal is to be turned to face up.
bool
facesDown (const Vector3d& normal)
{
  const double longest = normal.cwiseAbs ().maxCoeff ();
  for (const int axis : {2, 1})
    if (std::abs (normal[axis]) >= FacingLimits::EQUAL_AXES * longest)
      return normal[axis] < 0.0;
  return normal.x () < 0.0;
}

// No terrain: it stands.
bool
isUpright (const Vector3d& normal)
{
  return std::abs (normal.z ()) < FacingLimits::EQUAL_AXES * normal.cwiseAbs ().maxCoeff ();
}

// Confidence in a decision with this ratio of evidence for and against it, 1 or more. A factor of two
// gives 0.9.
double
certaintyOf (double factor)
{
  const double cube = factor * factor * factor;
  return cube / (1.0 + cube);
}

// Confidence that terrain or a sheet faces up: what lies has been seen from above, what stands from
// either side, and few roofs are steeper than 45 degrees.
double
certaintyOfUp (const Vector3d& normal)
{
  const double squared_length = normal.squaredNorm ();
  const double square = squared_length > 0.0 ? normal.z () * normal.z () / squared_length : 0.0;
  return 0.5 + 0.5 * square * square;
}

// Decides the front of each object.
struct FacingJudge
{
  const TriangleMesh& mesh;
  const Positions& positions;
  const MeshComponents& found;
  const FacingObjects& objects;
  const FacingHints& hints;
  const RunContext& run;
  std::vector<FacingObject> judged = std::vector<FacingObject> (objects.sums.size ());
  Flags is_turned = Flags (judged.size (), 0); // of each object
  Flags is_body = Flags (judged.size (), 0);   // of each object: may contain others
  std::optional<TriangleRays> known_rays = {}; // made on demand
  std::vector<double> bulges = {};             // of each object, made on demand
  std::optional<double> common_bulge = {};     // made on demand

  std::vector<FacingObject> judge ()
  {
    std::vector<Index> open;
    for (Index o = 0; o < judged.size (); ++o) {
      const FacingSums& sums = objects.sums[o];
      FacingObject& object = judged[o];
      object.triangles = sums.triangles;
      object.at = sums.at;
      object.mean_normal = sums.meanNormal ();
      const bool by_side = hints.wantsASide ();
      is_body[o] = sums.is_closed ? 1 : 0;
      if (hints.normals != nullptr && sums.told == 0.0)
        object.miss = sums.contradictory > 0.0          ? FacingMiss::CONTRADICTION
                      : hints.wanted == Facing::NORMALS ? FacingMiss::NO_NORMALS
                                                        : FacingMiss::NOTHING;
      if (sums.told > 0.0)
        decide (o, FacingRule::NORMALS, sums.along < 0.0,
                0.5 + 0.5 * std::abs (sums.along) / sums.told);
      else if (hints.wanted == Facing::UP && !sums.is_closed)
        decideUp (o);
      // A closed component has one side towards the sensor only if the sensor is within it.
      else if (hints.wanted == Facing::VIEWPOINT &&
               (sums.is_closed ? std::abs (sums.seen) > FacingLimits::WITHIN_SHARE * sums.in_sight
                               : !hints.faces_sensor))
        decideBySensor (o); // NOLINT(bugprone-branch-clone): the order is that of the evidence
      else if (sums.is_closed) {
        if (hints.wanted == Facing::UP || hints.wanted == Facing::VIEWPOINT)
          object.miss = FacingMiss::CLOSED;
        decide (o, FacingRule::CLOSED, sums.volume < 0.0, 1.0);
      }
      else if (!by_side && hints.faces_sensor)
        decide (o, FacingRule::SENSOR, false, 1.0);
      else if (!by_side && hints.sensor &&
               std::abs (sums.seen) >= FacingLimits::SEEN_SHARE * sums.in_sight)
        decideBySensor (o);
      else if (!by_side && isRoom (sums)) {
        is_body[o] = 0; // furniture is no wall of a hollow
        decide (o, FacingRule::ROOM, sums.volume > 0.0, ROOM_CERTAINTY);
      }
      // The back side is visible from at least |mean normal| of all directions: all light through
      // the openings reaches it.
      else if (!by_side && object.mean_normal >= 1.0 / (1.0 + FacingLimits::BODY_RATIO))
        decideSheet (o, 1.0);
      else
        open.push_back (o);
    }
    judgeOpen (open);
    judgeNested ();
    if (hints.wanted == Facing::INWARDS)
      for (std::uint8_t& one : is_turned)
        one ^= 1U;
    return judged;
  }

  bool isTurned (Index object) const { return is_turned[object] != 0; }

  void decideBySensor (Index o)
  {
    const FacingSums& sums = objects.sums[o];
    const double share = sums.in_sight > 0.0 ? std::abs (sums.seen) / sums.in_sight : 0.0;
    decide (o, FacingRule::SENSOR, sums.seen < 0.0, 0.5 + 0.5 * share);
  }

  void decideUp (Index o)
  {
    const FacingSums& sums = objects.sums[o];
    const double up = sums.area_vector.z ();
    const bool stands = sums.from_above <= FacingLimits::FLATNESS * sums.area;
    decide (o, FacingRule::UP, stands ? facesDown (sums.area_vector) : up < 0.0,
            stands ? 0.5 : 0.5 + 0.5 * std::abs (up) / sums.from_above);
  }

  // Orients an open object outwards, even if it hardly is a body.
  void decideOutwards (Index o, double body, double chance)
  {
    if (std::abs (body) >= 2.0 * chance) { // two standard deviations: chance in one case of twenty
      decide (o, FacingRule::BODY, body < 0.0, certaintyOf ((std::abs (body) + chance) / chance));
      return;
    }
    const double bulge = bulgeOf (o);
    decide (o, FacingRule::BULGE,
            bulge == 0.0 ? facesDown (objects.sums[o].area_vector) : bulge < 0.0,
            0.5 + 0.5 * std::abs (bulge));
  }

  double bulgeOf (Index o)
  {
    if (bulges.empty ())
      bulges = bulgesOf (mesh, positions, found, objects);
    return bulges[o];
  }

  // How far all that stands bulges to the side that facesDown () makes the front. Parts of a scan
  // bulge to either side, but face the same one.
  double commonBulge ()
  {
    double sum = 0.0, area = 0.0;
    for (Index o = 0; !common_bulge && o < judged.size (); ++o)
      if (const FacingSums& sums = objects.sums[o];
          !sums.is_closed && isUpright (sums.area_vector)) {
        sum += sums.area * bulgeOf (o) * (facesDown (sums.area_vector) ? -1.0 : 1.0);
        area += sums.area;
      }
    if (!common_bulge)
      common_bulge = area > 0.0 ? sum / area : 0.0;
    return *common_bulge;
  }

  // Terrain faces up. What stands was scanned from the side to which it bulges, if it does.
  void decideSheet (Index o, double certainty)
  {
    const Vector3d& normal = objects.sums[o].area_vector;
    const bool is_down = facesDown (normal);
    const double bulge = isUpright (normal) ? commonBulge () : 0.0;
    if (std::abs (bulge) >= FacingLimits::BULGE)
      decide (o, FacingRule::BULGE, is_down != (bulge < 0.0), 0.5 + 0.5 * std::abs (bulge));
    else
      decide (o, FacingRule::SHEET, is_down, std::min (certainty, certaintyOfUp (normal)));
  }

  void decide (Index o, FacingRule rule, bool turns, double certainty)
  {
    judged[o].rule = rule;
    judged[o].certainty = certainty;
    is_turned[o] = turns ? 1 : 0;
  }

  Index objectOf (Index triangle) const
  {
    return objects.of_component[found.of_triangle[triangle]];
  }

  // Lines of sight through some objects, towards their fronts.
  std::vector<SightLine> linesThrough (const std::vector<Index>& some) const
  {
    std::vector<std::optional<SightLineSampler>> samplers (judged.size ());
    for (const Index o : some)
      samplers[o].emplace (objects.sums[o].area, objects.sums[o].triangles);
    std::vector<SightLine> lines;
    for (Index t = 0; t < mesh.triangles.size (); ++t) {
      const Index component = found.of_triangle[t];
      std::optional<SightLineSampler>& sampler = samplers[objects.of_component[component]];
      if (!sampler)
        continue;
      const Vector3d normal = areaVectorOf (mesh.triangles[t], positions);
      const double area = normal.norm ();
      if (area > 0.0)
        sampler->add (t, area, middleOf (mesh.triangles[t], positions),
                      objects.sign (component) / area * normal, lines);
    }
    return lines;
  }

  const TriangleRays& rays ()
  {
    if (!known_rays)
      known_rays.emplace (mesh.triangles, positions, run);
    return *known_rays;
  }

  // Number of free lines of each object on either side.
  struct Free
  {
    std::size_t lines = 0, front = 0, back = 0;
  };
  // \param blocks (own, other): whether another object, or the same, blocks the lines of an object
  template <typename Blocks>
  std::vector<Free> lookFrom (const std::vector<Index>& some, Blocks&& blocks)
  {
    const std::vector<SightLine> lines = linesThrough (some);
    const auto isFree = [&, &all = rays ()] (const SightLine& line, const Vector3d& direction) {
      return !all.forHits (line.middle, direction, [&, own = objectOf (line.triangle)] (Index t) {
        return t != line.triangle && blocks (own, objectOf (t));
      });
    };
    constexpr std::size_t PER_TASK = 32;
    std::vector<std::array<bool, 2>> are_free (lines.size ()); // towards the front, and the back
    parallelTasks (run, (lines.size () + PER_TASK - 1) / PER_TASK, [&] (std::size_t task) {
      for (std::size_t i = task * PER_TASK; i < std::min (lines.size (), (task + 1) * PER_TASK);
           ++i)
        are_free[i] = {isFree (lines[i], lines[i].direction),
                       isFree (lines[i], -lines[i].direction)};
    });
    std::vector<Free> free (judged.size ());
    for (std::size_t i = 0; i < lines.size (); ++i) {
      Free& of_object = free[objectOf (lines[i].triangle)];
      ++of_object.lines;
      of_object.front += are_free[i][0] ? 1 : 0;
      of_object.back += are_free[i][1] ? 1 : 0;
    }
    return free;
  }

  // Judges each object by itself: only itself blocks its lines.
  void judgeOpen (const std::vector<Index>& open)
  {
    if (open.empty ())
      return;
    const std::vector<Free> free =
        lookFrom (open, [] (Index own, Index other) { return own == other; });
    for (const Index o : open) {
      FacingObject& object = judged[o];
      const double lines = static_cast<double> (std::max<std::size_t> (free[o].lines, 1));
      object.front = static_cast<double> (free[o].front) / lines;
      object.back = static_cast<double> (free[o].back) / lines;
      const double body = object.front - object.back;
      const double sheet = FacingLimits::BODY_RATIO * object.mean_normal;
      is_body[o] = std::abs (body) >= sheet ? 1 : 0;
      const bool is_inwards = body < 0.0, is_down = facesDown (objects.sums[o].area_vector);
      const double chance = 0.5 / std::sqrt (lines); // about the standard deviation of a share
      if (hints.wantsASide ()) {
        decideOutwards (o, body, chance);
        continue;
      }
      // What the sensor saw of half a body may as well be the inside of a bowl.
      const double outside = certaintyOf ((std::abs (body) + chance) / (BOWL + chance));
      const double up = certaintyOfUp (objects.sums[o].area_vector);
      const double either = certaintyOf ((std::max (std::abs (body), sheet) + chance) /
                                         (std::min (std::abs (body), sheet) + chance));
      if (is_body[o] == 0)
        decideSheet (o, is_inwards == is_down ? 1.0 : either);
      else
        decide (o, FacingRule::BODY, is_inwards,
                is_inwards == is_down ? std::max (outside, up) : std::min (outside, either));
    }
  }

  // Whether one object may lie within another.
  bool mayLieIn (Index o, Index other) const
  {
    const FacingSums &inner = objects.sums[o], &outer = objects.sums[other];
    Eigen::AlignedBox3d box = outer.box;
    const Vector3d margin = FacingLimits::NESTING_MARGIN * box.sizes ();
    box.min () -= margin;
    box.max () += margin;
    return inner.area < outer.area && box.contains (inner.box);
  }

  // Judges bodies that may lie within other bodies. A nested one is the wall of a hollow, unless
  // its front is visible from outside and its back is hardly: then it is a separate body, visible
  // through windows of the other one. Through windows, the back of a wall is visible, and its front
  // only at their edges.
  void judgeNested ()
  {
    std::vector<Index> bodies, inner;
    for (Index o = 0; o < judged.size (); ++o)
      if (is_body[o] != 0)
        bodies.push_back (o);
    std::vector<std::vector<Index>> around (judged.size ());
    for (const Index o : bodies) {
      if (judged[o].rule != FacingRule::CLOSED && judged[o].rule != FacingRule::BODY)
        continue; // the rules for bodies have not decided
      for (const Index other : bodies)
        if (other != o && mayLieIn (o, other))
          around[o].push_back (other);
      if (countAround (o, around[o]) % 2 == 1)
        inner.push_back (o);
    }
    if (inner.empty ())
      return;
    const std::vector<Free> free = lookFrom (inner, [] (Index, Index) { return true; });
    for (const Index o : inner) {
      const std::size_t outside = isTurned (o) ? free[o].back : free[o].front;
      const std::size_t inside = isTurned (o) ? free[o].front : free[o].back;
      const bool is_own =
          objects.sums[o].is_closed
              ? outside > 0
              : outside > FacingLimits::OWN_BODY_RATIO * (inside + FacingLimits::CHANCE_LINES);
      if (!is_own)
        decide (o, FacingRule::HOLLOW, !isTurned (o), 1.0);
    }
  }

  // Number of these objects that contain an object: rays from it cross their surfaces an odd number
  // of times. By majority, since objects may have windows.
  std::size_t countAround (Index o, const std::vector<Index>& around)
  {
    if (around.empty ())
      return 0;
    std::vector<SightLine> lines = linesThrough ({o});
    lines.resize (std::min (lines.size (), FacingLimits::NESTING_LINES));
    std::size_t count = 0;
    for (const Index other : around) {
      std::size_t odd = 0;
      for (const SightLine& line : lines) {
        std::size_t crossed = 0;
        rays ().forHits (line.middle, line.direction, [&] (Index t) {
          crossed += objectOf (t) == other ? 1 : 0;
          return false;
        });
        odd += crossed % 2;
      }
      count += 2 * odd > lines.size () ? 1 : 0;
    }
    return count;
  }
};

} // namespace

MeshFacing
faceOutwards (TriangleMesh& mesh, const Positions& positions, const FacingHints& hints,
              const RunContext& run)
{
  MeshFacing facing;
  FacingHints usable = hints;
  facing.lacks_viewpoint =
      hints.wanted == Facing::VIEWPOINT && !hints.sensor && !hints.faces_sensor;
  if (facing.lacks_viewpoint)
    usable.wanted = Facing::AUTO;
  const MeshComponents found = findComponents (mesh, run);
  const FacingObjects objects = findObjects (mesh, positions, found, usable, run);
  FacingJudge judge{mesh, positions, found, objects, usable, run};
  facing.objects = judge.judge ();
  Flags is_turned;
  for (Index c = 0; c < found.count; ++c)
    is_turned.push_back (
        judge.isTurned (objects.of_component[c]) != (objects.is_opposite[c] != 0) ? 1 : 0);
  facing.turned = static_cast<std::size_t> (std::count (is_turned.begin (), is_turned.end (), 1));
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (is_turned[found.of_triangle[t]] != 0) {
      std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
      std::swap (mesh.neighbors[t][1], mesh.neighbors[t][2]);
    }
  return facing;
}

} // namespace pcl::floater
