# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
include (FindPackageHandleStandardArgs)

# find_library_alone (<name> <header> <library> [PATH_SUFFIXES <folder>])
# Finds a library for which Debian ships no CMake config, and makes the target <name>::<name>.
macro (find_library_alone name header library)
  find_path (${name}_INCLUDE_DIR NAMES ${header} ${ARGN})
  find_library (${name}_LIBRARY NAMES ${library})
  find_package_handle_standard_args (${name} REQUIRED_VARS ${name}_LIBRARY ${name}_INCLUDE_DIR)
  if (${name}_FOUND AND NOT TARGET ${name}::${name})
    add_library (${name}::${name} UNKNOWN IMPORTED)
    set_target_properties (${name}::${name} PROPERTIES
      IMPORTED_LOCATION "${${name}_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${${name}_INCLUDE_DIR}")
  endif ()
  mark_as_advanced (${name}_INCLUDE_DIR ${name}_LIBRARY)
endmacro ()
