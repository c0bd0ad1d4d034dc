// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_report.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "html_template.h"
#include "mesh/check.h"
#include "mesh/folds.h"
#include "mesh/self_intersections.h"
#include "points/neighbors.h"
#include "report/findings.h"
#include "report_json.h"

#include <boost/algorithm/string/replace.hpp>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include <nlohmann/json.hpp>

#include <unordered_map>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;
using Box = Eigen::AlignedBox3d;

struct Flaw
{
  const char* name;
  std::vector<Index> triangles; // ascending
};

/// The mesh as it is drawn: only its vertices, around the origin, in a unit that float can square.
struct Drawing
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero (); // of the cloud, where the origin is
  double unit = 1.0;                                 // in units of the cloud; a power of two
  std::vector<Eigen::Vector3d> positions;
  Triangles triangles;
  std::vector<float> spacing; // of each vertex; empty if there is no mesh
  std::vector<float> height;  // of each vertex above those around, in spacings
  std::vector<Flaw> flaws;
  double median_spacing = 0.0;
  bool has_all_flaws = true;
};

Box
boxAround (const std::vector<Eigen::Vector3d>& positions)
{
  Box box;
  for (const Eigen::Vector3d& position : positions)
    box.extend (position);
  return box;
}

/// The height of each vertex above the mean of those that it is connected to, in spacings.
std::vector<float>
heights (const Drawing& drawing, int threads)
{
  const std::vector<Eigen::Vector3f> normals =
      vertexNormals (drawing.positions, drawing.triangles, threads);
  std::vector<double> sums (normals.size ());
  std::vector<std::uint32_t> terms (normals.size ());
  for (const Triangle& triangle : drawing.triangles)
    for (std::size_t c = 0; c < 3; ++c)
      for (const std::size_t other : {(c + 1) % 3, (c + 2) % 3}) {
        const Index p = triangle[c];
        sums[p] += normals[p].cast<double> ().dot (drawing.positions[triangle[other]] -
                                                   drawing.positions[p]);
        ++terms[p];
      }
  std::vector<float> result;
  for (std::size_t p = 0; p < sums.size (); ++p)
    if (drawing.spacing[p] > 0.0F)
      result.push_back (
          static_cast<float> (std::abs (sums[p]) / (terms[p] * double (drawing.spacing[p]))));
  return result;
}

/// The flaws of which the report has some places only, by the limits of its examination.
std::vector<Flaw>
findFlaws (const TriangleMesh& mesh, const Drawing& drawing, bool has_crossings,
           const RunContext& run)
{
  constexpr CheckLimits LIMITS;
  const std::vector<Eigen::Vector3d>& positions = drawing.positions;
  const double precision = LIMITS.precision * boxAround (positions).diagonal ().norm ();
  std::vector<Index> crossing, folded, flat, at_long_edges;
  if (has_crossings)
    for (const CrossingPair& pair : findSelfIntersections (mesh.triangles, positions, run))
      crossing.insert (crossing.end (), {pair.first, pair.second});
  for (const MeshEdge edge : findFolds (mesh, positions, run))
    folded.insert (folded.end (), {edge.triangle, mesh.mate (edge).triangle});
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    double longest = 0.0;
    for (const std::uint8_t side : {0, 1, 2}) {
      const MeshEdge edge{t, side};
      const Index from = mesh.from (edge), to = mesh.to (edge), other = mesh.mate (edge).triangle;
      const double length = (positions[to] - positions[from]).norm ();
      longest = std::max (longest, length);
      if (other != NONE && other > t &&
          length > LIMITS.long_edge * 0.5 * (drawing.spacing[from] + drawing.spacing[to]))
        at_long_edges.insert (at_long_edges.end (), {t, other});
    }
    const double height = areaVector (positions[a], positions[b], positions[c]).norm () / longest;
    if (!(height > precision || height > LIMITS.flat_height * longest))
      flat.push_back (t);
  }
  std::vector<Flaw> flaws{
      {"crossing", crossing}, {"folded", folded}, {"flat", flat}, {"long", at_long_edges}};
  for (Flaw& flaw : flaws)
    sortUnique (flaw.triangles);
  return flaws;
}

