// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "growth_chart.h"

#include "picture_files.h"
#include "table.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl
{
namespace floater
{
namespace
{
constexpr int WIDTH = 1200, HEIGHT = 800; // pixels
constexpr int TITLE_SIZE = 20, LABEL_SIZE = 17;
constexpr float MARK_SIZE = 11.0F, LINE_WIDTH = 2.0F;

using Colour = std::array<unsigned char, 3>;
// Distinct also to colour-blind readers (after Okabe and Ito).
constexpr std::array<Colour, 8> COLOURS{
    Colour{0, 114, 178},   Colour{230, 159, 0},  Colour{0, 158, 115}, Colour{213, 94, 0},
    Colour{204, 121, 167}, Colour{86, 180, 233}, Colour{60, 60, 60},  Colour{160, 150, 0}};

struct Range
{
  Range () = default;

  explicit Range (const std::vector<double>& values)
  {
    const auto [first, last] = std::minmax_element (values.begin (), values.end ());
    least = *first;
    most = *last;
  }

  void add (const Range& other)
  {
    least = std::min (least, other.least);
    most = std::max (most, other.most);
  }

  double least = std::numeric_limits<double>::infinity ();
  double most = 0.0; // all values are positive
};

vtkNew<vtkTable>
makeTable (const std::string& name, const std::vector<double>& x, const std::vector<double>& y)
{
  vtkNew<vtkTable> table;
  for (const auto& [title, values] :
       {std::pair<std::string, const std::vector<double>&>{"points", x}, {name, y}}) {
    vtkNew<vtkDoubleArray> column;
    column->SetName (title.c_str ());
    for (const double value : values)
      column->InsertNextValue (value);
    table->AddColumn (column);
  }
  return table;
}

void
prepareAxis (vtkAxis* axis, const std::string& title, double least, double most)
{
  axis->SetTitle (title);
  axis->GetTitleProperties ()->SetFontSize (TITLE_SIZE);
  axis->GetTitleProperties ()->BoldOff ();
  axis->GetLabelProperties ()->SetFontSize (LABEL_SIZE);
  axis->SetLogScale (true);
  axis->SetBehavior (vtkAxis::FIXED);
  axis->SetUnscaledRange (least, most);
}

} // namespace

double
PowerLaw::operator() (double points) const
{
  return factor * std::pow (points, exponent);
}

PowerLaw
fitPowerLaw (const GrowthSeries& series)
{
  const auto n = static_cast<double> (series.points.size ());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < series.points.size (); ++i) {
    const double log_points = std::log (series.points[i]), log_value = std::log (series.values[i]);
    x += log_points;
    y += log_value;
    xx += log_points * log_points;
    xy += log_points * log_value;
  }
  PowerLaw law;
  law.exponent = (n * xy - x * y) / (n * xx - x * x);
  law.factor = std::exp ((y - law.exponent * x) / n);
  return law;
}

bool
hasPowerLaw (const GrowthSeries& series)
{
  return !series.points.empty () &&
         std::any_of (series.points.begin (), series.points.end (),
                      [&] (double points) { return points != series.points.front (); }) &&
         std::all_of (series.values.begin (), series.values.end (),
                      [] (double value) { return value > 0.0; });
}

std::vector<unsigned char>
drawGrowth (const std::vector<GrowthSeries>& series, const std::string& quantity)
{
  constexpr double ROOM = 1.25; // beside the outermost marks
  Range all_points, all_values;
  vtkNew<vtkContextView> view;
  view->GetRenderer ()->SetBackground (1.0, 1.0, 1.0);
  view->GetRenderWindow ()->SetOffScreenRendering (1);
  view->GetRenderWindow ()->SetSize (WIDTH, HEIGHT);
  view->GetRenderWindow ()->SetMultiSamples (4);
  vtkNew<vtkChartXY> chart;
  view->GetScene ()->AddItem (chart);

  for (std::size_t i = 0; i < series.size (); ++i) {
    const GrowthSeries& one = series[i];
    const Colour& colour = COLOURS[i % COLOURS.size ()];
    const PowerLaw law = fitPowerLaw (one);
    const Range points (one.points);
    all_points.add (points);
    all_values.add (Range (one.values));
    vtkPlot* line = chart->AddPlot (vtkChart::LINE);
    line->SetInputData (makeTable (one.name + ", N^" + fixed (law.exponent, 2),
                                   {points.least, points.most},
                                   {law (points.least), law (points.most)}),
                        0, 1);
    line->SetColor (colour[0], colour[1], colour[2], 255);
    line->SetWidth (LINE_WIDTH);
    vtkPlot* marks = chart->AddPlot (vtkChart::POINTS);
    marks->SetInputData (makeTable (one.name, one.points, one.values), 0, 1);
    marks->SetColor (colour[0], colour[1], colour[2], 255);
    auto* style = vtkPlotPoints::SafeDownCast (marks);
    style->SetMarkerStyle (vtkPlotPoints::CIRCLE);
    style->SetMarkerSize (MARK_SIZE);
    marks->LegendVisibilityOff ();
  }
  prepareAxis (chart->GetAxis (vtkAxis::BOTTOM), "points", all_points.least / ROOM,
               all_points.most * ROOM);
  prepareAxis (chart->GetAxis (vtkAxis::LEFT), quantity, all_values.least / ROOM,
               all_values.most * ROOM);
  chart->SetShowLegend (true);
  chart->GetLegend ()->SetHorizontalAlignment (vtkChartLegend::LEFT);
  chart->GetLegend ()->SetVerticalAlignment (vtkChartLegend::TOP);
  chart->GetLegend ()->SetLabelSize (LABEL_SIZE);
  view->GetRenderWindow ()->Render ();

  vtkNew<vtkWindowToImageFilter> pixels;
  pixels->SetInput (view->GetRenderWindow ());
  pixels->ReadFrontBufferOff ();
  pixels->Update ();
  return toPng (pixels->GetOutput ());
}

} // namespace floater
} // namespace pcl
