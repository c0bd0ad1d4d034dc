// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/findings.h"

#include <sstream>
#include <string_view>

namespace pcl::floater {
namespace {
// The sentence of a finding. In braces, with i the index of a number or of a place:
//   {i:one|several}  the number, and the word that fits it
//   {i?one|several}  the words that fit the number
//   {i+text}         the text, if the number is not zero
//   {ni}             the number, rounded
//   {ai}             the axis of that index: x, y, or z
//   {pi}             the point and its position
//   {at}             " at" the first place, or ", one of them at" it, by the first number
struct Sentence
{
  FindingId id;
  const char* name;
  Severity severity;
  const char* text;
};

constexpr Sentence SENTENCES[] = {
    {FindingId::COINCIDENT_POINTS, "coincident_points", Severity::NOTE,
     "{0:point coincides|points coincide} with another one, point {n1} with point {n2}"
     "{0?| among them}: one point of each place is in the mesh; coordinates may have been rounded, "
     "or a cloud may be in the file twice"},
    {FindingId::INVALID_PIXELS, "invalid_pixels", Severity::NOTE,
     "{0:point is|points are} at ({n2}, {n3}, {n4}), {n1} % of the cloud, and nothing else is "
     "near: {0?it is a pixel|they are pixels} without a return, and {0?was|were} left out"},
    {FindingId::INVALID_CELLS, "invalid_cells", Severity::NOTE,
     "{0:point has|points have} the height {n1}, {n2} away from all others: {0?it is a cell|they "
     "are cells} without data, and {0?was|were} left out"},
    {FindingId::GROSS_OUTLIERS, "gross_outliers", Severity::NOTE,
     "{0:point is|points are} over a thousand times as far away as all others, {0?|among them }"
     "point {n1}: {0?it was|they were} left out"},
    {FindingId::OUTLIERS, "outliers", Severity::NOTE,
     "{0:point lies|points lie} off any surface, {0?|among them }point {n1}: {0?it was|they were} "
     "left out"},
    {FindingId::STACKED_POINTS, "stacked_points", Severity::NOTE,
     "{0:point lies|points lie} on another one, {n1} % of the cloud, at a distance of {n2} local "
     "spacings (median; at most {n3}), {0?|among them }{p0}, such as in overlapping scans: {0?it "
     "came|they came} into the mesh after the others"},
    {FindingId::SCATTER, "scatter", Severity::NOTE,
     "{0:point lies|points lie} on no surface at any scale, such as leaves: {n1} % of the cloud, "
     "{0?|among them }{p0}. {0?It was|They were} left out; the scatter policy decides that"},
    {FindingId::NOISE, "noise", Severity::DOUBT,
     "{0:point is|points are} noisy ({n4} % of the cloud), by up to {n1} local spacings (median of "
     "all points {n2}, 90 % below {n3}): {0?it was connected by its place on the plane|they were "
     "connected by their places on the planes} of the points around; the vertices of the mesh are "
     "the points themselves"},
    {FindingId::COORDINATES_IN_FLOAT, "coordinates_in_float", Severity::DOUBT,
     "the coordinates are coarse: along {a0} they are {n1} apart, {n2} of the local spacing{3+, "
     "and {3:point coincides|points coincide} with another}. 32-bit numbers have this step so far "
     "from the origin: subtract an origin before coordinates are stored in 32 bits; the tool's "
     "--shift does that for files in text or in double precision"},
    {FindingId::COORDINATES_ROUNDED, "coordinates_rounded", Severity::DOUBT,
     "the coordinates are coarse: along {a0} they are {n1} apart, {n2} of the local spacing{3+, "
     "and {3:point coincides|points coincide} with another}. They were rounded when they were "
     "stored: store them with more digits"},
    {FindingId::DOUBTFUL_VIEWPOINT, "doubtful_viewpoint", Severity::DOUBT,
     "{n0} of {n1} points are in no triangle of the view: the sensor may not have been at the "
     "given viewpoint"},
    {FindingId::OTHER_VIEWPOINT, "other_viewpoint", Severity::DOUBT,
     "the points are spaced as seen from the place ({n0}, {n1}, {n2}), and not as seen from the "
     "given viewpoint: that may be wrong; if none is given, the place is found"},
    {FindingId::OTHER_DIRECTION, "other_direction", Severity::DOUBT,
     "the points are spaced as seen from far away in the direction ({n0}, {n1}, {n2}), and not as "
     "seen from the given viewpoint: that may be wrong; if none is given, the place is found"},
    {FindingId::STEP_IN_LOOP, "step_in_loop", Severity::DOUBT,
     "the boundary loop has a step of {n0} local spacings at {p0}: it may cut across the surface "
     "there"},
    {FindingId::ONE_SIDED, "one_sided", Severity::DOUBT,
     "the surface seems to be one-sided, like a Moebius strip: it was cut open along "
     "{0:triangle|triangles} near {p0}"},
    {FindingId::DEEP_HOLES, "deep_holes", Severity::DOUBT,
     "{0:hole stays|holes stay} open though the sampling around looks as if points were missing "
     "there, {0?of a width of|the widest of} {n1} ({n2} local spacings) around {p0}: triangles "
     "across would be a lid, or cross other sheets; the hole policy decides what is closed"},
    {FindingId::UNUSED_POINTS, "unused_points", Severity::FLAW,
     "{0:point is|points are} in no triangle, {p0}{0?: it does| among them: they do} not connect "
     "to the rest of the surface"},
    {FindingId::FOLDS, "folds", Severity::FLAW,
     "{0:edge is|edges are} folded by more than 120 degrees{at}: {1+the points are noisy, }sheets "
     "of the surface come close there, or a feature is thinly sampled"},
    {FindingId::CROSSING_TRIANGLES, "crossing_triangles", Severity::FLAW,
     "{2+more than }{0:pair of triangles crosses|pairs of triangles cross} each other{at}: "
     "{1+the points are noisy, }sheets of the surface come closer there than their points are, or "
     "a feature is thinly sampled"},
    {FindingId::SPARSE_SHAPE, "sparse_shape", Severity::DOUBT,
     "{n0} % of the edges are bent by more than 60 degrees: the points are too few for the shape, "
     "and parts that are near each other may be joined, or thin ones cut off"},
    {FindingId::LONG_EDGES, "long_edges", Severity::DOUBT,
     "{0:edge inside the surface is|edges inside the surface are} much longer than the local "
     "spacing, {0?|the longest one }of {n1} spacings from {p0} to {p1}: a hole may be bridged "
     "there"},
    {FindingId::NO_AREA, "no_area", Severity::FLAW,
     "{0:triangle has|triangles have} no area{at}: points lie on one line there in the precision "
     "of the coordinates"},
    {FindingId::SMALL_COMPONENT, "small_component", Severity::DOUBT,
     "the mesh has {n0} components, the smallest of {n1} points at {p0}: they may belong to a "
     "larger one, or be outliers"},
    {FindingId::HOLES_LEFT_OPEN, "holes_left_open", Severity::FLAW,
     "{0:hole stays|holes stay} open though all were to be closed, {0?of|the largest, of} {n1} "
     "points, around {p0}"},
    {FindingId::SMALL_HOLES, "small_holes", Severity::DOUBT,
     "{0:small hole stays|small holes stay} open, {0?of|the largest, of} {n1} points, around {p0}: "
     "the sampling may be thin there; the hole policy decides what is closed"},
    {FindingId::NO_VIEWPOINT, "no_viewpoint", Severity::DOUBT,
     "the mesh was to face the viewpoint, but none is known: the cloud has no origin of its "
     "sensor, and the points do not tell it. Other evidence decides which side is the front; give "
     "the place of the sensor, or choose another facing"},
    {FindingId::NORMALS_CONTRADICT, "normals_contradict", Severity::DOUBT,
     "the normals of the points contradict each other on {0:part|parts} of the mesh, {0?at|the "
     "largest at} {p0}: many point to either side, as if they had never been oriented. They do not "
     "decide which side is the front there; orient them, or choose another facing"},
    {FindingId::NORMALS_MISSING, "normals_missing", Severity::DOUBT,
     "no point has a normal on {0:part|parts} of the mesh, {0?at|the largest at} {p0}: normals do "
     "not decide which side is the front there; choose another facing"},
    {FindingId::CLOSED_HAS_NO_UP, "closed_has_no_up", Severity::NOTE,
     "{0:part|parts} of the mesh, {0?at|the largest at} {p0}, {0?is|are} closed: no side is up, "
     "and {0?it faces|they face} outwards"},
    {FindingId::VIEWPOINT_OUTSIDE, "viewpoint_outside", Severity::NOTE,
     "{0:part|parts} of the mesh, {0?at|the largest at} {p0}, {0?is|are} closed: the viewpoint is "
     "outside, and {0?it faces|they face} outwards"},
    {FindingId::GUESSED_OUTSIDE, "guessed_outside", Severity::DOUBT,
     "which side is the front of {0:part|parts} of the mesh is a guess, {0?at|the largest at} "
     "{p0}: no side of it is outside, and it bulges to neither; choose another facing"},
    {FindingId::GUESSED_UP, "guessed_up", Severity::DOUBT,
     "which side is the front of {0:part|parts} of the mesh is a guess, {0?at|the largest at} "
     "{p0}: as much of it faces down as up; choose another facing"},
    {FindingId::GUESSED_TOWARDS_VIEW, "guessed_towards_view", Severity::DOUBT,
     "which side is the front of {0:part|parts} of the mesh is a guess, {0?at|the largest at} "
     "{p0}: as much of it looks away from the viewpoint as towards it; choose another facing"},
    {FindingId::GUESSED_FRONT, "guessed_front", Severity::DOUBT,
     "which side is the front of {0:part|parts} of the mesh is a guess, {0?at|the largest at} "
     "{p0}: it may be a body or a sheet; the place of the sensor would tell, if it is one scan"},
};

constexpr std::size_t FINDINGS = static_cast<std::size_t> (FindingId::COUNT);

constexpr bool
areInOrder ()
{
  for (std::size_t i = 0; i < FINDINGS; ++i)
    if (static_cast<std::size_t> (SENTENCES[i].id) != i)
      return false;
  return sizeof SENTENCES / sizeof *SENTENCES == FINDINGS;
}
static_assert (areInOrder (), "each finding has a sentence, in the order of FindingId");

std::string_view
textOf (FindingId id)
{
  return SENTENCES[static_cast<std::size_t> (id)].text;
}

std::string
fill (std::string_view text, const Finding& finding);

// What stands for the braces around `key`.
std::string
valueOf (std::string_view key, const Finding& finding)
{
  const auto placeAt = [&finding] (std::size_t i) {
    const auto& [index, position] = finding.places.at (i);
    return placeText (index, {position[0], position[1], position[2]});
  };
  const bool is_one = !finding.numbers.empty () && finding.numbers[0] == 1.0;
  if (key == "at")
    return (is_one ? " at " : ", one of them at ") + placeAt (0);
  const auto digit = [&key] (std::size_t i) { return static_cast<std::size_t> (key[i] - '0'); };
  if (key[0] == 'p')
    return placeAt (digit (1));
  if (key[0] == 'n')
    return rounded (finding.numbers.at (digit (1)));
  if (key[0] == 'a')
    return {"xyz"[static_cast<std::size_t> (finding.numbers.at (digit (1)))]};
  const double number = finding.numbers.at (digit (0));
  const std::string_view rest = key.substr (2);
  if (key[1] == '+')
    return number == 0.0 ? "" : fill (rest, finding);
  const std::size_t bar = rest.find ('|');
  const std::string word (number == 1.0 ? rest.substr (0, bar) : rest.substr (bar + 1));
  return key[1] == ':' ? rounded (number) + " " + word : word;
}

std::string
fill (std::string_view text, const Finding& finding)
{
  std::string filled;
  for (std::size_t i = 0; i < text.size (); ++i) {
    if (text[i] != '{') {
      filled += text[i];
      continue;
    }
    const std::size_t begin = i + 1;
    for (int depth = 1; depth > 0;) {
      ++i;
      depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
    }
    filled += valueOf (text.substr (begin, i - begin), finding);
  }
  return filled;
}

} // namespace

std::string
counted (std::size_t count, const char* one, const char* several)
{
  return std::to_string (count) + " " + (count == 1 ? one : several);
}

std::string
placeText (std::uint32_t index, const Vector3d& at)
{
  std::ostringstream text;
  text.precision (9); // distinguishes all numbers in single precision
  text << "point " << index << " (" << at.x () << ", " << at.y () << ", " << at.z () << ")";
  return text.str ();
}

std::string
rounded (double value)
{
  constexpr double WHOLE = 1e15; // double precision holds all whole numbers up to here
  std::ostringstream text;
  text.precision (value == std::floor (value) && std::abs (value) < WHOLE ? 15 : 3);
  text << value;
  return text.str ();
}

const char*
findingName (FindingId id)
{
  const auto i = static_cast<std::size_t> (id);
  return i < FINDINGS ? SENTENCES[i].name : "unknown";
}

std::string
sentenceOf (const Finding& finding)
{
  return fill (textOf (finding.id), finding);
}

void
describeFindings (Report& report)
{
  for (Finding& finding : report.findings)
    finding.severity = SENTENCES[static_cast<std::size_t> (finding.id)].severity;
  const auto cost = [] (const Finding& finding) { // of what there are most
    const bool has_count = textOf (finding.id).find ("{0:") != std::string_view::npos;
    return std::make_pair (finding.severity, has_count ? finding.numbers.at (0) : 0.0);
  };
  std::stable_sort (report.findings.begin (), report.findings.end (),
                    [&cost] (const Finding& a, const Finding& b) { return cost (a) > cost (b); });
  for (const Finding& finding : report.findings)
    report.warnings.push_back (sentenceOf (finding));
}

} // namespace pcl::floater
