// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Error rates of the rules for the front of a surface, on generated meshes.
#include "core/geometry.h"
#include "facing_cases.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <limits>
#include <string>

namespace
{
using namespace pcl::floater;
using namespace pcl::floater::facing_cases;

constexpr double WRONG = 0.01; // share of the area; a case with more is wrong

// The rule that this one replaced, for comparison: one threshold on the volume that a component
// encloses with its centroid, as a share of the largest that it could.
void
faceByVolume (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions)
{
  constexpr double INSIDE_SHARE = 0.3, EQUAL_AXES = 0.9;
  const MeshComponents found = findComponents (mesh, 1);
  for (Index c = 0; c < found.count; ++c) {
    std::vector<Index> triangles;
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      if (found.of_triangle[t] == c)
        triangles.push_back (t);
    const auto normalOf = [&] (Index t) {
      const auto& [i, j, k] = mesh.triangles[t];
      return areaVector (positions[i], positions[j], positions[k]);
    };
    const auto middleOf = [&] (Index t) {
      const auto& [i, j, k] = mesh.triangles[t];
      return Eigen::Vector3d ((positions[i] + positions[j] + positions[k]) / 3.0);
    };
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero (), normal = Eigen::Vector3d::Zero ();
    double area = 0.0, volume = 0.0, largest = 0.0;
    bool is_closed = true;
    for (const Index t : triangles) {
      centroid += normalOf (t).norm () * middleOf (t);
      area += normalOf (t).norm ();
      normal += normalOf (t);
      for (const Index u : mesh.neighbors[t])
        is_closed = is_closed && u != NONE;
    }
    centroid /= area;
    for (const Index t : triangles) {
      volume += (middleOf (t) - centroid).dot (normalOf (t));
      largest += (middleOf (t) - centroid).norm () * normalOf (t).norm ();
    }
    bool is_turned = volume < 0.0;
    if (!is_closed && std::abs (volume) < INSIDE_SHARE * largest) {
      const double longest = normal.cwiseAbs ().maxCoeff ();
      const int axis = std::abs (normal.z ()) >= EQUAL_AXES * longest   ? 2
                       : std::abs (normal.y ()) >= EQUAL_AXES * longest ? 1
                                                                        : 0;
      is_turned = normal[axis] < 0.0;
    }
    if (is_turned)
      for (const Index t : triangles)
        std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
  }
}

struct Errors
{
  std::size_t before = 0, after = 0, unsure = 0, unsure_wrong = 0;
};

Errors
measure (Family family, std::uint64_t first, std::size_t cases, const FacingLimits& limits,
         bool lists)
{
  constexpr double UNSURE = 0.9;
  Errors errors;
  for (std::uint64_t seed = first; seed < first + cases; ++seed) {
    const FacingCase one = makeFacingCase (family, seed);
    RandomStream random (seed);
    TriangleMesh before = turnAtRandom (one, random), after = before;
    faceByVolume (before, one.positions);
    const MeshFacing facing = faceOutwards (after, one.positions, one.hints, limits, 1);
    const bool is_wrong = wrongShare (one, after) > WRONG;
    double certainty = 1.0;
    for (const FacingObject& object : facing.objects)
      certainty = std::min (certainty, object.certainty);
    errors.before += wrongShare (one, before) > WRONG ? 1 : 0;
    errors.after += is_wrong ? 1 : 0;
    errors.unsure += certainty < UNSURE ? 1 : 0;
    errors.unsure_wrong += certainty < UNSURE && is_wrong ? 1 : 0;
    if (!lists || !is_wrong)
      continue;
    std::printf ("  %s, seed %llu: %.2f of the area is wrong\n", familyName (family),
                 static_cast<unsigned long long> (seed), wrongShare (one, after));
    for (const FacingObject& object : facing.objects)
      std::printf ("    rule %d, certainty %.2f, front %.3f, back %.3f, mean normal %.3f, %zu "
                   "triangles\n",
                   static_cast<int> (object.rule), object.certainty, object.front, object.back,
                   object.mean_normal, object.triangles);
  }
  return errors;
}

void
printErrors (std::uint64_t first, std::size_t cases, const FacingLimits& limits, bool lists,
             const std::string& only)
{
  std::printf ("%-20s %6s %8s %8s %8s %14s\n", "family", "cases", "before", "after", "unsure",
               "of these wrong");
  Errors all;
  std::size_t count = 0;
  for (std::size_t f = 0; f < static_cast<std::size_t> (Family::COUNT); ++f) {
    const auto family = static_cast<Family> (f);
    if (!only.empty () && only != familyName (family))
      continue;
    const Errors errors = measure (family, first, cases, limits, lists);
    std::printf ("%-20s %6zu %8zu %8zu %8zu %14zu\n", familyName (family), cases, errors.before,
                 errors.after, errors.unsure, errors.unsure_wrong);
    std::fflush (stdout);
    all.before += errors.before;
    all.after += errors.after;
    all.unsure += errors.unsure;
    all.unsure_wrong += errors.unsure_wrong;
    count += cases;
  }
  std::printf ("%-20s %6zu %8zu %8zu %8zu %14zu\n", "all", count, all.before, all.after, all.unsure,
               all.unsure_wrong);
}

// Caps of a sphere that are open at the top: from which share of the sphere on they are bowls.
void
printCaps (const FacingLimits& limits)
{
  std::printf ("\n%5s %8s %8s %12s %10s %s\n", "share", "front", "back", "mean normal", "certainty",
               "faces");
  constexpr int STEPS = 20;
  for (int i = 1; i < STEPS; ++i) {
    const FacingCase one = makeBowl (static_cast<double> (i) / STEPS);
    TriangleMesh mesh = one.mesh;
    const MeshFacing facing = faceOutwards (mesh, one.positions, {}, limits, 1);
    const FacingObject& object = facing.objects.front ();
    std::printf ("%5.2f %8.3f %8.3f %12.3f %10.2f %s\n", static_cast<double> (i) / STEPS,
                 object.front, object.back, object.mean_normal, object.certainty,
                 facing.turned == 0 ? "outwards, down" : "up");
  }
}

// Processor time on caps, of which both sides are looked at, and on terrain, which needs no look.
void
printTimes (const FacingLimits& limits)
{
  std::printf ("\n%8s %8s %22s\n", "share", "points", "microseconds per point");
  constexpr int RUNS = 5;
  for (const double share : {0.1, 0.5, 0.9})
    for (const int side : {60, 187, 360}) {
      const FacingCase one = makeBowl (share, side);
      double least = std::numeric_limits<double>::infinity ();
      for (int i = 0; i < RUNS; ++i) {
        TriangleMesh mesh = one.mesh;
        const std::clock_t begin = std::clock ();
        faceOutwards (mesh, one.positions, {}, limits, 1);
        least = std::min (least, static_cast<double> (std::clock () - begin));
      }
      std::printf ("%8.2f %8zu %22.3f\n", share, one.positions.size (),
                   1e6 * least / CLOCKS_PER_SEC / static_cast<double> (one.positions.size ()));
    }
}

} // namespace

int
main (int argc, char** argv)
{
  CLI::App app ("Error rates of the rules for the front of a surface, on generated meshes.");
  std::size_t cases = 100;
  std::uint64_t first = 1;
  bool lists = false;
  std::string family;
  FacingLimits limits;
  app.add_option ("--cases", cases, "of each family");
  app.add_option ("--first", first, "first seed");
  app.add_flag ("--list", lists, "tell of each case that is wrong");
  app.add_option ("--family", family, "only this one");
  app.add_option ("--body-ratio", limits.body_ratio);
  app.add_option ("--lines", limits.lines);
  app.add_option ("--reach", limits.continuations.reach);
  app.add_option ("--seen-share", limits.seen_share);
  CLI11_PARSE (app, argc, argv);
  try {
    printErrors (first, cases, limits, lists, family);
    printCaps (limits);
    printTimes (limits);
  }
  catch (const std::exception& error) {
    std::fprintf (stderr, "pcl_floater_facing: %s\n", error.what ());
    return 1;
  }
  return 0;
}
