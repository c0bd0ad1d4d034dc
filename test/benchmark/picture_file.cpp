// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture_file.h"

#include "picture_files.h"

#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>

namespace pcl
{
namespace floater
{
std::vector<unsigned char>
toPng (const GreyImage& image)
{
  vtkNew<vtkImageData> data;
  data->SetDimensions (image.width, image.height, 1);
  data->AllocateScalars (VTK_UNSIGNED_CHAR, 1);
  auto* to = static_cast<unsigned char*> (data->GetScalarPointer ());
  // VTK's rows begin at the bottom.
  for (int y = image.height - 1; y >= 0; --y, to += image.width)
    std::copy_n (image.pixels.data () + static_cast<std::ptrdiff_t> (y) * image.width, image.width,
                 to);
  return toPng (data);
}

} // namespace floater
} // namespace pcl
