// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing any more: to be removed with its inclusion in texture/test_texture_coordinates.cpp.