/// Joins the vertices within the cells of a grid that is just wide enough, but those of flaws.
void
thin (Drawing& drawing, std::size_t most)
{
  std::vector<std::uint8_t> stays (drawing.positions.size ());
  for (const Flaw& flaw : drawing.flaws)
    for (const Index t : flaw.triangles)
      for (const Index p : drawing.triangles[t])
        stays[p] = 1;
  const Box box = boxAround (drawing.positions);
  constexpr double CELLS = 1 << 20, GROWTH = 1.2;
  const double widest = box.sizes ().maxCoeff ();
  const double too_many = static_cast<double> (drawing.triangles.size ()) / double (most);
  const double narrowest =
      std::max ({drawing.median_spacing * std::sqrt (too_many) / GROWTH, widest / CELLS, 1e-300});
  double cell = narrowest;
  std::vector<Index> joined (stays.size ());
  Triangles kept;
  std::vector<Index> number; // of each triangle among those kept
  do {
    cell *= GROWTH;
    if (cell > widest && drawing.has_all_flaws) { // there are too many
      drawing.has_all_flaws = false;
      std::fill (stays.begin (), stays.end (), std::uint8_t{0});
      cell = narrowest;
    }
    std::unordered_map<std::uint64_t, Index> first;
    for (Index p = 0; p < joined.size (); ++p) {
      std::uint64_t key = 0;
      for (int axis = 0; axis < 3; ++axis)
        key = key << 21U |
              static_cast<std::uint64_t> ((drawing.positions[p][axis] - box.min ()[axis]) / cell);
      joined[p] = stays[p] != 0 ? p : first.try_emplace (key, p).first->second;
    }
    kept.clear ();
    number.assign (drawing.triangles.size (), NONE);
    for (std::size_t t = 0; t < number.size (); ++t) {
      Triangle triangle = drawing.triangles[t];
      for (Index& p : triangle)
        p = joined[p];
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
        continue;
      number[t] = static_cast<Index> (kept.size ());
      kept.push_back (triangle);
    }
  } while (kept.size () > most);
  for (Flaw& flaw : drawing.flaws) {
    for (Index& t : flaw.triangles)
      t = number[t];
    boost::remove_erase (flaw.triangles, NONE);
  }
  drawing.positions = valuesAt (drawing.positions, takeUsed (joined.size (), kept));
  drawing.triangles = std::move (kept);
}

/// Spacing, heights and flaws are those of the whole mesh.
Drawing
makeDrawing (const CommandLine& line, const Cloud& cloud, const Result& result)
{
  Drawing drawing;
  if (result.triangles.empty ())
    return drawing;
  drawing.triangles = result.triangles;
  for (const Index p : takeUsed (cloud.size (), drawing.triangles))
    drawing.positions.push_back (cloud.position (p));
  const Eigen::AlignedBox3d box = boxAround (drawing.positions);
  drawing.centre = box.center ();
  if (const double size = box.sizes ().maxCoeff (); size > 0.0)
    drawing.unit = std::ldexp (1.0, std::ilogb (size));
  for (Eigen::Vector3d& position : drawing.positions)
    position = (position - drawing.centre) / drawing.unit;
  constexpr int NEAREST = 6; // that localSpacing takes
  const RunContext run (std::max (line.options.threads, 0));
  const CsrLists nearest =
      findNearestNeighbors (drawing.positions, Rows::all (drawing.positions.size ()), NEAREST, run);
  drawing.spacing = localSpacing (drawing.positions, nearest, run);
  std::vector<float> spacing = drawing.spacing;
  drawing.median_spacing = median (spacing);
  drawing.height = heights (drawing, line.options.threads);
  TriangleMesh mesh;
  mesh.triangles = drawing.triangles;
  if (mesh.connect (drawing.positions.size (), run))
    drawing.flaws = findFlaws (mesh, drawing, result.report.check.self_intersections > 0, run);
  if (drawing.triangles.size () > line.shown_triangles)
    thin (drawing, line.shown_triangles);
  return drawing;
}

