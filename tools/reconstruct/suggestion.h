// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a mistyped word may have meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pcl::floater {
/// Number of letters to insert, drop or replace, or of neighbours to swap, to make one word of the
/// other; the case of letters does not count. O(product of the lengths).
std::size_t
editDistance (std::string_view a, std::string_view b);

/// The words that `word` is nearest to, if it is near to any: those that it begins, or else those
/// at the least distance, of at most a third of the letters.
std::vector<std::string>
nearestWords (std::string_view word, const std::vector<std::string>& words);

/// "; did you mean a or b?", or nothing if no word is near.
std::string
didYouMean (std::string_view word, const std::vector<std::string>& words);

} // namespace pcl::floater
