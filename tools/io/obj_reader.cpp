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
/// Appends three fields that share an array of three values per point.
template <typename T>
void
addFields (std::vector<T>&& values, ScalarType type, const std::array<const char*, 3>& names,
           std::vector<Field>& fields)
{
  const auto kept = std::make_shared<const std::vector<T>> (std::move (values));
  for (std::size_t i = 0; i < 3; ++i) {
    Field field{names[i], type};
    field.first = {kept, reinterpret_cast<const char*> (kept->data () + i)};
    field.stride = 3 * sizeof (T);
    fields.push_back (std::move (field));
  }
}

std::uint8_t
colorByte (const TextScanner& scanner, double channel)
{
  if (!(channel >= 0.0 && channel <= 1.0))
    scanner.fail ("a colour must be from 0 to 1");
  return static_cast<std::uint8_t> (std::lround (255.0 * channel));
}

/// Reads the numbers in the rest of the line. \return how many
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
parseObj (const FileBytes& file)
{
  constexpr std::size_t WITH_COLOR = 6;
  std::vector<double> coordinates;
  std::vector<double> normals;
  std::vector<std::uint8_t> colors;
  std::array<double, WITH_COLOR> numbers{};
  TextScanner scanner (file.view ());
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
  if (coordinates.empty ())
    throw ReadError ("it has no points");
  const std::size_t size = coordinates.size () / 3;
  std::vector<Field> fields;
  std::vector<std::string> warnings;
  addFields (std::move (coordinates), ScalarType::FLOAT64, {"x", "y", "z"}, fields);
  if (colors.size () == 3 * size)
    addFields (std::move (colors), ScalarType::UINT8, {"red", "green", "blue"}, fields);
  else if (!colors.empty ())
    warnings.emplace_back ("not all points have a colour; colours were left out");
  if (normals.size () == 3 * size)
    addFields (std::move (normals), ScalarType::FLOAT64, {"nx", "ny", "nz"}, fields);
  Cloud cloud = makeCloud (std::move (fields), size);
  cloud.warnings = std::move (warnings);
  return cloud;
}

} // namespace floater
} // namespace pcl
