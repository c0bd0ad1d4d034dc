# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Finds xxHash (Debian ships no CMake config for it) and makes the target XXHASH::XXHASH.
find_path (XXHASH_INCLUDE_DIR NAMES xxhash.h)
find_library (XXHASH_LIBRARY NAMES xxhash)
include (FindPackageHandleStandardArgs)
find_package_handle_standard_args (XXHASH REQUIRED_VARS XXHASH_LIBRARY XXHASH_INCLUDE_DIR)
if (XXHASH_FOUND AND NOT TARGET XXHASH::XXHASH)
  add_library (XXHASH::XXHASH UNKNOWN IMPORTED)
  set_target_properties (XXHASH::XXHASH PROPERTIES
    IMPORTED_LOCATION "${XXHASH_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${XXHASH_INCLUDE_DIR}")
endif ()
mark_as_advanced (XXHASH_INCLUDE_DIR XXHASH_LIBRARY)
