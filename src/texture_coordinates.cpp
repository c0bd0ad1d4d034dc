// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The entry point of the texture coordinates: exceptions and callbacks.
#include "problem_of_exception.h"
#include "texture/texture_method.h"

#include <new>
#include <utility>

namespace pcl::floater {
TextureCoordinates
computeTextureCoordinates (const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<Triangle>& triangles, const TextureOptions& options)
{
  TextureCoordinates result;
  Problem problem;
  try {
    Statistics times;
    RunMonitor monitor ({{}, options.progress_callback, options.cancelled_callback}, times);
    const RunContext run (options.threads, &monitor);
    run.beginStage (Stage::CHECK); // the last stage takes the rest of the progress, here all of it
    problem = makeTextureCoordinates (positions, triangles, options, {}, run, result);
    if (!problem)
      monitor.finish ();
  }
  catch (...) {
    problem = problemOfException ();
  }
  if (problem)
    result = {};
  result.status = problem.status;
  result.message = std::move (problem.message);
  return result;
}

} // namespace pcl::floater
