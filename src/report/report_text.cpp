// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_text.h"

#include <sstream>

namespace pcl::floater {
std::string
place (const Points& points, Index p)
{
  std::ostringstream text;
  text.precision (9); // distinguishes all numbers in single precision
  const Eigen::Vector3d at = points.inCloud (p);
  text << "point " << points.cloud_index[p] << " (" << at.x () << ", " << at.y () << ", " << at.z ()
       << ")";
  return text.str ();
}

std::string
rounded (double value)
{
  std::ostringstream text;
  text.precision (3);
  text << value;
  return text.str ();
}

std::string
counted (std::size_t count, const char* one, const char* several)
{
  return std::to_string (count) + " " + (count == 1 ? one : several);
}

std::string
oneAt (std::size_t count, const std::string& place)
{
  return (count == 1 ? " at " : ", one of them at ") + place;
}

} // namespace pcl::floater
