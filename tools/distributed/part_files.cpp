// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "part_files.h"

#include "stored_cloud.h"

#include <algorithm>
#include <functional>

namespace pcl::floater {
namespace {
// Adds what a function such as forRim visits to a file.
auto
writingTo (ArrayWriter& writer)
{
  return [&writer] (const char* name, const auto& values) {
    if constexpr (std::is_same_v<std::decay_t<decltype (values)>, CsrLists>)
      writeLists (name, values, writer);
    else
      writer.add (name, values);
  };
}

// Reads it from there.
auto
readingFrom (ArrayFile& file, std::size_t all_points)
{
  return [&file, all_points] (const char* name, auto& values) {
    if constexpr (std::is_same_v<std::decay_t<decltype (values)>, CsrLists>)
      values =
          readLists (file, name, 0, file.count<Index> (std::string (name) + ".ends"), all_points);
    else
      file.append (name, values);
  };
}

// Checks what a rim and a zone have of their points, which are in a part.
template <typename Of>
void
requirePoints (const ArrayFile& file, const Of& of, const PartOfPoints& part)
{
  const std::size_t size = of.points.size ();
  file.require (std::is_sorted (of.points.begin (), of.points.end (), std::less_equal<> ()) &&
                (size == 0 || (of.points.front () >= part.first && of.points.back () < part.last)));
  file.require (of.positions.size () == size && of.normals.size () == size &&
                of.spacing.size () == size && of.is_partial.size () == size &&
                of.neighbors.rows () == size);
  file.requireBelow (of.triangles, size);
}

// Calls visit (name, array) for all arrays of a rim, in the order of the file, and visitOpen () in
// the place of the triangles that are open.
template <typename Of, typename Visit, typename VisitOpen>
void
forRim (Of& rim, const Visit& visit, const VisitOpen& visitOpen)
{
  visit ("points", rim.points);
  visit ("positions", rim.positions);
  visit ("normals", rim.normals);
  visit ("smoothed", rim.smoothed);
  visit ("spacing", rim.spacing);
  visit ("is_partial", rim.is_partial);
  visit ("has_room", rim.has_room);
  visit ("neighbors", rim.neighbors);
  visit ("rim", rim.triangles);
  visit ("numbers", rim.numbers);
  visit ("component", rim.component);
  visitOpen ();
  visit ("others", rim.others);
  visit ("other_positions", rim.other_positions);
  visit ("other_normals", rim.other_normals);
}

template <typename Of, typename Visit>
void
forZone (Of& zone, const Visit& visit)
{
  visit ("points", zone.points);
  visit ("positions", zone.positions);
  visit ("normals", zone.normals);
  visit ("spacing", zone.spacing);
  visit ("is_partial", zone.is_partial);
  visit ("neighbors", zone.neighbors);
  visit ("zone", zone.triangles);
}

// Calls with (member) for all of them that are counts, in the order in which they are written.
template <typename Of, typename Visit>
void
forCounts (Of& around, Visit&& visit)
{
  for (auto* const count : {&around.edges, &around.nonmanifold_vertices, &around.nonmanifold_edges,
                            &around.orientation_conflicts, &around.degenerate_triangles,
                            &around.folds, &around.long_edges})
    visit (*count);
}

template <typename Of, typename Visit>
void
forPlaces (Of& around, Visit&& visit)
{
  for (auto* const place : {&around.broken_at, &around.degenerate_at, &around.fold_at,
                            &around.longest_at.first, &around.longest_at.second,
                            &around.longest_inside_at.first, &around.longest_inside_at.second})
    visit (*place);
}

// The same of the numbers of a component.
template <typename Of, typename Visit>
void
forNumbers (Of& component, Visit&& visit)
{
  auto& sum = component.sum.sum;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    visit (sum.area_vector[axis]);
    visit (component.sum.origin[axis]);
    visit (sum.box.min ()[axis]);
    visit (sum.box.max ()[axis]);
  }
  for (auto* const number : {&sum.area, &sum.volume, &sum.seen, &sum.in_sight, &sum.from_above,
                             &sum.along, &sum.told, &sum.contradictory})
    visit (*number);
}

template <typename Of, typename Visit>
void
forComponentCounts (Of& component, Visit&& visit)
{
  visit (component.points);
  visit (component.sum.sum.triangles);
  visit (component.sum.sum.at);
}

template <typename Of, typename Visit>
void
forCrossingCounts (Of& crossing, Visit&& visit)
{
  for (auto* const count :
       {&crossing.found, &crossing.left, &crossing.untested, &crossing.done.flips,
        &crossing.done.moves, &crossing.done.rebuilds, &crossing.done.pairs_left})
    visit (*count);
  visit (crossing.first_at);
}

// Numbers of one type that a function such as forCounts visits: as an array to write, or taken from
// one.
template <typename T>
struct Taken
{
  const ArrayFile& file;
  std::vector<T> values;
  std::size_t next = 0;

