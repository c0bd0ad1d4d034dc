// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "part_files.h"

#include "stored_cloud.h"

namespace pcl
{
namespace floater
{
namespace
{
static_assert (sizeof (Triangle) == 3 * sizeof (Index),
               "they are written and read as plain numbers");

std::vector<Triangle>
readTriangles (ArrayFile& file, const std::string& name, std::size_t first, std::size_t last)
{
  std::vector<Triangle> triangles (last - first);
  file.read (name, 3 * first, 3 * last, reinterpret_cast<Index*> (triangles.data ()));
  return triangles;
}

// The range of a part in an array of all parts, one behind the other.
std::pair<std::size_t, std::size_t>
rangeOf (ArrayFile& file, const std::string& name, std::size_t part)
{
  const std::string ends = name + ".ends";
  const Index first = part == 0 ? 0 : file.read<Index> (ends, part - 1, part).front ();
  return {first, file.read<Index> (ends, part, part + 1).front ()};
}

} // namespace

template <>
std::vector<Index>&
PartWriter::keep ()
{
  return indices_.emplace_back ();
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
  for (const Candidate& candidate : rim.open) {
    corners.push_back (candidate.corners);
    marks_.push_back (candidate.votes);
    ratios_.push_back (candidate.circumradius_ratio);
  }
  addTriangles ("open.corners", corners);
  arrays_.add ("open.votes", marks_);
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
  arrays_.add ("is_scatter", zone.is_scatter);
  writeLists ("neighbors", zone.neighbors, arrays_);
  addTriangles ("zone", zone.triangles);
  auto& counts = keep<Index> ();
  counts = {static_cast<Index> (part.flips), static_cast<Index> (part.folds_after_flips),
            static_cast<Index> (part.folds)};
  arrays_.add ("counts", counts);
  arrays_.add ("corners", part.corners);
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
       {std::pair ("dropped", &PartChange::dropped), std::pair ("turned", &PartChange::turned)}) {
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
  part.triangles = readTriangles (file, "triangles");
  zone.points = file.read<Index> ("points");
  zone.positions = readVectors<Eigen::Vector3d> (file, "positions");
  zone.normals = readVectors<Eigen::Vector3f> (file, "normals");
  zone.spacing = file.read<float> ("spacing");
  zone.is_partial = file.read<std::uint8_t> ("is_partial");
  zone.is_scatter = file.read<std::uint8_t> ("is_scatter");
  zone.neighbors = readLists (file, "neighbors", 0, zone.points.size ());
  zone.triangles = readTriangles (file, "zone");
  const std::vector<Index> counts = file.read<Index> ("counts");
  part.flips = counts[0];
  part.folds_after_flips = counts[1];
  part.folds = counts[2];
  part.corners = file.read<double> ("corners");
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
  return {indices ("dropped"), indices ("turned"), triangles ("added"), triangles ("seam")};
}

} // namespace floater
} // namespace pcl
