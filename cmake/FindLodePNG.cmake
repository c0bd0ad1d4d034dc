# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
include (find_library_alone)
find_library_alone (LodePNG lodepng.h lodepng)
