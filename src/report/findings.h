// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a user should know of a run, and the sentences that say it.
#pragma once

#include "points/points.h"

#include <pcl/surface/floater/report.h>

#include <initializer_list>
#include <string>

namespace pcl::floater {
/// "1 edge is", "2 edges are".
std::string
counted (std::size_t count, const char* one, const char* several);

/// Cloud index and position: "point 7 (1.5, 0, 2.25)".
std::string
placeText (Index cloud_index, const Vector3d& at);

/// A number with three significant digits: "15.6", "2.44e+13". Whole numbers have all of theirs.
std::string
rounded (double value);

/// Adds a finding to the report.
/// \param at      points at its places
template <typename... Numbers>
void
addFinding (Report& report, FindingId id, const Points& points, std::initializer_list<Index> at,
            Numbers... numbers)
{
  Finding finding{id, {}, {static_cast<double> (numbers)...}, {}};
  for (const Index p : at) {
    const Vector3d position = points.inCloud (p);
    finding.places.push_back (
        {points.cloud_index[p], {position.x (), position.y (), position.z ()}});
  }
  report.findings.push_back (std::move (finding));
}

/// The sentence of a finding.
std::string
sentenceOf (const Finding& finding);

/// Sets the severity of each finding, sorts them by severity and number, and adds the sentence of
/// each to the warnings. Called once, at the end of a run.
void
describeFindings (Report& report);

} // namespace pcl::floater
