// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"
#include "text_scanner.h"

#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
template <typename T>
Field
makeField (const char* name, ScalarType type, const std::vector<T>& values, std::size_t stride,
           std::size_t first)
{
  Field field{name, type};
  field.bytes.resize (values.size () / stride * sizeof (T));
  for (std::size_t i = first, at = 0; i < values.size (); i += stride, at += sizeof (T))
    std::memcpy (field.bytes.data () + at, &values[i], sizeof (T));
  return field;
}

std::uint8_t
colorByte (const TextScanner& scanner, double channel)
{
  if (!(channel >= 0.0 && channel <= 1.0))
    scanner.fail ("a colour must be from 0 to 1");
  return static_cast<std::uint8_t> (std::lround (255.0 * channel));
}

/// Numbers in the rest of the line.
std::size_t
readNumbers (TextScanner& scanner, std::array<double, 6>& numbers)
{
  std::size_t count = 0;
  for (std::string_view word = scanner.word (); !word.empty (); word = scanner.word ()) {
    if (count == numbers.size ())
      scanner.fail ("it has more than " + std::to_string (numbers.size ()) + " numbers");
    if (!parseNumber (word, numbers[count++]))
      scanner.fail ("'" + std::string (word) + "' is not a number");
  }
  return count;
}

} // namespace

Cloud
parseObj (std::string_view bytes)
{
  constexpr std::size_t WITH_COLOR = 6;
  std::vector<double> coordinates;
  std::vector<double> normals;
  std::vector<std::uint8_t> colors;
  std::array<double, WITH_COLOR> numbers{};
  TextScanner scanner (bytes);
  while (scanner.nextLine ()) {
    const std::string_view key = scanner.word ();
    if (key == "v") {
      const std::size_t count = readNumbers (scanner, numbers);
      if (count != 3 && count != 4 && count != WITH_COLOR)
        scanner.fail ("a point has 3, 4 or 6 numbers, not " + std::to_string (count));
      coordinates.insert (coordinates.end (), numbers.begin (), numbers.begin () + 3);
      if (count == WITH_COLOR)
        for (std::size_t i = 3; i < WITH_COLOR; ++i)
          colors.push_back (colorByte (scanner, numbers[i]));
    }
    else if (key == "vn") {
      if (readNumbers (scanner, numbers) != 3)
        scanner.fail ("a normal has 3 numbers");
      normals.insert (normals.end (), numbers.begin (), numbers.begin () + 3);
    }
  }
  std::vector<Field> fields;
  const auto add = [&fields] (const auto& values, ScalarType type,
                              const std::array<const char*, 3>& names) {
    for (std::size_t i = 0; i < 3; ++i)
      fields.push_back (makeField (names[i], type, values, 3, i));
  };
  add (coordinates, ScalarType::FLOAT64, {"x", "y", "z"});
  std::vector<std::string> warnings;
  if (colors.size () == coordinates.size ())
    add (colors, ScalarType::UINT8, {"red", "green", "blue"});
  else if (!colors.empty ())
    warnings.emplace_back ("not all points have a colour; colours were left out");
  if (normals.size () == coordinates.size ())
    add (normals, ScalarType::FLOAT64, {"nx", "ny", "nz"});
  Cloud cloud = makeCloud (std::move (fields), coordinates.size () / 3);
  cloud.warnings = std::move (warnings);
  return cloud;
}

} // namespace floater
} // namespace pcl