  template <typename Value>
  void operator() (Value& value)
  {
    file.require (next < values.size ());
    value = static_cast<Value> (values[next++]);
  }
};

template <typename T>
auto
pushingTo (std::vector<T>& values)
{
  return [&values] (auto value) { values.push_back (value); };
}

void
addCheck (const InnerCheck& check, ArrayWriter& writer)
{
  std::vector<std::uint64_t> counts, component_counts, crossing;
  std::vector<Index> places;
  std::vector<double> numbers;
  forCounts (check.around, pushingTo (counts));
  forPlaces (check.around, pushingTo (places));
  writer.keep ("around.counts", std::move (counts));
  writer.keep ("around.places", std::move (places));
  writer.keep ("around.longest",
               std::vector<double>{check.around.sqr_longest, check.around.sqr_longest_inside});
  writer.add ("rim", check.rim);
  writer.add ("rim.component", check.rim_component);
  writer.add ("box", &check.box, 1);
  for (const InnerComponent& component : check.components) {
    forNumbers (component, pushingTo (numbers));
    forComponentCounts (component, pushingTo (component_counts));
  }
  writer.keep ("components.numbers", std::move (numbers));
  writer.keep ("components.counts", std::move (component_counts));
  forCrossingCounts (check.crossing, pushingTo (crossing));
  writer.keep ("crossing.counts", std::move (crossing));
  writer.add ("crossing.places", check.crossing.places);
}

InnerCheck
readCheck (ArrayFile& file, std::size_t all_points)
{
  const auto requirePoint = [&] (Index p) { file.require (p == NONE || p < all_points); };
  InnerCheck check;
  check.triangles = file.count<Triangle> ("triangles");
  forCounts (check.around, Taken<std::uint64_t>{file, file.read<std::uint64_t> ("around.counts")});
  forPlaces (check.around, Taken<Index>{file, file.read<Index> ("around.places")});
  forPlaces (check.around, requirePoint);
  const std::vector<double> longest = file.read<double> ("around.longest", 0, 2);
  check.around.sqr_longest = longest[0];
  check.around.sqr_longest_inside = longest[1];
  check.rim = file.read<Index> ("rim");
  check.rim_component = file.read<Index> ("rim.component");
  file.read ("box", 0, 1, &check.box);
  Taken<double> numbers{file, file.read<double> ("components.numbers")};
  Taken<std::uint64_t> counts{file, file.read<std::uint64_t> ("components.counts")};
  while (counts.next < counts.values.size ()) {
    InnerComponent& component = check.components.emplace_back ();
    forNumbers (component, numbers);
    forComponentCounts (component, counts);
    requirePoint (component.sum.sum.at);
  }
  file.require (std::is_sorted (check.rim.begin (), check.rim.end ()) &&
                check.rim_component.size () == check.rim.size ());
  file.requireBelow (check.rim, check.triangles);
  file.requireBelow (check.rim_component, check.components.size ());
  forCrossingCounts (check.crossing,
                     Taken<std::uint64_t>{file, file.read<std::uint64_t> ("crossing.counts")});
  requirePoint (check.crossing.first_at);
  file.append ("crossing.places", check.crossing.places);
  file.requireBelow (check.crossing.places, all_points);
  return check;
}

} // namespace

