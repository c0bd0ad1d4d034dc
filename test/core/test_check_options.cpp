// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/check_options.h"

#include "core/types.h"
#include "options/option_rows.h"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

namespace pcl::floater {
namespace {
constexpr double NO_NUMBER = std::numeric_limits<double>::quiet_NaN ();
constexpr double INF = std::numeric_limits<double>::infinity ();

// Tries the ends of each range, and what lies beyond them.
struct RangeTrial
{
  Options& options;
  int numbers = 0;

  template <typename Number>
  void operator() (const OptionRow& row, Number& value, const NumberRange& range)
  {
    SCOPED_TRACE (row.name);
    const Number usual = value;
    const auto expect = [&] (double number, bool is_good) {
      value = static_cast<Number> (number);
      const Problem problem = checkOptions (options);
      EXPECT_EQ (problem.status, is_good ? RunStatus::SUCCESS : RunStatus::INVALID_OPTION)
          << number;
      EXPECT_EQ (problem.option, is_good ? "" : row.name);
      EXPECT_EQ (problem.message, is_good ? "" : row.name + (" must be " + range.text ()));
      value = usual;
    };
    expect (range.least, !range.without_least);
    expect (range.least - 1.0, false);
    if (range.most != NO_LIMIT) {
      expect (range.most, !range.without_most);
      expect (range.most + 1.0, false);
    }
    if (!std::is_integral_v<Number>) {
      expect (NO_NUMBER, false);
      expect (INF, false);
    }
    ++numbers;
  }
  void operator() (const OptionRow& row, HoleOptions& holes, LengthUnit unit)
  {
    holes.unit = unit;
    (*this) (row, holes.largest_hole, NumberRange{0, NO_LIMIT});
  }
  template <typename... More>
  void operator() (const OptionRow&, More&...)
  {
  }
};

TEST (CheckOptions, NumbersHaveRanges)
{
  Options options;
  EXPECT_FALSE (checkOptions (options));
  RangeTrial trial{options};
  visitOptions (options, trial);
  EXPECT_GT (trial.numbers, 15);
  EXPECT_EQ ((NumberRange{6, 200}.text ()), "from 6 to 200");
  EXPECT_EQ ((NumberRange{0, 360, true, true}.text ()), "above 0 and below 360");
  EXPECT_EQ ((NumberRange{0, 1, true, false}.text ()), "above 0 and at most 1");
  EXPECT_EQ ((NumberRange{3, NO_LIMIT}.text ()), "3 or more");
}

TEST (CheckOptions, PoliciesFitTheTopology)
{
  for (const Topology topology : {Topology::AUTO, Topology::DISC, Topology::SURFACE})
    for (const HolePolicy holes :
         {HolePolicy::AUTO, HolePolicy::CLOSE_ALL, HolePolicy::KEEP_LARGEST, HolePolicy::KEEP_COUNT,
          HolePolicy::BY_SIZE}) {
      Options options;
      options.topology = topology;
      options.holes.policy = holes;
      options.holes.largest_hole = 3.0;
      const bool fits = topology != Topology::DISC || holes == HolePolicy::AUTO ||
                        holes == HolePolicy::KEEP_LARGEST;
      EXPECT_EQ (checkOptions (options).status,
                 fits ? RunStatus::SUCCESS : RunStatus::INVALID_OPTION);
      options.holes.unit = LengthUnit::CLOUD;
      EXPECT_EQ (checkOptions (options).status,
                 fits ? RunStatus::SUCCESS : RunStatus::INVALID_OPTION);
      // Only one policy needs a size.
      options.holes.largest_hole = 0.0;
      const bool fits_still = fits && holes != HolePolicy::BY_SIZE;
      EXPECT_EQ (checkOptions (options).status,
                 fits_still ? RunStatus::SUCCESS : RunStatus::INVALID_OPTION);
    }
}

TEST (CheckOptions, AViewpointIsFiniteAndNotOfADisc)
{
  Options options;
  options.view.viewpoint = {0.0, NO_NUMBER, 0.0};
  EXPECT_FALSE (checkOptions (options)); // not used
  options.view.use = ViewUse::GIVEN;
  EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION);
  options.view.viewpoint = {0.0, INF, 0.0};
  EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION);
  options.view.viewpoint = {};
  EXPECT_FALSE (checkOptions (options));
  options.topology = Topology::DISC;
  EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION);
}

TEST (CheckOptions, AGivenLoopIsOfADisc)
{
  Options options;
  options.disc.boundary.loop = {1, 2, 3};
  EXPECT_FALSE (checkOptions (options));
  options.topology = Topology::DISC;
  EXPECT_FALSE (checkOptions (options));
  options.topology = Topology::SURFACE;
  EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION);
}

TEST (CheckOptions, ALoopHasThreePoints)
{
  Options options;
  for (const std::vector<Index>& loop : {std::vector<Index>{1}, std::vector<Index>{1, 2}}) {
    options.disc.boundary.loop = loop;
    EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_LOOP);
  }
  options.disc.boundary.loop = {1, 2, 3};
  EXPECT_FALSE (checkOptions (options));
}

} // namespace
} // namespace pcl::floater
