// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a cloud that are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl::floater {
/// A subset of the rows of a file, renumbered from 0. Takes a fifth of a byte per row, and no
/// memory if all rows are kept.
class KeptPoints
{
public:
  /// All rows.
  KeptPoints () = default;

  /// The rows for which keep (row) is true.
  template <typename Keep>
  KeptPoints (std::size_t rows, const Keep& keep)
  {
    std::vector<Word> words ((rows + WORD_ROWS - 1) / WORD_ROWS);
    for (std::size_t row = 0; row < rows; ++row) {
      Word& word = words[row / WORD_ROWS];
      if (row % WORD_ROWS == 0)
        word.before = static_cast<std::uint32_t> (kept_);
      if (keep (row)) {
        word.bits |= std::uint64_t{1} << row % WORD_ROWS;
        ++kept_;
      }
    }
    if (kept_ < rows)
      words_ = std::move (words);
  }

  bool areAll () const { return words_.empty (); }

  /// Number of rows that are kept, unless all are.
  std::size_t size () const { return kept_; }

  /// The new number of a row that is kept.
  std::uint32_t number (std::uint32_t row) const
  {
    if (areAll ())
      return row;
    const Word& word = words_[row / WORD_ROWS];
    const std::uint64_t below = (std::uint64_t{1} << row % WORD_ROWS) - 1;
    return word.before + static_cast<std::uint32_t> (__builtin_popcountll (word.bits & below));
  }

  /// The row of a new number; 0 if it is not below size (). O(log rows) if not all rows are kept.
  std::size_t row (std::size_t number) const
  {
    if (areAll ())
      return number;
    std::size_t first = 0;
    for (std::size_t last = words_.size (); last - first > 1;) {
      const std::size_t middle = first + (last - first) / 2;
      (words_[middle].before <= number ? first : last) = middle;
    }
    std::uint64_t bits = words_[first].bits;
    for (std::size_t i = words_[first].before; i < number; ++i)
      bits &= bits - 1; // clears the lowest bit
    if (bits == 0)
      return 0; // beyond size ()
    return first * WORD_ROWS + static_cast<std::size_t> (__builtin_ctzll (bits));
  }

private:
  static constexpr std::size_t WORD_ROWS = 64;

  struct Word
  {
    std::uint64_t bits = 0;   // kept rows
    std::uint32_t before = 0; // number of kept rows in the words before
  };

  std::vector<Word> words_;
  std::size_t kept_ = 0;
};

} // namespace pcl::floater