void
addRim (const PartRim& rim, ArrayWriter& writer)
{
  forRim (rim, writingTo (writer), [&] {
    writer.add ("components", &rim.components, 1);
    std::vector<Triangle> corners;
    std::vector<std::uint8_t> votes;
    std::vector<float> ratios;
    for (const Candidate& candidate : rim.open) {
      corners.push_back (candidate.corners);
      votes.push_back (candidate.votes);
      ratios.push_back (candidate.circumradius_ratio);
    }
    writer.keep ("open.corners", std::move (corners));
    writer.keep ("open.votes", std::move (votes));
    writer.keep ("open.ratios", std::move (ratios));
  });
}

PartRim
readRim (ArrayFile& file, const PartOfPoints& part)
{
  PartRim rim;
  forRim (rim, readingFrom (file, part.all), [&] {
    file.read ("components", 0, 1, &rim.components);
    const std::vector<Triangle> corners = file.read<Triangle> ("open.corners");
    file.requireBelow (corners, part.all);
    const std::vector<std::uint8_t> votes =
        file.read<std::uint8_t> ("open.votes", 0, corners.size ());
    const std::vector<float> ratios = file.read<float> ("open.ratios", 0, corners.size ());
    for (std::size_t i = 0; i < corners.size (); ++i)
      rim.open.push_back ({corners[i], votes[i], 0, ratios[i], 0.0F});
  });
  requirePoints (file, rim, part);
  file.require (
      rim.smoothed.size () == rim.points.size () && rim.has_room.size () == rim.points.size () &&
      rim.numbers.size () == rim.triangles.size () &&
      rim.component.size () == rim.triangles.size () && rim.components <= part.last - part.first &&
      rim.other_positions.size () == rim.others.size () &&
      rim.other_normals.size () == rim.others.size ());
  file.requireBelow (rim.numbers, file.count<Triangle> ("triangles"));
  file.requireBelow (rim.component, rim.components);
  file.requireBelow (rim.others, part.all);
  return rim;
}

void
addFinished (const FinishedPart& part, ArrayWriter& writer)
{
  writer.add ("triangles", part.triangles);
  forZone (part.zone, writingTo (writer));
  writer.keep ("counts", std::vector<Index>{static_cast<Index> (part.flips),
                                            static_cast<Index> (part.folds_after_flips),
                                            static_cast<Index> (part.folds)});
  writer.add ("corners", part.corners);
  writer.add ("buckets", part.buckets);
  addCheck (part.check, writer);
}

FinishedPart
readFinished (ArrayFile& file, const PartOfPoints& of)
{
  FinishedPart part;
  forZone (part.zone, readingFrom (file, of.all));
  requirePoints (file, part.zone, of);
  const std::vector<Index> counts = file.read<Index> ("counts", 0, 3);
  part.flips = counts[0];
  part.folds_after_flips = counts[1];
  part.folds = counts[2];
  part.corners = file.read<double> ("corners");
  part.check = readCheck (file, of.all);
  return part;
}

void
addMarks (const std::string& name, const std::vector<std::vector<std::uint8_t>>& lists,
          ArrayWriter& writer)
{
  std::vector<std::uint64_t> ends;
  std::vector<std::uint8_t> all;
  for (const std::vector<std::uint8_t>& list : lists) {
    all.insert (all.end (), list.begin (), list.end ());
    ends.push_back (all.size ());
  }
  writer.keep (name, std::move (all));
  writer.keep (name + ".ends", std::move (ends));
}

std::vector<std::vector<std::uint8_t>>
readMarks (ArrayFile& file, const std::string& name)
{
  std::vector<std::vector<std::uint8_t>> lists;
  std::uint64_t first = 0;
  for (const std::uint64_t last : file.read<std::uint64_t> (name + ".ends")) {
    lists.push_back (file.read<std::uint8_t> (name, first, last));
    first = last;
  }
  return lists;
}

