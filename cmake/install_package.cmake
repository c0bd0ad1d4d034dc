# Install and export. Headers go below include/pcl_floater, so that an overlay never shadows PCL's.
include (CMakePackageConfigHelpers)
set (package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/pcl_floater")
set (headers_dir "${CMAKE_INSTALL_INCLUDEDIR}/pcl_floater")

install (TARGETS pcl_floater EXPORT pcl_floater_targets
         LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
         ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
         RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
         INCLUDES DESTINATION "${headers_dir}")
install (DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${headers_dir}")
install (FILES "${PROJECT_BINARY_DIR}/include/pcl_floater/export.h" DESTINATION "${headers_dir}/pcl_floater")

install (EXPORT pcl_floater_targets NAMESPACE pcl_floater:: DESTINATION "${package_dir}")
configure_package_config_file ("${PROJECT_SOURCE_DIR}/cmake/pcl_floaterConfig.cmake.in"
                               "${PROJECT_BINARY_DIR}/pcl_floaterConfig.cmake"
                               INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file ("${PROJECT_BINARY_DIR}/pcl_floaterConfigVersion.cmake"
                                  COMPATIBILITY SameMinorVersion)
install (FILES "${PROJECT_BINARY_DIR}/pcl_floaterConfig.cmake"
               "${PROJECT_BINARY_DIR}/pcl_floaterConfigVersion.cmake"
         DESTINATION "${package_dir}")
if (NOT BUILD_SHARED_LIBS)
  install (FILES "${PROJECT_SOURCE_DIR}/cmake/FindUMFPACK.cmake"
                 "${PROJECT_SOURCE_DIR}/cmake/FindSuperLU.cmake" DESTINATION "${package_dir}")
endif ()
install (FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install (FILES "${PROJECT_SOURCE_DIR}/package.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/pcl_floater")
