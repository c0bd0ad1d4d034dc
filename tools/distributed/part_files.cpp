// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "part_files.h"

#include "stored_cloud.h"

namespace pcl::floater {
namespace {
static_assert (sizeof (Triangle) == 3 * sizeof (Index),
               "they are written and read as plain numbers");

// The range of a part in an array of all parts, one behind the other.
std::pair<std::size_t, std::size_t>
rangeOf (ArrayFile& file, const std::string& name, std::size_t part)
{
  const std::string ends = name + ".ends";
  const Index first = part == 0 ? 0 : file.read<Index> (ends, part - 1, part).front ();
  return {first, file.read<Index> (ends, part, part + 1).front ()};
}

static_assert (sizeof (std::pair<Index, Index>) == 2 * sizeof (Index),
               "they are written and read as plain numbers");

void
addPairs (const std::string& name, const std::vector<std::pair<Index, Index>>& pairs,
          ArrayWriter& writer)
{
  writer.add (name, reinterpret_cast<const Index*> (pairs.data ()), 2 * pairs.size ());
}

std::vector<std::pair<Index, Index>>
readPairs (ArrayFile& file, const std::string& name)
{
  std::vector<std::pair<Index, Index>> pairs (file.count (name) / 2);
  file.read (name, 0, 2 * pairs.size (), reinterpret_cast<Index*> (pairs.data ()));
  return pairs;
}

// Calls with (member) for all of them that are counts, in the order in which they are written.
template <typename Of, typename Visit>
void
forCounts (Of& around, Visit&& visit)
{
  visit (around.edges);
  visit (around.nonmanifold_vertices);
  visit (around.nonmanifold_edges);
  visit (around.orientation_conflicts);
  visit (around.degenerate_triangles);
  visit (around.folds);
  visit (around.long_edges);
}

template <typename Of, typename Visit>
void
forPlaces (Of& around, Visit&& visit)
{
  visit (around.broken_at);
  visit (around.degenerate_at);
  visit (around.fold_at);
  visit (around.longest_at.first);
  visit (around.longest_at.second);
  visit (around.longest_inside_at.first);
  visit (around.longest_inside_at.second);
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
forCrossingCounts (Of& crossing, Visit&& visit)
{
  visit (crossing.found);
  visit (crossing.left);
  visit (crossing.done.flips);
  visit (crossing.done.moves);
  visit (crossing.done.rebuilds);
  visit (crossing.done.pairs_left);
}

Surroundings
readSurroundings (ArrayFile& file)
{
  Surroundings around;
  const std::vector<std::uint64_t> counts = file.read<std::uint64_t> ("around.counts");
  const std::vector<Index> places = file.read<Index> ("around.places");
  auto count = counts.begin ();
  forCounts (around, [&] (std::size_t& value) { value = *count++; });
  auto place = places.begin ();
  forPlaces (around, [&] (Index& value) { value = *place++; });
  const std::vector<double> longest = file.read<double> ("around.longest");
  around.sqr_longest = longest[0];
  around.sqr_longest_inside = longest[1];
  return around;
}

InnerCheck
readCheck (ArrayFile& file)
{
  InnerCheck check;
  check.triangles = file.count ("triangles") / 3;
  check.around = readSurroundings (file);
  check.rim = file.read<Index> ("rim");
  check.rim_component = file.read<Index> ("rim.component");
  check.box = readBoxes (file, "box", 0, 1).front ();
  const std::vector<double> numbers = file.read<double> ("components.numbers");
  const std::vector<std::uint64_t> counts = file.read<std::uint64_t> ("components.counts");
  auto number = numbers.begin ();
  for (auto count = counts.begin (); count != counts.end ();) {
    InnerComponent& component = check.components.emplace_back ();
    forNumbers (component, [&] (double& value) { value = *number++; });
    component.points = *count++;
    component.sum.sum.triangles = *count++;
    component.sum.sum.at = static_cast<Index> (*count++);
  }
  const std::vector<std::uint64_t> crossing = file.read<std::uint64_t> ("crossing.counts");
  auto count = crossing.begin ();
  forCrossingCounts (check.crossing, [&] (std::size_t& value) { value = *count++; });
  check.crossing.first_at = static_cast<Index> (*count);
  check.crossing.places = readPairs (file, "crossing.places");
  return check;
}

} // namespace

template <>
std::vector<Index>&
PartWriter::keep ()
{
  return indices_.emplace_back ();
}

template <>
std::vector<std::uint64_t>&
PartWriter::keep ()
{
  return counts_.emplace_back ();
}

template <>
std::vector<double>&
PartWriter::keep ()
{
  return numbers_.emplace_back ();
}

template <>
std::vector<std::uint8_t>&
PartWriter::keep ()
{
  return marks_.emplace_back ();
}

template <>
std::vector<Triangle>&
PartWriter::keep ()
{
  return triangles_.emplace_back ();
}

void
PartWriter::addTriangles (const std::string& name, const std::vector<Triangle>& triangles)
{
  arrays_.add (name, reinterpret_cast<const Index*> (triangles.data ()), 3 * triangles.size ());
}

void
PartWriter::addRim (const PartRim& rim)
{
  arrays_.add ("points", rim.points);
  addVectors ("positions", rim.positions, arrays_);
  addVectors ("normals", rim.normals, arrays_);
  addVectors ("smoothed", rim.smoothed, arrays_);
  arrays_.add ("spacing", rim.spacing);
  arrays_.add ("is_partial", rim.is_partial);
  arrays_.add ("has_room", rim.has_room);
  writeLists ("neighbors", rim.neighbors, arrays_);
  addTriangles ("rim", rim.triangles);
  arrays_.add ("numbers", rim.numbers);
  arrays_.add ("component", rim.component);
  auto& components = keep<Index> ();
  components.push_back (rim.components);
  arrays_.add ("components", components);
  auto& corners = keep<Triangle> ();
  auto& votes = keep<std::uint8_t> ();
  for (const Candidate& candidate : rim.open) {
    corners.push_back (candidate.corners);
    votes.push_back (candidate.votes);
    ratios_.push_back (candidate.circumradius_ratio);
  }
  addTriangles ("open.corners", corners);
  arrays_.add ("open.votes", votes);
  arrays_.add ("open.ratios", ratios_);
  arrays_.add ("others", rim.others);
  addVectors ("other_positions", rim.other_positions, arrays_);
  addVectors ("other_normals", rim.other_normals, arrays_);
}

void
PartWriter::addFinished (const FinishedPart& part)
{
  const SeamZone& zone = part.zone;
  addTriangles ("triangles", part.triangles);
  arrays_.add ("points", zone.points);
  addVectors ("positions", zone.positions, arrays_);
  addVectors ("normals", zone.normals, arrays_);
  arrays_.add ("spacing", zone.spacing);
  arrays_.add ("is_partial", zone.is_partial);
  writeLists ("neighbors", zone.neighbors, arrays_);
  addTriangles ("zone", zone.triangles);
  auto& counts = keep<Index> ();
  counts = {static_cast<Index> (part.flips), static_cast<Index> (part.folds_after_flips),
            static_cast<Index> (part.folds)};
  arrays_.add ("counts", counts);
  arrays_.add ("corners", part.corners);
  addBoxes ("buckets", part.buckets, arrays_);
  addCheck (part.check);
}

void
PartWriter::addCheck (const InnerCheck& check)
{
  addSurroundings (check.around);
  arrays_.add ("rim", check.rim);
  arrays_.add ("rim.component", check.rim_component);
  arrays_.add ("box", reinterpret_cast<const double*> (&check.box), BOX);
  auto& numbers = keep<double> ();
  auto& counts = keep<std::uint64_t> ();
  for (const InnerComponent& component : check.components) {
    forNumbers (component, [&numbers] (double value) { numbers.push_back (value); });
    counts.insert (counts.end (), {component.points, component.sum.sum.triangles,
                                   std::uint64_t{component.sum.sum.at}});
  }
  arrays_.add ("components.numbers", numbers);
  arrays_.add ("components.counts", counts);
  auto& crossing = keep<std::uint64_t> ();
  forCrossingCounts (check.crossing,
                     [&crossing] (std::size_t count) { crossing.push_back (count); });
  crossing.push_back (check.crossing.first_at);
  arrays_.add ("crossing.counts", crossing);
  addPairs ("crossing.places", check.crossing.places, arrays_);
}

void
PartWriter::addSurroundings (const Surroundings& around)
{
  auto& counts = keep<std::uint64_t> ();
  auto& places = keep<Index> ();
  auto& longest = keep<double> ();
  forCounts (around, [&counts] (std::size_t count) { counts.push_back (count); });
  forPlaces (around, [&places] (Index place) { places.push_back (place); });
  longest = {around.sqr_longest, around.sqr_longest_inside};
  arrays_.add ("around.counts", counts);
  arrays_.add ("around.places", places);
  arrays_.add ("around.longest", longest);
}

void
PartWriter::addMarks (const std::string& name, const std::vector<std::vector<std::uint8_t>>& lists)
{
  auto& ends = keep<std::uint64_t> ();
  auto& all = keep<std::uint8_t> ();
  for (const std::vector<std::uint8_t>& list : lists) {
    all.insert (all.end (), list.begin (), list.end ());
    ends.push_back (all.size ());
  }
  arrays_.add (name, all);
  arrays_.add (name + ".ends", ends);
}

void
PartWriter::addChanges (const std::vector<PartChange>& changes)
{
  const auto add = [&] (const std::string& name, auto member, auto& all) {
    auto& ends = keep<Index> ();
    for (const PartChange& change : changes) {
      const auto& list = change.*member;
      all.insert (all.end (), list.begin (), list.end ());
      ends.push_back (static_cast<Index> (all.size ()));
    }
    arrays_.add (name + ".ends", ends);
  };
  for (const auto& [name, member] :
       {std::pair ("dropped", &PartChange::dropped), std::pair ("turned", &PartChange::turned),
        std::pair ("beside", &PartChange::beside)}) {
    auto& all = keep<Index> ();
    add (name, member, all);
    arrays_.add (name, all);
  }
  for (const auto& [name, member] :
       {std::pair ("added", &PartChange::added), std::pair ("seam", &PartChange::seam)}) {
    auto& all = keep<Triangle> ();
    add (name, member, all);
    addTriangles (name, all);
  }
}

std::vector<Triangle>
readTriangles (ArrayFile& file, const std::string& name, std::size_t first, std::size_t last)
{
  std::vector<Triangle> triangles (last - first);
  file.read (name, 3 * first, 3 * last, reinterpret_cast<Index*> (triangles.data ()));
  return triangles;
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

std::vector<Triangle>
readTriangles (ArrayFile& file, const std::string& name)
{
  return readTriangles (file, name, 0, file.count (name) / 3);
}

PartRim
readRim (ArrayFile& file)
{
  PartRim rim;
  rim.points = file.read<Index> ("points");
  rim.positions = readVectors<Eigen::Vector3d> (file, "positions");
  rim.normals = readVectors<Eigen::Vector3f> (file, "normals");
  rim.smoothed = readVectors<Eigen::Vector3f> (file, "smoothed");
  rim.spacing = file.read<float> ("spacing");
  rim.is_partial = file.read<std::uint8_t> ("is_partial");
  rim.has_room = file.read<std::uint8_t> ("has_room");
  rim.neighbors = readLists (file, "neighbors", 0, rim.points.size ());
  rim.triangles = readTriangles (file, "rim");
  rim.numbers = file.read<Index> ("numbers");
  rim.component = file.read<Index> ("component");
  rim.components = file.read<Index> ("components").front ();
  const std::vector<Triangle> corners = readTriangles (file, "open.corners");
  const std::vector<std::uint8_t> votes = file.read<std::uint8_t> ("open.votes");
  const std::vector<float> ratios = file.read<float> ("open.ratios");
  for (std::size_t i = 0; i < corners.size (); ++i)
    rim.open.push_back ({corners[i], votes[i], 0, ratios[i], 0.0F});
  rim.others = file.read<Index> ("others");
  rim.other_positions = readVectors<Eigen::Vector3d> (file, "other_positions");
  rim.other_normals = readVectors<Eigen::Vector3f> (file, "other_normals");
  return rim;
}

FinishedPart
readFinished (ArrayFile& file)
{
  FinishedPart part;
  SeamZone& zone = part.zone;
  zone.points = file.read<Index> ("points");
  zone.positions = readVectors<Eigen::Vector3d> (file, "positions");
  zone.normals = readVectors<Eigen::Vector3f> (file, "normals");
  zone.spacing = file.read<float> ("spacing");
  zone.is_partial = file.read<std::uint8_t> ("is_partial");
  zone.neighbors = readLists (file, "neighbors", 0, zone.points.size ());
  zone.triangles = readTriangles (file, "zone");
  const std::vector<Index> counts = file.read<Index> ("counts");
  part.flips = counts[0];
  part.folds_after_flips = counts[1];
  part.folds = counts[2];
  part.corners = file.read<double> ("corners");
  part.check = readCheck (file);
  return part;
}

PartChange
readChange (ArrayFile& file, std::size_t part)
{
  const auto indices = [&] (const std::string& name) {
    const auto [first, last] = rangeOf (file, name, part);
    return file.read<Index> (name, first, last);
  };
  const auto triangles = [&] (const std::string& name) {
    const auto [first, last] = rangeOf (file, name, part);
    return readTriangles (file, name, first, last);
  };
  return {indices ("dropped"), indices ("turned"), triangles ("added"), triangles ("seam"),
          indices ("beside")};
}

} // namespace pcl::floater
