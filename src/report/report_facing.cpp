// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reports which rule decided the front of each part of the mesh, and with what confidence.
#include "report/report_mesh.h"
#include "report/report_text.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// Thresholds for the report. They do not change the mesh.
constexpr std::size_t TINY_OBJECT = 20; // a part is tiny if the mesh has this many times its
                                        // triangles
constexpr double SURE_FACING = 0.9;     // confidence; lower ones are reported
constexpr double GUESSED_FACING = 0.6;  // confidence; a warning below

// Some parts of the mesh.
struct Pieces
{
  std::size_t count = 0, triangles = 0;
  const FacingObject* largest = nullptr;

  void add (const FacingObject& object)
  {
    ++count;
    triangles += object.triangles;
    if (largest == nullptr || object.triangles > largest->triangles)
      largest = &object;
  }

  // "of 2 parts of the mesh, the largest at point 7 (...)"
  std::string text (const Points& points) const
  {
    return counted (count, "part", "parts") + " of the mesh, " +
           (count == 1 ? "at " : "the largest at ") + place (points, largest->at);
  }
};

// Why a part is a guess, by the requested rule.
const char*
whyGuessed (Facing wanted)
{
  switch (wanted) {
  case Facing::OUTWARDS:
    return "no side of it is outside, and it bulges to neither; choose another facing";
  case Facing::UP:
    return "as much of it faces down as up; choose another facing";
  case Facing::VIEWPOINT:
    return "as much of it looks away from the viewpoint as towards it; choose another facing";
  case Facing::AUTO:
  case Facing::NORMALS:
    break;
  }
  return "it may be a body or a sheet; the place of the sensor would tell, if it is one scan";
}

void
warnOfMiss (const Points& points, FacingMiss miss, const Pieces& parts, Facing wanted,
            Report& report)
{
  const std::string where = parts.text (points);
  if (miss == FacingMiss::CONTRADICTION)
    report.warnings.push_back (
        "the normals of the points contradict each other on " + where +
        ": many point to either side, as if they had never been oriented. They do not decide which "
        "side is the front there; orient them, or choose another facing");
  else if (miss == FacingMiss::NO_NORMALS)
    report.warnings.push_back ("no point has a normal on " + where +
                               ": normals do not decide which side is the front there; choose "
                               "another facing");
  else
    report.warnings.push_back (
        where + (parts.count == 1 ? ", is closed: " : ", are closed: ") +
        (wanted == Facing::UP ? "no side is up, " : "the viewpoint is outside, ") +
        (parts.count == 1 ? "and it faces outwards" : "and they face outwards"));
}

} // namespace

void
reportFacing (const Points& points, const MeshFacing& facing, Facing wanted, Report& report)
{
  std::size_t triangles = 0;
  for (const FacingObject& object : facing.objects)
    triangles += object.triangles;
  Pieces guessed;
  std::array<Pieces, static_cast<std::size_t> (FacingMiss::COUNT)> missed;
  for (const FacingObject& object : facing.objects) {
    ++report.facing_parts[static_cast<std::size_t> (object.rule)];
    report.facing_certainty = std::min (report.facing_certainty, object.certainty);
    if (object.miss != FacingMiss::NOTHING)
      missed[static_cast<std::size_t> (object.miss)].add (object);
    if (object.certainty >= SURE_FACING)
      continue;
    report.facing_decisions.push_back (
        {object.triangles, points.cloud_index[object.at], object.rule, object.certainty});
    if (object.certainty < GUESSED_FACING && TINY_OBJECT * object.triangles >= triangles)
      guessed.add (object);
  }
  std::stable_sort (
      report.facing_decisions.begin (), report.facing_decisions.end (),
      [] (const FacingDecision& a, const FacingDecision& b) { return a.certainty < b.certainty; });
  if (facing.lacks_viewpoint)
    report.warnings.emplace_back (
        "the mesh was to face the viewpoint, but none is known: the cloud has no origin of its "
        "sensor, and the points do not tell it. Other evidence decides which side is the front; "
        "give the place of the sensor, or choose another facing");
  for (std::size_t miss = 0; miss < missed.size (); ++miss)
    if (missed[miss].count > 0 && TINY_OBJECT * missed[miss].triangles >= triangles)
      warnOfMiss (points, static_cast<FacingMiss> (miss), missed[miss], wanted, report);
  if (guessed.count > 0)
    report.warnings.push_back (
        "which side is the front of " + counted (guessed.count, "part", "parts") +
        " of the mesh is a guess, " + (guessed.count == 1 ? "at " : "the largest at ") +
        place (points, guessed.largest->at) + ": " + whyGuessed (wanted));
}

} // namespace pcl::floater
