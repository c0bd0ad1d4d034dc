# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
set (PACKAGE_VERSION 1.99.0)
set (PACKAGE_VERSION_COMPATIBLE TRUE)
