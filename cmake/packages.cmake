# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages by CPack, one for each component of the installation. tools/package.sh makes them.
set (maintainer "The pcl_floater authors <pcl-floater@users.noreply.github.com>")
set (debian_revision 1)
set (debian_version "${PROJECT_VERSION}-${debian_revision}")
math (EXPR next_pcl_minor "${PCL_VERSION_MINOR} + 1")

# The package of a shared library is named by its soname, so that two of them can be installed.
set (library_package "libpcl-floater${PROJECT_VERSION_MAJOR}")
set (development_package "libpcl-floater-dev")
set (tools_package "pcl-floater-tools")
set (documentation_package "pcl-floater-doc")
set (python_package "python3-pcl-floater")
set (distributed_package "pcl-floater-mpi")

find_program (GZIP_PROGRAM gzip)
mark_as_advanced (GZIP_PROGRAM)
if (NOT GZIP_PROGRAM OR NOT BUILD_SHARED_LIBS OR NOT PCL_FLOATER_BUILD_TOOLS
    OR NOT TARGET pcl_floater_distributed OR NOT makes_man_pages OR NOT TARGET pcl_floater_python)
  message (FATAL_ERROR "The packages have the shared library, all tools (also that for MPI), their man pages and the "
                       "Python module, and need gzip")
endif ()

# Policy wants a copyright file and a change log in every package.
string (TIMESTAMP debian_date "%a, %d %b %Y %H:%M:%S +0000" UTC) # that of SOURCE_DATE_EPOCH, if it is set
set (debian_folder "${PROJECT_BINARY_DIR}/debian")
configure_file ("${PROJECT_SOURCE_DIR}/cmake/debian_changelog.in" "${debian_folder}/changelog.Debian" @ONLY)
configure_file ("${PROJECT_SOURCE_DIR}/cmake/debian_copyright.in" "${debian_folder}/copyright" @ONLY)
configure_file ("${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${debian_folder}/changelog" COPYONLY)
execute_process (COMMAND "${GZIP_PROGRAM}" -9 -n -f -k "${debian_folder}/changelog.Debian" "${debian_folder}/changelog"
                 RESULT_VARIABLE result)
if (NOT result EQUAL 0)
  message (FATAL_ERROR "gzip failed on ${debian_folder}/changelog.Debian")
