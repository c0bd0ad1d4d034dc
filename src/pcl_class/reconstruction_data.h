// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Members of ReconstructionState (pimpl).
#pragma once

#include <pcl/surface/floater/reconstruction_state.h>

#include "core/types.h"

namespace pcl::floater {
struct ReconstructionState::Data
{
  Options options;
  pcl::Indices prescribed_loop; // as given: may exceed the index type of the core
  bool use_input_normals = false;
  bool compute_normals = false;
  bool computes_texture = false;
  double largest_stretch = TextureOptions ().largest_stretch;
  Report report;
  struct
  {
    TextureCoordinates texture;
    std::vector<int> parts;          // of each point; empty if there is no mesh
    std::vector<std::int8_t> states; // PointState of each point; empty if there is no mesh
    Normals normals;                 // of each point; empty if not asked for
  } mesh;
};

} // namespace pcl::floater
