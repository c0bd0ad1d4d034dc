// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Figure 4 of TW 385: where the matrix and its factors have their nonzeros.
#include "floater/solvers/ordering.h"
#include "picture_file.h"
#include "section.h"
#include "symbolic_factors.h"

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr int SIDE = 480;  // pixels of a plot
constexpr int GUTTER = 16; // pixels between plots
constexpr int COLUMNS = 3; // plots in a row
constexpr std::uint8_t PAPER = 255, FRAME = 160;
constexpr double LIGHTEST = 0.3; // darkness of a pixel with a single nonzero, if that is rare

// Nonzeros of a matrix, counted by pixel.
class Plot
{
public:
  explicit Plot (std::size_t unknowns) : unknowns_ (unknowns), counts_ (SIDE * SIDE, 0) {}

  void add (Index row, Index column) { ++counts_[pixel (row) * SIDE + pixel (column)]; }

  // Darkness grows with the logarithm of the count, up to that of the fullest pixels.
  void draw (GreyImage& image, int left, int top) const
  {
    constexpr double FULL = 0.98; // quantile of the filled pixels that is black
    std::vector<std::size_t> filled;
    std::copy_if (counts_.begin (), counts_.end (), std::back_inserter (filled),
                  [] (std::size_t count) { return count > 0; });
    std::sort (filled.begin (), filled.end ());
    const double most = filled.empty () ? 1.0
                                        : static_cast<double> (filled[static_cast<std::size_t> (
                                              FULL * static_cast<double> (filled.size () - 1))]);
    for (int y = 0; y < SIDE; ++y)
      for (int x = 0; x < SIDE; ++x) {
        const auto count = static_cast<double> (counts_[static_cast<std::size_t> (y * SIDE + x)]);
        if (count == 0.0)
          continue;
        const double share = most > 1.0 ? std::min (1.0, std::log (count) / std::log (most)) : 1.0;
        const double darkness = LIGHTEST + (1.0 - LIGHTEST) * share;
        image.at (left + x, top + y) =
            static_cast<std::uint8_t> (std::lround (PAPER * (1.0 - darkness)));
      }
    for (int i = -1; i <= SIDE; ++i)
      for (const int side : {-1, SIDE}) {
        image.at (left + i, top + side) = FRAME;
        image.at (left + side, top + i) = FRAME;
      }
  }

private:
  std::size_t pixel (Index row) const { return static_cast<std::size_t> (row) * SIDE / unknowns_; }

  std::size_t unknowns_;
  std::vector<std::size_t> counts_;
};

Plot
plotMatrix (const LinearSystem& system)
{
  Plot plot (system.unknowns ());
  for (Index i = 0; i < system.unknowns (); ++i)
    for (int entry = system.row_offsets[i]; entry < system.row_offsets[i + 1]; ++entry)
      plot.add (i, static_cast<Index> (system.columns[static_cast<std::size_t> (entry)]));
  return plot;
}

Plot
plotFactors (const LinearSystem& system, const std::vector<int>& order)
{
  Plot plot (system.unknowns ());
  for (Index i = 0; i < system.unknowns (); ++i)
    plot.add (i, i);
  symbolicFactors (system, order, [&plot] (Index row, Index column) {
    plot.add (row, column);
    plot.add (column, row);
  });
  return plot;
}

class SparsityFigure : public Section
{
public:
  void measure (const Sample& sample) override
  {
    const LinearSystem& system = sample.disc.system;
    const std::vector<int> rcm = orderUnknowns (system, Ordering::REVERSE_CUTHILL_MCKEE);
    const std::vector<int> amd = orderUnknowns (system, Ordering::AMD);
    const std::vector<Plot> plots{plotMatrix (permuteSystem (system, fileOrder (sample.disc))),
                                  plotMatrix (system),
                                  plotMatrix (permuteSystem (system, rcm)),
                                  plotMatrix (permuteSystem (system, amd)),
                                  plotFactors (system, amd),
                                  plotFactors (system, rcm)};
    const int rows = (static_cast<int> (plots.size ()) + COLUMNS - 1) / COLUMNS;
    constexpr int STEP = SIDE + GUTTER;
    GreyImage image (COLUMNS * STEP + GUTTER, rows * STEP + GUTTER, PAPER);
    for (int i = 0; i < static_cast<int> (plots.size ()); ++i)
      plots[static_cast<std::size_t> (i)].draw (image, GUTTER + i % COLUMNS * STEP,
                                                GUTTER + i / COLUMNS * STEP);
    const auto n = static_cast<double> (system.unknowns ());
    const double share = 100.0 * static_cast<double> (system.nonzeros ()) / (n * n);
    figures_.push_back (
        {sample.disc.name, toPng (image),
         sample.disc.name + ", " + grouped (system.unknowns ()) + " unknowns, " + fixed (share, 3) +
             " % nonzeros. Above: A in the order of the file, in our order along a "
             "space-filling curve, after reverse Cuthill-McKee. Below: A after AMD, its L + U, "
             "and L + U after reverse Cuthill-McKee"});
  }

  void write (ReportFolder& report) const override
  {
    report.heading ("Figure 4: sparsity");
    report.paragraph (
        "A pixel is as dark as the logarithm of its number of nonzeros. The factors are those "
        "of the pattern of A + A^T. Points of a file may come in any order.");
    for (const Figure& figure : figures_)
      report.picture ("figure4_sparsity_" + figure.name, figure.png, figure.caption);
  }

private:
  struct Figure
  {
    std::string name;
    std::vector<unsigned char> png;
    std::string caption;
  };
  std::vector<Figure> figures_;
};

} // namespace

std::unique_ptr<Section>
makeSparsityFigure ()
{
  return std::make_unique<SparsityFigure> ();
}

} // namespace floater
} // namespace pcl