endif ()
foreach (component library development tools distributed documentation python)
  install (FILES "${debian_folder}/changelog.Debian.gz" "${debian_folder}/copyright"
           DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${${component}_package}" COMPONENT ${component})
endforeach ()
install (FILES "${debian_folder}/changelog.gz" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT documentation)
foreach (tool reconstruct distributed generate picture)
  set (component tools)
  if (tool STREQUAL distributed)
    set (component distributed)
  endif ()
  set (page "${PROJECT_BINARY_DIR}/tools/${tool}/pcl_floater_${tool}.1")
  add_custom_command (OUTPUT "${page}.gz"
    COMMAND "${GZIP_PROGRAM}" -9 -n -f -k "${page}" DEPENDS pcl_floater_${tool}_man_page "${page}" VERBATIM)
  add_custom_target (pcl_floater_${tool}_man_page_gz ALL DEPENDS "${page}.gz")
  install (FILES "${page}.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT ${component})
endforeach ()

set (CPACK_GENERATOR DEB)
set (CPACK_PACKAGE_NAME pcl-floater)
set (CPACK_PACKAGE_CONTACT "${maintainer}")
set (CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set (CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set (CPACK_STRIP_FILES ON)
set (CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
     OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set (CPACK_COMPONENTS_ALL library development tools distributed documentation python)
set (CPACK_COMPONENTS_GROUPING IGNORE)
set (CPACK_DEB_COMPONENT_INSTALL ON)
set (CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set (CPACK_DEBIAN_PACKAGE_RELEASE ${debian_revision})
set (CPACK_DEBIAN_PACKAGE_SOURCE pcl-floater)
set (CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set (CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set (CPACK_DEBIAN_COMPRESSION_TYPE xz)

set (what_it_is
"It turns an unorganized point cloud into a triangle mesh whose vertices are
the points of the cloud. The surface may be open or closed, with holes, handles
or several components, or a single scan. It needs no normals and no tuning.")
# pcl_floater_package (<component> <section> <title> <what it has> [<field> <value>...])
# Other fields are those of CPACK_DEBIAN_<component>_.
macro (pcl_floater_package component section title text)
  string (TOUPPER ${component} upper)
  set (fields PACKAGE_NAME ${${component}_package} PACKAGE_SECTION ${section} ${ARGN})
  while (fields)
    list (POP_FRONT fields field value)
    set (CPACK_DEBIAN_${upper}_${field} "${value}")
  endwhile ()
  set (CPACK_DEBIAN_${upper}_DESCRIPTION "${title}\n${what_it_is}\n.\n${text}")
endmacro ()

pcl_floater_package (library libs "surface reconstruction for the Point Cloud Library"
                     "This package has the shared library." PACKAGE_SHLIBDEPS ON
                     # The linear systems of discs are solved 2.5 times as fast with it as with the reference BLAS.
                     PACKAGE_RECOMMENDS libopenblas0-pthread)
set (CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set (CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
file (WRITE "${debian_folder}/triggers" "activate-noawait ldconfig\n")
set (CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${debian_folder}/triggers")
set (development_depends "${library_package} (= ${debian_version})"
     "libpcl-dev (>= ${PCL_VERSION_MAJOR}.${PCL_VERSION_MINOR})"
     "libpcl-dev (<< ${PCL_VERSION_MAJOR}.${next_pcl_minor}~)" "libeigen3-dev (>= 3.4)")
list (JOIN development_depends ", " development_depends)
pcl_floater_package (development libdevel "surface reconstruction for the Point Cloud Library - headers"
                     "This package has the headers, and what CMake and pkg-config need."
                     PACKAGE_DEPENDS "${development_depends}" PACKAGE_SUGGESTS ${documentation_package})

pcl_floater_package (tools graphics "surface reconstruction from point clouds - tools"
"This package has the tools: pcl_floater_reconstruct makes a mesh of a cloud,
pcl_floater_picture draws it, and pcl_floater_generate writes sample clouds."
                     PACKAGE_SHLIBDEPS ON PACKAGE_RECOMMENDS libopenblas0-pthread PACKAGE_SUGGESTS pcl-tools)

# The tool contains the core, as those of the package of the tools do, and needs no other of these packages.
pcl_floater_package (distributed graphics "surface reconstruction from point clouds - on several machines"
"This package has the tool pcl_floater_distributed, which makes the same mesh as
pcl_floater_reconstruct on any number of processes, by MPI."
                     PACKAGE_SHLIBDEPS ON PACKAGE_DEPENDS openmpi-bin # mpirun
                     PACKAGE_SUGGESTS ${tools_package})

# The module contains the core, and needs no other of these packages. It is for one version of Python.
# Python's own scripts make its byte code, and remove it.
foreach (script postinst prerm)
  configure_file ("${PROJECT_SOURCE_DIR}/cmake/debian_python_${script}" "${debian_folder}/python/${script}" @ONLY
                  FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach ()
math (EXPR next_python_minor "${PCL_FLOATER_PYTHON_MINOR} + 1")
pcl_floater_package (python python "surface reconstruction from point clouds - Python module"
                     "This package has the module pcl_floater, which takes arrays of NumPy."
                     PACKAGE_SHLIBDEPS ON PACKAGE_RECOMMENDS libopenblas0-pthread PACKAGE_DEPENDS
                     "python3 (>= 3.${PCL_FLOATER_PYTHON_MINOR}~), python3 (<< 3.${next_python_minor}), python3-numpy")
set (CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${debian_folder}/python/postinst;${debian_folder}/python/prerm")

pcl_floater_package (documentation doc "surface reconstruction for the Point Cloud Library - documentation"
                     "This package has the documentation." PACKAGE_ARCHITECTURE all)
include (CPack)
