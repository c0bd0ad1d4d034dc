// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One run of one method in a process of its own: what it took, as a row of CSV.
#pragma once

#include "cloud.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
struct StageTime
{
  std::string name;
  double seconds = 0.0; ///< wall time
};

/// A way from points to triangles.
class Method
{
public:
  virtual ~Method () = default;

  /// Puts the points into the form that the method takes. Not measured.
  virtual void prepare (const std::vector<Eigen::Vector3d>& points) = 0;

  /// All of the way from the points to the triangles. Measured.
  /// \throw std::runtime_error if there is no mesh
  virtual void run () = 0;

  /// What the run made, as indices of points. Not measured.
  virtual Triangles triangles () const = 0;

  /// Parts of the run in order; none if they are not known.
  virtual std::vector<StageTime> stages () const { return {}; }
};

/// \param name one of those given to runMethod
/// \param threads as many where the method has threads; 0: one for each core
using MakeMethod = std::function<std::unique_ptr<Method> (const std::string& name, int threads)>;

/// The whole program: reads the command line, runs a method on the finite points of a file, and
/// prints what it took. \return exit code; not 0 if there is no row
int
runMethod (int argc, char** argv, const std::vector<std::string>& names, const MakeMethod& make);

} // namespace floater
} // namespace pcl
