# Finds SuiteSparse's UMFPACK (Debian 12 ships no CMake config for it) and makes the target
# SuiteSparse::UMFPACK.
find_path (UMFPACK_INCLUDE_DIR NAMES umfpack.h PATH_SUFFIXES suitesparse)
find_library (UMFPACK_LIBRARY NAMES umfpack)
if (UMFPACK_INCLUDE_DIR AND EXISTS "${UMFPACK_INCLUDE_DIR}/umfpack.h")
  file (STRINGS "${UMFPACK_INCLUDE_DIR}/umfpack.h" umfpack_version_lines
        REGEX "#define UMFPACK_(MAIN|SUB|SUBSUB)_VERSION [0-9]+")
  string (REGEX REPLACE "[^0-9;]+" "" umfpack_version_numbers "${umfpack_version_lines}")
  string (REPLACE ";" "." UMFPACK_VERSION "${umfpack_version_numbers}")
endif ()
include (FindPackageHandleStandardArgs)
find_package_handle_standard_args (UMFPACK REQUIRED_VARS UMFPACK_LIBRARY UMFPACK_INCLUDE_DIR
                                   VERSION_VAR UMFPACK_VERSION)
if (UMFPACK_FOUND AND NOT TARGET SuiteSparse::UMFPACK)
  add_library (SuiteSparse::UMFPACK UNKNOWN IMPORTED)
  set_target_properties (SuiteSparse::UMFPACK PROPERTIES
    IMPORTED_LOCATION "${UMFPACK_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${UMFPACK_INCLUDE_DIR}")
endif ()
mark_as_advanced (UMFPACK_INCLUDE_DIR UMFPACK_LIBRARY)
