# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Finds SuiteSparse's UMFPACK and CHOLMOD, by which AMD and METIS are called (Debian 12 ships no CMake
# config for them), and makes the targets SuiteSparse::UMFPACK and SuiteSparse::CHOLMOD.
find_path (UMFPACK_INCLUDE_DIR NAMES umfpack.h PATH_SUFFIXES suitesparse)
find_library (UMFPACK_LIBRARY NAMES umfpack)
find_path (CHOLMOD_INCLUDE_DIR NAMES cholmod.h PATH_SUFFIXES suitesparse)
find_library (CHOLMOD_LIBRARY NAMES cholmod)
if (UMFPACK_INCLUDE_DIR AND EXISTS "${UMFPACK_INCLUDE_DIR}/umfpack.h")
  file (STRINGS "${UMFPACK_INCLUDE_DIR}/umfpack.h" umfpack_version_lines
        REGEX "#define UMFPACK_(MAIN|SUB|SUBSUB)_VERSION [0-9]+")
  string (REGEX REPLACE "[^0-9;]+" "" umfpack_version_numbers "${umfpack_version_lines}")
  string (REPLACE ";" "." UMFPACK_VERSION "${umfpack_version_numbers}")
endif ()
include (FindPackageHandleStandardArgs)
find_package_handle_standard_args (UMFPACK
  REQUIRED_VARS UMFPACK_LIBRARY UMFPACK_INCLUDE_DIR CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR
  VERSION_VAR UMFPACK_VERSION)
if (UMFPACK_FOUND)
  foreach (library CHOLMOD UMFPACK)
    if (NOT TARGET SuiteSparse::${library})
      add_library (SuiteSparse::${library} UNKNOWN IMPORTED)
      set_target_properties (SuiteSparse::${library} PROPERTIES
        IMPORTED_LOCATION "${${library}_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${${library}_INCLUDE_DIR}")
    endif ()
    mark_as_advanced (${library}_INCLUDE_DIR ${library}_LIBRARY)
  endforeach ()
endif ()