/// Counts in bins of equal width, of the values or their logarithms; the outer two have the rest.
/// \param unit of the values; the result is in units of the cloud
Json
histogramJson (std::vector<float> values, double unit, bool is_log)
{
  constexpr std::size_t BINS = 48;
  constexpr double TAIL = 0.005;
  if (values.empty ())
    return {};
  const auto scaled = [is_log] (double value) { return is_log ? std::log (value) : value; };
  const double low = is_log ? quantile (values, TAIL) : 0.0F, high = quantile (values, 1 - TAIL);
  const double from = scaled (low), width = (scaled (high) - from) / BINS;
  std::vector<std::size_t> counts (BINS);
  for (const float value : values) {
    const double bin = width > 0.0 ? std::floor ((scaled (value) - from) / width) : 0.0;
    ++counts[static_cast<std::size_t> (std::clamp (bin, 0.0, BINS - 1.0))];
  }
  const auto at = [&] (double share) { return unit * quantile (values, share); };
  return {{"log", is_log},      {"from", unit * low},      {"to", unit * high},
          {"counts", counts},   {"least", at (0.0)},       {"quantile_10", at (0.1)},
          {"median", at (0.5)}, {"quantile_90", at (0.9)}, {"largest", at (1.0)}};
}

/// Numbers of 32 bits, little endian, in base64.
template <typename Number>
std::string
base64 (const Number* numbers, std::size_t count)
{
  std::string bytes (count * sizeof (Number), '\0');
  for (std::size_t i = 0; i < count; ++i)
    copyNumber<Number> (&bytes[i * sizeof (Number)], &numbers[i]);
  using SixBits = boost::archive::iterators::transform_width<const char*, 6, 8>;
  using Digits = boost::archive::iterators::base64_from_binary<SixBits>;
  const std::size_t padding = (3 - bytes.size () % 3) % 3;
  bytes.resize (bytes.size () + padding, '\0');
  const char* const end = bytes.data () + bytes.size ();
  std::string text (Digits (static_cast<const char*> (bytes.data ())), Digits (end));
  return text.replace (text.size () - padding, padding, padding, '=');
}

struct Dots
{
  const char* name;
  std::size_t count = 0;                  // of all
  std::vector<Eigen::Vector3d> positions; // of some, with the centre of the drawing at the origin
};

Dots
takeDots (const char* name, const std::vector<Index>& points, const Cloud& cloud,
          const Drawing& drawing)
{
  Dots dots{name, points.size (), {}};
  constexpr double FARTHEST = 1e100; // beyond, squares overflow
  constexpr std::size_t MOST_SHOWN = 50'000;
  const std::size_t step = points.size () / MOST_SHOWN + 1;
  for (std::size_t i = 0; i < points.size (); i += step)
    if (const Eigen::Vector3d position =
            (cloud.positionOfRow (points[i]) - drawing.centre) / drawing.unit;
        (position.array ().abs () < FARTHEST).all ())
      dots.positions.push_back (position);
  return dots;
}

/// The box of nearly all of the dots.
Box
bulkOf (const Dots& dots)
{
  constexpr double TAIL = 0.01;
  Box box;
  for (int axis = 0; axis < 3 && !dots.positions.empty (); ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& position : dots.positions)
      values.push_back (position[axis]);
    box.min ()[axis] = quantile (values, TAIL);
    box.max ()[axis] = quantile (values, 1.0 - TAIL);
  }
  return box;
}

