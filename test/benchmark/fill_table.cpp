// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Table 2 of TW 385: the fill-in factor gamma.
#include "floater/solvers/ordering.h"
#include "section.h"
#include "symbolic_factors.h"
#include "umfpack_sizes.h"

namespace pcl
{
namespace floater
{
namespace
{
std::string
millions (std::size_t number)
{
  constexpr double MILLION = 1e6;
  return fixed (static_cast<double> (number) / MILLION, 3);
}

class FillTable : public Section
{
public:
  FillTable ()
  {
    table_.columns = {"cloud", "nnz (A)", "nnz (L + U)", "gamma", "AMD", "METIS", "RCM", "curve"};
    printed_.columns = {"model of TW 385", "nnz (A)", "nnz (L + U)", "gamma"};
    printed_.rows = {{"VW_9K", "0.059", "0.31", "5.2"},
                     {"HEAD_DRAGON", "0.214", "1.72", "8.0"},
                     {"BUNNY", "0.219", "2.30", "10.4"},
                     {"HALF_DRAGON, decimated", "0.408", "3.55", "8.7"},
                     {"ISIS", "1.301", "19.57", "15.04"}};
  }

  void measure (const Sample& sample) override
  {
    const LinearSystem& system = sample.disc.system;
    const std::size_t factors = measureUmfpack (system).nnz_factors;
    const auto gamma = [&system] (std::size_t nnz) {
      return fixed (static_cast<double> (nnz) / static_cast<double> (system.nonzeros ()), 1);
    };
    std::vector<std::string> row{sample.disc.name, millions (system.nonzeros ()),
                                 millions (factors), gamma (factors)};
    for (const Ordering ordering :
         {Ordering::AMD, Ordering::METIS, Ordering::REVERSE_CUTHILL_MCKEE, Ordering::NATURAL})
      row.push_back (gamma (symbolicFactors (system, orderUnknowns (system, ordering), {})));
    table_.rows.push_back (row);
  }

  void write (ReportFolder& report) const override
  {
    report.heading ("Table 2: fill-in");
    report.paragraph (
        "Nonzeros in millions, those of the factors as UMFPACK made them (AMD, symmetric "
        "strategy; the unit diagonal of L is not counted); gamma = nnz (L + U) / nnz (A). To "
        "the right of it, gamma by order of the unknowns, as it follows from the pattern of A "
        "+ A^T alone: approximate minimum degree, nested dissection by METIS, reverse "
        "Cuthill-McKee, and the order of our points along a space-filling curve.");
    report.table ("table2_fill", table_);
    report.paragraph ("As printed in TW 385:");
    report.table ("table2_printed", printed_);
  }

private:
  Table table_, printed_;
};

} // namespace

std::unique_ptr<Section>
makeFillTable ()
{
  return std::make_unique<FillTable> ();
}

} // namespace floater
} // namespace pcl
