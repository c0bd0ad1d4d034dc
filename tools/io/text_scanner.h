// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Words and numbers of a text, line by line.
#pragma once

#include "cloud.h"

#include <charconv>
#include <cstdlib>
#include <system_error>

namespace pcl::floater {
/// Parses a whole word as a number. Unlike streams it knows nan and inf and does not depend on the
/// locale. Numbers beyond the range of a floating-point type become infinite or zero.
/// \return false if the word is not a number, or out of the range of an integer type
template <typename T>
bool
parseNumber (std::string_view word, T& number)
{
  if (word.size () > 1 && word.front () == '+' && word[1] != '-')
    word.remove_prefix (1);
  const auto [rest, error] = std::from_chars (word.data (), word.data () + word.size (), number);
  if (rest != word.data () + word.size ())
    return false;
  if (error == std::errc{})
    return true;
  if constexpr (std::is_floating_point_v<T>)
    if (error == std::errc::result_out_of_range) {
      number = static_cast<T> (std::strtod (std::string (word).c_str (), nullptr));
      return true;
    }
  return false;
}

/// Whether two words are equal in upper or lower case.
inline bool
isWord (std::string_view a, std::string_view b)
{
  return std::equal (a.begin (), a.end (), b.begin (), b.end (),
                     [] (char x, char y) { return lowerCase (x) == lowerCase (y); });
}

/// The beginning of a word or a line in a message, without what is not printable.
inline std::string
quoted (std::string_view line, std::size_t characters = 40)
{
  std::string text;
  for (const char c : line.substr (0, characters))
    text += c >= ' ' && c <= '~' ? c : '?';
  return "'" + text + (line.size () > characters ? "..." : "") + "'";
}

/// Scans a text. Lines end with \n or \r\n, or with \r in a text without \n; words are separated by
/// blanks and tabs. The mark that some programs put before UTF-8 is skipped.
class TextScanner
{
public:
  static bool isBlank (char c)
  {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
  }

  /// \param text must outlive the scanner
  explicit TextScanner (std::string_view text)
      : text_ (text), newline_ (text.find ('\n') == std::string_view::npos ? '\r' : '\n')
  {
    constexpr std::string_view MARK = "\xef\xbb\xbf";
    if (text.substr (0, MARK.size ()) == MARK)
      next_ = MARK.size ();
  }

  /// Goes to the next line.
  /// \return false at the end of the text
  bool nextLine ()
  {
    if (next_ >= text_.size ())
      return false;
    at_ = next_;
    end_ = std::min (text_.find (newline_, at_), text_.size ());
    next_ = std::min (end_ + 1, text_.size ());
    ++line_;
    return true;
  }

  /// Goes to the next line with a word in it.
  /// \return false at the end of the text
  bool nextFilledLine ()
  {
    while (nextLine ())
      if (hasWord ())
        return true;
    return false;
  }

  /// Goes to the next word of the line, if there is one.
  bool hasWord ()
  {
    while (at_ < end_ && isBlank (text_[at_]))
      ++at_;
    return at_ < end_;
  }

  /// Reads the next word of the line; empty at its end.
  std::string_view word ()
  {
    hasWord ();
    const std::size_t first = at_;
    while (at_ < end_ && !isBlank (text_[at_]))
      ++at_;
    return text_.substr (first, at_ - first);
  }

  std::string_view restOfLine ()
  {
    const std::size_t first = at_;
    at_ = end_;
    return text_.substr (first, end_ - first);
  }

  char newline () const { return newline_; }

  /// The rest of the line and the text after it.
  std::string_view restWithLine () const { return text_.substr (at_); }

  /// The text after the line.
  std::string_view rest () const { return text_.substr (next_); }

  /// Throws a ReadError that names the line.
  [[noreturn]] void fail (const std::string& cause) const
  {
    throw ReadError ("line " + std::to_string (line_) + ": " + cause);
  }

  /// Reads the next word of the line as a number.
  /// \throws ReadError if it is not a number of this type, or the line has ended
  template <typename T>
  T number ()
  {
    T result;
    const std::string_view text = word ();
    if (parseNumber (text, result))
      return result;
    fail (text.empty () ? "it has fewer values than it must have"
                        : quoted (text) + " is not a number of the right type");
  }

private:
  std::string_view text_;
  char newline_;
  std::size_t at_ = 0;   // next character
  std::size_t end_ = 0;  // end of the line
  std::size_t next_ = 0; // start of the next line
  std::size_t line_ = 0; // number of the line, from 1
};

} // namespace pcl::floater