Json
meshJson (const Drawing& drawing, std::size_t triangles, std::vector<Dots> all_dots)
{
  // The dots of all points are the first.
  Box box = drawing.positions.empty () ? bulkOf (all_dots[0]) : boxAround (drawing.positions);
  if (box.isEmpty ())
    return {};
  // What is far away is not shown, because nothing else would be seen.
  const Eigen::Vector3d beside = Eigen::Vector3d::Constant (0.5 * box.diagonal ().norm ());
  const Box shown (box.min () - beside, box.max () + beside);
  for (Dots& dots : all_dots) {
    boost::remove_erase_if (dots.positions, [&shown] (const Eigen::Vector3d& position) {
      return !shown.contains (position);
    });
    box.extend (boxAround (dots.positions));
  }
  const double size = box.sizes ().maxCoeff () > 0.0 ? box.sizes ().maxCoeff () : 1.0;
  const auto written = [&] (const std::vector<Eigen::Vector3d>& positions) {
    std::vector<float> coordinates;
    for (const Eigen::Vector3d& position : positions)
      for (const double coordinate : (position - box.center ()) / size)
        coordinates.push_back (static_cast<float> (coordinate));
    return base64 (coordinates.data (), coordinates.size ());
  };
  const auto* const corners = reinterpret_cast<const Index*> (drawing.triangles.data ());
  Json flaws = Json::array (), dots_json = Json::array ();
  for (const Flaw& flaw : drawing.flaws)
    flaws.push_back ({{"name", flaw.name},
                      {"count", flaw.triangles.size ()},
                      {"triangles", base64 (flaw.triangles.data (), flaw.triangles.size ())}});
  for (const Dots& dots : all_dots)
    dots_json.push_back ({{"name", dots.name},
                          {"count", dots.count},
                          {"shown", dots.positions.size ()},
                          {"positions", written (dots.positions)}});
  const Eigen::Vector3d origin = drawing.centre + drawing.unit * box.center ();
  return {{"triangles", triangles},
          {"shown", drawing.triangles.size ()},
          {"all_flaws", drawing.has_all_flaws},
          {"origin", {origin.x (), origin.y (), origin.z ()}},
          {"unit", drawing.unit * size},
          {"spacing", drawing.unit * drawing.median_spacing},
          {"positions", written (drawing.positions)},
          {"corners", base64 (corners, 3 * drawing.triangles.size ())},
          {"flaws", flaws},
          {"dots", dots_json}};
}

} // namespace

std::string
htmlReport (const CommandLine& line, const Cloud& cloud, const Result& result,
            const RunFigures& run)
{
  const Report& report = result.report;
  Json without_lists = reportJson (line, report, run);
  for (const char* list : {"loop", "unused", "outliers", "scatter", "non_finite", "duplicates"})
    without_lists[list] = without_lists[list].size ();
  Json sentences = Json::array ();
  for (const Finding& finding : report.findings)
    sentences.push_back (sentenceOf (finding));
  Json places = Json::object (); // the positions of the points that the report names
  const auto addPlace = [&] (std::uint32_t point) {
    const Eigen::Vector3d at = cloud.positionOfRow (point);
    places[std::to_string (point)] = {at.x (), at.y (), at.z ()};
  };
  for (const LoopDecision& decision : report.loop_decisions)
    addPlace (decision.at);
  for (const FacingDecision& decision : report.facing_decisions)
    addPlace (decision.at);
  constexpr std::size_t MOST_LISTED = 20; // loops
  for (std::size_t i = 0; i < std::min<std::size_t> (report.check.loops.size (), MOST_LISTED); ++i)
    addPlace (report.check.loops[i].at);
  const Drawing drawing = makeDrawing (line, cloud, result);
  std::vector<Index> all (drawing.triangles.empty () ? cloud.rows : 0);
  std::iota (all.begin (), all.end (), Index{0});
  std::vector<Dots> dots;
  for (const auto& [name, points] :
       {std::pair ("points", &std::as_const (all)), std::pair ("scatter", &report.scatter),
        std::pair ("outliers", &report.outliers), std::pair ("unused", &report.unused)})
    dots.push_back (takeDots (name, *points, cloud, drawing));

  const Json data = {{"report", std::move (without_lists)},
                     {"sentences", std::move (sentences)},
                     {"places", std::move (places)},
                     {"histograms",
                      {{"spacing", histogramJson (drawing.spacing, drawing.unit, true)},
                       {"height", histogramJson (drawing.height, 1.0, false)}}},
                     {"mesh", meshJson (drawing, result.triangles.size (), std::move (dots))}};
  // No text can end the element of HTML that holds it.
  return HTML_BEFORE_DATA + boost::replace_all_copy (dump (data), "<", "\\u003c") + HTML_AFTER_DATA;
}

} // namespace pcl::floater
