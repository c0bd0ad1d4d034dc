// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A point type of PCL's own: the library holds the class for it.
#include "height_field.h"

#include <pcl/point_types.h>

int
main ()
{
  pcl::PolygonMesh mesh;
  return reconstructHeightField (*makeHeightField<pcl::PointXYZ> (), mesh);
}