void
addChanges (const std::vector<PartChange>& changes, ArrayWriter& writer)
{
  const auto add = [&] (const std::string& name, auto member) {
    std::vector<Index> ends;
    std::decay_t<decltype (changes.front ().*member)> all;
    for (const PartChange& change : changes) {
      const auto& list = change.*member;
      all.insert (all.end (), list.begin (), list.end ());
      ends.push_back (static_cast<Index> (all.size ()));
    }
    writer.keep (name + ".ends", std::move (ends));
    writer.keep (name, std::move (all));
  };
  add ("dropped", &PartChange::dropped);
  add ("turned", &PartChange::turned);
  add ("beside", &PartChange::beside);
  add ("added", &PartChange::added);
  add ("seam", &PartChange::seam);
}

PartChange
readChange (ArrayFile& file, std::size_t part, const PartOfPoints& of)
{
  PartChange change;
  // Its range in an array of all parts, one behind the other.
  const auto read = [&] (const std::string& name, auto& values) {
    const std::string ends = name + ".ends";
    const Index first = part == 0 ? 0 : file.read<Index> (ends, part - 1, part).front ();
    file.append (name, first, file.read<Index> (ends, part, part + 1).front (), values);
  };
  read ("dropped", change.dropped);
  read ("turned", change.turned);
  read ("added", change.added);
  read ("seam", change.seam);
  read ("beside", change.beside);
  for (const Triangle& added : change.added)
    file.require (*std::min_element (added.begin (), added.end ()) >= of.first);
  file.requireBelow (change.added, of.last);
  file.requireBelow (change.seam, of.all);
  file.requireBelow (change.beside, of.all);
  return change;
}

void
addCandidates (const CandidateLists& candidates, ArrayWriter& writer)
{
  std::vector<Triangle> sure_corners, doubtful_corners;
  std::vector<std::uint8_t> sure_marks, doubtful_marks;
  std::vector<float> doubtful_values;
  for (const SureTriangle& sure : candidates.sure) {
    sure_corners.push_back (sure.corners);
    sure_marks.insert (sure_marks.end (), {sure.clockwise, sure.rank});
  }
  for (const Candidate& doubtful : candidates.doubtful) {
    doubtful_corners.push_back (doubtful.corners);
    doubtful_marks.insert (doubtful_marks.end (), {doubtful.votes, doubtful.clockwise});
    doubtful_values.insert (doubtful_values.end (),
                            {doubtful.circumradius_ratio, doubtful.normal_agreement});
  }
  writer.keep ("sure.corners", std::move (sure_corners));
  writer.keep ("sure.marks", std::move (sure_marks));
  writer.keep ("doubtful.corners", std::move (doubtful_corners));
  writer.keep ("doubtful.marks", std::move (doubtful_marks));
  writer.keep ("doubtful.values", std::move (doubtful_values));
}

void
appendCandidates (ArrayFile& file, Index first, Index last, std::size_t limit, CandidateLists& all)
{
  std::vector<Triangle> corners;
  const auto placeOf = [&corners] (Index p) {
    return static_cast<std::size_t> (
        std::partition_point (corners.begin (), corners.end (),
                              [p] (const Triangle& t) { return t[0] < p; }) -
        corners.begin ());
  };
  corners = file.read<Triangle> ("sure.corners");
  std::vector<std::uint8_t> marks = file.read<std::uint8_t> ("sure.marks", 0, 2 * corners.size ());
  file.requireBelow (corners, limit);
  for (std::size_t t = placeOf (first), end = placeOf (last); t < end; ++t)
    all.sure.push_back ({corners[t], marks[2 * t], marks[2 * t + 1], false});
  corners = file.read<Triangle> ("doubtful.corners");
  marks = file.read<std::uint8_t> ("doubtful.marks", 0, 2 * corners.size ());
  const std::vector<float> values = file.read<float> ("doubtful.values", 0, 2 * corners.size ());
  file.requireBelow (corners, limit);
  for (std::size_t t = placeOf (first), end = placeOf (last); t < end; ++t)
    all.doubtful.push_back (
        {corners[t], marks[2 * t], marks[2 * t + 1], values[2 * t], values[2 * t + 1]});
}

} // namespace pcl::floater
