// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "html_report.h"

#include "core/order_statistics.h"
#include "html_template.h"
#include "report/findings.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;
using Box = Eigen::AlignedBox3d;

constexpr std::size_t MOST_SHOWN_POINTS = 50'000; // of each kind
constexpr std::size_t MOST_LISTED_LOOPS = 20;

/// Counts in bins of equal width, of the values or of their logarithms. Values beyond the ends are
/// in the first and the last bin.
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
base64 (const std::vector<Number>& numbers)
{
  std::string bytes (numbers.size () * sizeof (Number), '\0');
  for (std::size_t i = 0; i < numbers.size (); ++i)
    copyNumber<Number> (&bytes[i * sizeof (Number)], &numbers[i], ByteOrder::LITTLE);
  constexpr const char* DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size (); i += 3) {
    std::uint32_t bits = 0; // of three bytes, and zeros beyond the end
    for (std::size_t k = i; k < i + 3; ++k)
      bits = bits << 8U | (k < bytes.size () ? static_cast<unsigned char> (bytes[k]) : 0U);
    for (unsigned k = 0; k < 4; ++k)
      text += i + k > bytes.size () ? '=' : DIGITS[bits >> (18U - 6U * k) & 63U];
  }
  return text;
}

/// Points that are drawn as dots.
struct Dots
{
  const char* name;
  std::size_t count = 0;                  // of all
  std::vector<Eigen::Vector3d> positions; // of some, with the centre of the drawing at the origin
};

template <typename Position>
Dots
takeDots (const char* name, std::size_t count, const Position& positionOf)
{
  Dots dots{name, count, {}};
  constexpr double FARTHEST = 1e100; // beyond, squares overflow
  const std::size_t step = count / MOST_SHOWN_POINTS + 1;
  for (std::size_t i = 0; i < count; i += step)
    if (const Eigen::Vector3d position = positionOf (i);
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
  Box box = boxAround (drawing.positions);
  if (box.isEmpty ()) // the dots of all points are the first
    box = bulkOf (all_dots.front ());
  if (box.isEmpty ())
    return {};
  // What is far away is not shown, because nothing else would be seen.
  const Eigen::Vector3d beside = Eigen::Vector3d::Constant (0.5 * box.diagonal ().norm ());
  const Box shown (box.min () - beside, box.max () + beside);
  for (Dots& dots : all_dots) {
    const auto isFar = [&shown] (const Eigen::Vector3d& p) { return !shown.contains (p); };
    dots.positions.erase (std::remove_if (dots.positions.begin (), dots.positions.end (), isFar),
                          dots.positions.end ());
    box.extend (boxAround (dots.positions));
  }
  const double size = box.sizes ().maxCoeff () > 0.0 ? box.sizes ().maxCoeff () : 1.0;
  const auto written = [&] (const std::vector<Eigen::Vector3d>& positions) {
    std::vector<float> coordinates;
    for (const Eigen::Vector3d& position : positions)
      for (const double coordinate : (position - box.center ()) / size)
        coordinates.push_back (static_cast<float> (coordinate));
    return base64 (coordinates);
  };
  std::vector<Index> corners;
  for (const Triangle& triangle : drawing.triangles)
    corners.insert (corners.end (), triangle.begin (), triangle.end ());
  Json flaws = Json::array (), dots_json = Json::array ();
  for (const Flaw& flaw : drawing.flaws)
    flaws.push_back ({{"name", flaw.name},
                      {"count", flaw.triangles.size ()},
                      {"triangles", base64 (flaw.triangles)}});
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
          {"corners", base64 (corners)},
          {"flaws", flaws},
          {"dots", dots_json}};
}

/// The positions of the points that the report names, by their cloud index.
Json
placesJson (const Report& report, const Cloud& cloud)
{
  Json places = Json::object ();
  const auto add = [&] (std::uint32_t point) {
    const Eigen::Vector3d at = cloud.positionOfRow (point);
    places[std::to_string (point)] = {at.x (), at.y (), at.z ()};
  };
  for (const LoopDecision& decision : report.loop_decisions)
    add (decision.at);
  for (const FacingDecision& decision : report.facing_decisions)
    add (decision.at);
  for (std::size_t i = 0; i < std::min (report.check.loops.size (), MOST_LISTED_LOOPS); ++i)
    add (report.check.loops[i].at);
  return places;
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
  const Drawing drawing = makeDrawing (line, cloud, result);
  const auto dotsAt = [&] (const char* name, const std::vector<std::uint32_t>& points) {
    return takeDots (name, points.size (), [&] (std::size_t i) -> Eigen::Vector3d {
      return (cloud.positionOfRow (points[i]) - drawing.centre) / drawing.unit;
    });
  };
  std::vector<Dots> dots;
  if (drawing.triangles.empty ())
    dots.push_back (takeDots ("points", cloud.rows,
                              [&] (std::size_t row) { return cloud.positionOfRow (row); }));
  dots.push_back (dotsAt ("scatter", report.scatter));
  dots.push_back (dotsAt ("outliers", report.outliers));
  dots.push_back (dotsAt ("unused", report.unused));

  const Json data = {{"report", std::move (without_lists)},
                     {"sentences", std::move (sentences)},
                     {"places", placesJson (report, cloud)},
                     {"histograms",
                      {{"spacing", histogramJson (drawing.spacing, drawing.unit, true)},
                       {"height", histogramJson (drawing.height, 1.0, false)}}},
                     {"mesh", meshJson (drawing, result.triangles.size (), std::move (dots))}};
  // No text can end the element of HTML that holds it.
  std::string text (HTML_BEFORE_DATA);
  for (const char c : dump (data))
    c == '<' ? text += "\\u003c" : text += c;
  return text + HTML_AFTER_DATA;
}

} // namespace pcl::floater
