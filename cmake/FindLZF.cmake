# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Finds liblzf (Debian ships no CMake config for it) and makes the target LZF::LZF.
find_path (LZF_INCLUDE_DIR NAMES lzf.h PATH_SUFFIXES liblzf)
find_library (LZF_LIBRARY NAMES lzf)
include (FindPackageHandleStandardArgs)
find_package_handle_standard_args (LZF REQUIRED_VARS LZF_LIBRARY LZF_INCLUDE_DIR)
if (LZF_FOUND AND NOT TARGET LZF::LZF)
  add_library (LZF::LZF UNKNOWN IMPORTED)
  set_target_properties (LZF::LZF PROPERTIES
    IMPORTED_LOCATION "${LZF_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${LZF_INCLUDE_DIR}")
endif ()
mark_as_advanced (LZF_INCLUDE_DIR LZF_LIBRARY)
