// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>
#include <pcl/surface/impl/floater_reconstruction.hpp>

PCL_INSTANTIATE (FloaterReconstruction, PCL_XYZ_POINT_TYPES)
