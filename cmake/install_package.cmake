# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Install and export, in the components library (what programs need to run), development, tools and
# documentation; tools/python has the component python. Headers go below include/pcl_floater, so that an overlay never shadows PCL's.
include (CMakePackageConfigHelpers)
set (package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/pcl_floater")
if (PCL_FLOATER_PACKAGES)
  set (CMAKE_INSTALL_DOCDIR "${CMAKE_INSTALL_DATADIR}/doc/pcl-floater-doc")
endif ()
set (headers_dir "${CMAKE_INSTALL_INCLUDEDIR}/pcl_floater")

install (TARGETS pcl_floater EXPORT pcl_floater_targets
         LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library NAMELINK_COMPONENT development
         ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
         RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT library
         INCLUDES DESTINATION "${headers_dir}")
install (DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${headers_dir}" COMPONENT development)
install (FILES "${PROJECT_BINARY_DIR}/include/pcl_floater/export.h" DESTINATION "${headers_dir}/pcl_floater"
         COMPONENT development)

install (EXPORT pcl_floater_targets NAMESPACE pcl_floater:: DESTINATION "${package_dir}" COMPONENT development)
get_target_property (library_type pcl_floater TYPE)
set (is_static OFF)
if (library_type STREQUAL "STATIC_LIBRARY")
  set (is_static ON)
endif ()
configure_package_config_file ("${PROJECT_SOURCE_DIR}/cmake/pcl_floaterConfig.cmake.in"
                               "${PROJECT_BINARY_DIR}/pcl_floaterConfig.cmake"
                               INSTALL_DESTINATION "${package_dir}"
                               PATH_VARS CMAKE_INSTALL_BINDIR)
write_basic_package_version_file ("${PROJECT_BINARY_DIR}/pcl_floaterConfigVersion.cmake"
                                  COMPATIBILITY SameMajorVersion)
install (FILES "${PROJECT_BINARY_DIR}/pcl_floaterConfig.cmake"
               "${PROJECT_BINARY_DIR}/pcl_floaterConfigVersion.cmake"
         DESTINATION "${package_dir}" COMPONENT development)
if (is_static)
  install (FILES "${PROJECT_SOURCE_DIR}/cmake/FindUMFPACK.cmake" DESTINATION "${package_dir}" COMPONENT development)
endif ()

# For pkg-config. PCL's own .pc files name the version with which this was built, and the next minor
# one has another binary interface.
math (EXPR next_pcl_minor "${PCL_VERSION_MINOR} + 1")
set (pcl_requirements "")
foreach (module common kdtree octree search)
  string (APPEND pcl_requirements "pcl_${module} >= ${PCL_VERSION_MAJOR}.${PCL_VERSION_MINOR}, "
                                  "pcl_${module} < ${PCL_VERSION_MAJOR}.${next_pcl_minor}, ")
endforeach ()
# Such libraries come without .pc files of their own.
set (static_libraries "")
if (is_static)
  set (static_libraries "-lumfpack -lamd -lcholmod -lgmp -lmpfr -ldl -pthread")
endif ()
# The file tells the prefix relative to itself, so that an installation can be moved.
file (RELATIVE_PATH prefix_of_pc "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
string (REGEX REPLACE "/$" "" prefix_of_pc "${prefix_of_pc}")
configure_file ("${PROJECT_SOURCE_DIR}/cmake/pcl_floater.pc.in" "${PROJECT_BINARY_DIR}/pcl_floater.pc" @ONLY)
install (FILES "${PROJECT_BINARY_DIR}/pcl_floater.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
         COMPONENT development)

install (FILES "${PROJECT_SOURCE_DIR}/package.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/pcl_floater"
         COMPONENT development)
install (FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CITATION.cff"
         DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT documentation)
# README.md and doc/page.md show these.
foreach (picture tools/picture/example.png tools/reconstruct/page.png test/benchmark/figures/figure6_mesh_bunny.png
                 test/benchmark/figures/figure4_sparsity_bunny.png test/benchmark/figures/figure6_mesh_igea.png)
  get_filename_component (folder "${picture}" DIRECTORY)
  install (FILES "${PROJECT_SOURCE_DIR}/${picture}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/${folder}"
           COMPONENT documentation)
endforeach ()
# The pages, and what they name.
file (GLOB pages CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/doc/*.md")
install (FILES ${pages} "${PROJECT_SOURCE_DIR}/doc/sample_clouds.sh"
         DESTINATION "${CMAKE_INSTALL_DOCDIR}/doc" COMPONENT documentation)
install (FILES "${PROJECT_SOURCE_DIR}/src/README.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}/src"
         COMPONENT documentation)
install (DIRECTORY "${PROJECT_SOURCE_DIR}/test/examples" DESTINATION "${CMAKE_INSTALL_DOCDIR}/test"
         COMPONENT documentation FILES_MATCHING PATTERN "*.cpp" PATTERN "*.h" PATTERN "*.py")
# A Debian package has names of its own for these.
if (NOT PCL_FLOATER_PACKAGES)
  install (FILES "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT documentation)
  install (FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT library)
  # That of the scan in the picture of README.md.
  install (FILES "${PROJECT_SOURCE_DIR}/LICENSES/BSD-3-Clause.txt" DESTINATION "${CMAKE_INSTALL_DOCDIR}/LICENSES"
           COMPONENT documentation)
endif ()
