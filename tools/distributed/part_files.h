// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is written of a part.
#pragma once

#include "parts/part_finish.h"
#include "parts/part_mesh.h"
#include "store.h"

#include <deque>
#include <vector>

namespace pcl::floater {
/// Arrays of a part for a file. All that is added must outlive this.
class PartWriter
{
public:
  ArrayWriter& arrays () { return arrays_; }

  void addTriangles (const std::string& name, const std::vector<Triangle>& triangles);
  void addRim (const PartRim& rim);
  void addFinished (const FinishedPart& part);
  void addChanges (const std::vector<PartChange>& changes);

  /// Lists of marks, one behind the other.
  void addMarks (const std::string& name, const std::vector<std::vector<std::uint8_t>>& lists);

private:
  template <typename T>
  std::vector<T>& keep ();

  void addCheck (const InnerCheck& check);
  void addSurroundings (const Surroundings& around);

  ArrayWriter arrays_;
  // Arrays that are made for the file, where they stay.
  std::deque<std::vector<Index>> indices_;
  std::deque<std::vector<Triangle>> triangles_;
  std::deque<std::vector<std::uint64_t>> counts_;
  std::deque<std::vector<double>> numbers_;
  std::deque<std::vector<std::uint8_t>> marks_;
  std::vector<float> ratios_;
};

std::vector<Triangle>
readTriangles (ArrayFile& file, const std::string& name);

PartRim
readRim (ArrayFile& file);

std::vector<Triangle>
readTriangles (ArrayFile& file, const std::string& name, std::size_t first, std::size_t last);

/// Lists of marks.
std::vector<std::vector<std::uint8_t>>
readMarks (ArrayFile& file, const std::string& name);

/// Without the inner triangles and their buckets.
FinishedPart
readFinished (ArrayFile& file);

PartChange
readChange (ArrayFile& file, std::size_t part);

} // namespace pcl::floater
