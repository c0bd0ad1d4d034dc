# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Stands for a PCL of another minor version.
set (PCL_FOUND TRUE)
