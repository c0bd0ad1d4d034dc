# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the sequential SuperLU (Debian 12 ships pkg-config data only) and makes the target
# SuperLU::SuperLU.
find_package (PkgConfig QUIET)
if (PKG_CONFIG_FOUND)
  pkg_check_modules (PC_SUPERLU QUIET superlu)
endif ()
find_path (SUPERLU_INCLUDE_DIR NAMES slu_ddefs.h HINTS ${PC_SUPERLU_INCLUDE_DIRS} PATH_SUFFIXES superlu)
find_library (SUPERLU_LIBRARY NAMES superlu HINTS ${PC_SUPERLU_LIBRARY_DIRS})
set (SUPERLU_VERSION "${PC_SUPERLU_VERSION}")
include (FindPackageHandleStandardArgs)
find_package_handle_standard_args (SuperLU REQUIRED_VARS SUPERLU_LIBRARY SUPERLU_INCLUDE_DIR
                                   VERSION_VAR SUPERLU_VERSION)
if (SuperLU_FOUND AND NOT TARGET SuperLU::SuperLU)
  add_library (SuperLU::SuperLU UNKNOWN IMPORTED)
  set_target_properties (SuperLU::SuperLU PROPERTIES
    IMPORTED_LOCATION "${SUPERLU_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SUPERLU_INCLUDE_DIR}")
endif ()
mark_as_advanced (SUPERLU_INCLUDE_DIR SUPERLU_LIBRARY)
