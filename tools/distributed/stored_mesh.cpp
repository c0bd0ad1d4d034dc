// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stored_mesh.h"

#include "core/parallel.h"
#include "part_files.h"
#include "stored_cloud.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// The inner triangles of a part, as the mesh has them.
std::vector<Triangle>
readPart (const StepContext& context, const Parts& parts, std::size_t part,
          const std::vector<std::uint8_t>& is_turned)
{
  ArrayFile file = openArrays (context.store, blockFile (FINISH, part), context.plan);
  std::vector<Triangle> triangles = readTriangles (file, "triangles");
  const Index first = parts.first (part), last = parts.last (part);
  turnInner (triangles, is_turned, first, last - first, context.run.withThreads (1));
  const std::vector<Index> cloud_index =
      openArrays (context.store, pointsLeft (readOutliers (context)), context.plan)
          .read<Index> ("cloud_index", first, last);
  for (Triangle& corners : triangles)
    for (Index& p : corners)
      p = cloud_index[p - first];
  return triangles;
}

} // namespace

void
putMesh (FolderStore& folder, const Plan& plan, const FinishedMesh& mesh)
{
  PartWriter writer;
  const std::vector<std::uint8_t> marks{static_cast<std::uint8_t> (mesh.is_single ? 1 : 0),
                                        static_cast<std::uint8_t> (mesh.are_blocks_freed ? 1 : 0),
                                        static_cast<std::uint8_t> (mesh.parts ? 1 : 0)};
  writer.arrays ().add ("marks", marks);
  writer.addTriangles ("triangles", mesh.parts ? mesh.parts->seam : mesh.triangles);
  const std::vector<std::vector<std::uint8_t>> none;
  writer.addMarks ("turned", mesh.parts ? mesh.parts->is_turned : none);
  folder.put (TRIANGLES, writer.arrays (), plan.id);
}

bool
isMeshKnown (const StepContext& context, FolderStore& folder)
{
  if (!folder.has (TRIANGLES))
    return false;
  ArrayFile file = openArrays (folder, TRIANGLES, context.plan);
  file.verify ();
  for (std::size_t part = 0; part < file.count ("turned.ends"); ++part) {
    if (!folder.has (blockFile (FINISH, part)))
      return false;
    openArrays (folder, blockFile (FINISH, part), context.plan).verify ();
  }
  return true;
}

bool
areBlocksFreed (FolderStore& folder, const Plan& plan)
{
  return folder.has (TRIANGLES) &&
         openArrays (folder, TRIANGLES, plan).read<std::uint8_t> ("marks")[1] != 0;
}

FinishedMesh
readMesh (const StepContext& context)
{
  ArrayFile file = openArrays (context.store, TRIANGLES, context.plan);
  const std::vector<std::uint8_t> marks = file.read<std::uint8_t> ("marks");
  FinishedMesh mesh;
  mesh.is_single = marks[0] != 0;
  mesh.are_blocks_freed = marks[1] != 0;
  if (marks[2] == 0) {
    mesh.triangles = readTriangles (file, "triangles");
    return mesh;
  }
  const Parts parts = partsOf (context);
  std::vector<std::size_t> begins (1, 0);
  for (std::size_t part = 0; part < parts.count (); ++part)
    begins.push_back (
        begins.back () +
        openArrays (context.store, blockFile (FINISH, part), context.plan).count ("triangles") / 3);
  const std::vector<Triangle> seam = readTriangles (file, "triangles");
  const std::vector<std::vector<std::uint8_t>> is_turned = readMarks (file, "turned");
  mesh.triangles.resize (begins.back () + seam.size ());
  parallelTasks (context.run, parts.count (), [&] (std::size_t part) {
    const std::vector<Triangle> triangles = readPart (context, parts, part, is_turned[part]);
    std::copy (triangles.begin (), triangles.end (),
               mesh.triangles.begin () + static_cast<std::ptrdiff_t> (begins[part]));
  });
  std::copy (seam.begin (), seam.end (),
             mesh.triangles.begin () + static_cast<std::ptrdiff_t> (begins.back ()));
  return mesh;
}

} // namespace pcl::floater
