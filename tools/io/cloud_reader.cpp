// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"

#include "text_scanner.h"

#include <map>
#include <sstream>

namespace pcl::floater {
namespace {
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
