// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"
#include "text_scanner.h"

#include <map>
#include <set>
#include <sstream>

namespace pcl::floater {
namespace {
std::size_t
coordinateField (const std::vector<Field>& fields, const std::string& name)
{
  auto found = fields.end ();
  for (const char letter : {name[0], static_cast<char> (name[0] - 'a' + 'A')})
    if (found == fields.end ())
      found = std::find_if (fields.begin (), fields.end (), [letter] (const Field& field) {
        return field.name == std::string (1, letter);
      });
  if (found == fields.end ()) {
    std::string names;
    for (const Field& field : fields)
      names += (names.empty () ? "" : ", ") + field.name;
    throw ReadError ("the points have no coordinate '" + name +
                     "' (fields of the file: " + (names.empty () ? "none" : names) + ")");
  }
  if (found->count != 1)
    throw ReadError ("the coordinate '" + name + "' has more than one value for each point");
  if (found->type == ScalarType::INT64 || found->type == ScalarType::UINT64)
    throw ReadError ("the coordinate '" + name +
                     "' is a 64-bit integer, which a double cannot hold; convert it to double");
  return static_cast<std::size_t> (found - fields.begin ());
}

/// A byte of the numbers of a field, as a field of this name.
/// \param place from the lowest byte
Field
byteOf (const Field& field, std::size_t place, const std::string& name)
{
  const std::size_t at = field.order == ByteOrder::little ? place : sizeOf (field.type) - 1 - place;
  return {name, ScalarType::UINT8, 1, {field.first, field.first.get () + at}, field.stride};
}

/// A name for the second and each further field of the same name, or of that of a coordinate.
void
renameRepeated (Cloud& cloud)
{
  std::set<std::string> names{"x", "y", "z"};
  for (const Field& field : cloud.fields)
    names.insert (field.name);
  std::map<std::string, std::size_t> numbers{{"x", 1}, {"y", 1}, {"z", 1}}; // the last of each name
  std::vector<std::string> warnings;
  for (Field& field : cloud.fields) {
    std::size_t& number = numbers[field.name];
    if (++number == 1)
      continue;
    std::string name = field.name + "_" + std::to_string (number);
    while (!names.insert (name).second)
      name = field.name + "_" + std::to_string (++number);
    warnings.push_back ("there are two fields '" + field.name + "': the second was renamed '" +
                        name + "'");
    field.name = name;
  }
  constexpr std::size_t FEW = 3;
  if (warnings.size () > FEW)
    warnings = {warnings.front () + ", and " + counted (warnings.size () - 1, "other field") +
                " alike"};
  cloud.warnings.insert (cloud.warnings.end (), warnings.begin (), warnings.end ());
}

/// The channels red, green and blue, and alpha if there is one, by the names that programs give
/// them; empty if there is no colour.
std::vector<Field*>
findChannels (Cloud& cloud)
{
  constexpr std::array<std::array<const char*, 4>, 3> NAMES{
      {{"red", "green", "blue", "alpha"},
       {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"},
       {"r", "g", "b", "a"}}};
  for (const auto& names : NAMES) {
    std::vector<Field*> channels;
    for (std::size_t c = 0; c < names.size () && channels.size () == c; ++c)
      for (Field& field : cloud.fields)
        if (isWord (field.name, names[c]) && field.count == 1 &&
            (c == 0 || field.type == channels[0]->type)) {
          channels.push_back (&field);
          break;
        }
    if (channels.size () < 3)
      continue;
    for (std::size_t c = 0; c < channels.size (); ++c)
      channels[c]->name = NAMES[0][c];
    return channels;
  }
  return {};
}

/// Makes a colour one of 8 bits: that is what viewers and the formats of meshes take. Its scale is
/// that of its largest value: 1 for floats, 255, or 65535.
void
narrowColors (Cloud& cloud)
{
  constexpr double BYTE = 255.0, WORD = 65535.0;
  const std::vector<Field*> channels = findChannels (cloud);
  if (channels.empty () || channels[0]->type == ScalarType::UINT8)
    return;
  double least = 0.0, largest = 0.0;
  for (const Field* channel : channels)
    for (std::size_t row = 0; row < cloud.rows; ++row) {
      const double value = channel->asDouble (row);
      least = std::min (least, value);
      largest = std::max (largest, value);
    }
  const bool are_floats = channels[0]->type >= ScalarType::FLOAT32;
  if (least < 0.0 || largest > WORD) {
    cloud.warnings.emplace_back ("the colours of the input file are neither from 0 to 255 nor from "
                                 "0 to 1: they were kept as other fields are");
    return;
  }
  if (channels[0]->type == ScalarType::UINT16) { // one of its two bytes
    for (Field* channel : channels)
      *channel = byteOf (*channel, largest > BYTE ? 1 : 0, channel->name);
    return;
  }
  if (largest > BYTE)
    cloud.warnings.emplace_back ("the colours of the input file are above 255: they were taken for "
                                 "16 bits, and 8 of them kept");
  const double white = are_floats && largest <= 1.0 ? 1.0 : largest <= BYTE ? BYTE : WORD;
  std::vector<Field> given;
  for (Field* channel : channels) {
    given.push_back (*channel);
    channel->type = ScalarType::UINT8;
  }
  char* to = allocateRows (channels, cloud.rows).get (); // which the fields keep
  for (std::size_t row = 0; row < cloud.rows; ++row)
    for (const Field& channel : given) {
      const double value = channel.asDouble (row);
      *to++ = static_cast<char> (
          static_cast<std::uint8_t> (std::isnan (value) ? 0 : std::lround (BYTE / white * value)));
    }
}

/// Leaves out the points of other classes than those, by the field `classification`; by default,
/// those of low and high noise (7 and 18) of LAS. Always those of the field `withheld`.
/// \throws ReadError if there are no classes, or no such points
void
chooseClasses (Cloud& cloud, const std::vector<int>& classes)
{
  constexpr double LOW_NOISE = 7.0, HIGH_NOISE = 18.0;
  const auto find = [&cloud] (const char* name) -> const Field* {
    for (const Field& field : cloud.fields)
      if (isWord (field.name, name) && field.count == 1)
        return &field;
    return nullptr;
  };
  const Field* const classification = find ("classification");
  const Field* const withheld = find ("withheld");
  if (classification == nullptr && !classes.empty ())
    throw ReadError ("--classes: the points have no field 'classification'");
  if (classes.empty () && withheld == nullptr)
    return;
  std::vector<bool> others (cloud.rows, false), are_withheld (cloud.rows, false);
  std::map<double, std::size_t> counts; // of classes that are left out
  for (std::size_t row = 0; row < cloud.rows; ++row) {
    are_withheld[row] = withheld != nullptr && withheld->asDouble (row) != 0.0;
    const double its = classification == nullptr ? 0.0 : classification->asDouble (row);
    others[row] =
        !are_withheld[row] &&
        (classes.empty () ? (its == LOW_NOISE || its == HIGH_NOISE)
                          : std::find (classes.begin (), classes.end (), its) == classes.end ());
    if (others[row])
      ++counts[its];
  }
  leaveOut (cloud, are_withheld, "that the file marks as withheld");
  constexpr std::size_t MOST = 12; // classes in the note
  std::ostringstream text;
  text << "of class";
  std::size_t told = 0;
  for (const auto& [its, count] : counts)
    if (told++ < MOST)
      text << (told == 1 ? " " : ", ") << its << " (" << count << ")";
  text << (counts.size () > MOST ? " and others" : "");
  leaveOut (cloud, others, text.str ());
  if (std::count (cloud.left_out.begin (), cloud.left_out.end (), true) ==
      static_cast<std::ptrdiff_t> (cloud.rows))
    throw ReadError ("none of its points is of the classes that are taken: --classes chooses them");
}

} // namespace

Cloud
makeCloud (std::vector<Field> fields, std::size_t size, std::vector<std::string> warnings)
{
  if (size == 0)
    throw ReadError ("it has no points");
  if (size > static_cast<std::size_t> (std::numeric_limits<std::int32_t>::max ()))
    throw ReadError ("it has more points than a mesh file can number (2147483647); split it");
  const std::array<std::size_t, 3> columns{
      coordinateField (fields, "x"), coordinateField (fields, "y"), coordinateField (fields, "z")};
  Cloud cloud;
  cloud.rows = size;
  cloud.warnings = std::move (warnings);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cloud.coordinates[axis] = fields[columns[axis]];
    cloud.single_precision &= fields[columns[axis]].type == ScalarType::FLOAT32;
  }
  // PCL packs a colour into the 32 bits of one number, from the highest: alpha, red, green, blue.
  const std::array<std::pair<const char*, std::size_t>, 4> channels{
      {{"red", 2}, {"green", 1}, {"blue", 0}, {"alpha", 3}}};
  bool has_packed_color = false;
  for (std::size_t f = 0; f < fields.size (); ++f) {
    if (std::find (columns.begin (), columns.end (), f) != columns.end ())
      continue;
    const bool is_rgb = fields[f].name == "rgb" || fields[f].name == "rgba";
    if (is_rgb && fields[f].pointBytes () == sizeof (std::uint32_t) && fields[f].count == 1) {
      if (has_packed_color)
        cloud.warnings.push_back ("the points have their colour twice: the field '" +
                                  fields[f].name + "' was left out");
      for (const auto& [channel, place] : channels)
        if (!has_packed_color && (place < 3 || fields[f].name == "rgba"))
          cloud.fields.push_back (byteOf (fields[f], place, channel));
      has_packed_color = true;
      continue;
    }
    std::string& name = cloud.fields.emplace_back (std::move (fields[f])).name;
    if (name == "normal_x" || name == "normal_y" || name == "normal_z")
      name = std::string ("n") + name.back ();
  }
  renameRepeated (cloud);
  narrowColors (cloud);
  return cloud;
}

std::string
Cloud::shiftText () const
{
  std::string text;
  if (shift.isZero (0.0))
    return text;
  for (const double value : shift) {
    constexpr std::size_t LONGEST = 512; // 1e-308 in full
    std::array<char, LONGEST> digits{};
    const auto end = std::to_chars (digits.data (), digits.data () + digits.size (), value,
                                    std::chars_format::fixed)
                         .ptr;
    text += (text.empty () ? "" : " ") + std::string (digits.data (), end);
  }
  return text;
}

std::size_t
removeNonFinitePoints (Cloud& cloud, Triangles& triangles)
{
  static constexpr std::uint32_t REMOVED = std::numeric_limits<std::uint32_t>::max ();
  std::size_t not_finite = 0;
  std::vector<std::uint32_t> kept, numbers (cloud.rows, REMOVED);
  for (std::uint32_t row = 0; row < cloud.rows; ++row)
    if (cloud.isLeftOut (row))
      continue;
    else if (!cloud.positionOfRow (row).allFinite ())
      ++not_finite;
    else {
      numbers[row] = static_cast<std::uint32_t> (kept.size ());
      kept.push_back (row);
    }
  if (kept.size () == cloud.rows)
    return 0;
  cloud.kept = std::move (kept);
  for (auto& triangle : triangles)
    for (std::uint32_t& corner : triangle)
      corner = numbers[corner];
  boost::remove_erase_if (triangles, [] (const auto& triangle) {
    return std::find (triangle.begin (), triangle.end (), REMOVED) != triangle.end ();
  });
  return not_finite;
}

Cloud
copyRows (const Cloud& cloud, const std::vector<std::size_t>& rows)
{
  Cloud copied = cloud;
  copied.kept.clear ();
  copied.rows = rows.size ();
  for (Field* field : allFields (copied)) {
    const Field from = *field;
    char* to = allocateRows ({field}, rows.size ()).get (); // which the field keeps
    field->order = from.order;
    for (const std::size_t row : rows)
      to = std::copy_n (from.first.get () + row * from.stride, field->stride, to);
  }
  return copied;
}

Cloud
readCloud (const std::filesystem::path& path, const ReadOptions& options, CloudFormat format)
{
  if (format == nullptr)
    format = requireCloudFormat (path);
  const FileBytes file (path);
  if (file.view ().empty ())
    throw ReadError (isStandardStream (path) ? "nothing came from the standard input"
                                             : "the file is empty");
  if (options.columns[0] > 0 && format != parseXyz && format != parsePts)
    throw ReadError ("--columns is for text with a point in each line");
  Cloud cloud = format (file, options);
  const std::string_view bytes = file.view ();
  if (const char* const x = cloud.coordinates[0].first.get ();
      x >= bytes.data () && x < bytes.data () + bytes.size ())
    cloud.file = file;
  chooseClasses (cloud, options.classes);
  return cloud;
}

} // namespace pcl::floater
