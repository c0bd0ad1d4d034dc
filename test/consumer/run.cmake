# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs a build into an empty prefix, builds the consumer against that and runs its programs.
#   cmake -D BUILD_DIR=... -D WORK_DIR=... -D GENERATOR=... [-D CONFIG=...] [-D "CACHE=-DNAME=VALUE;..."]
#         [-D STATIC=LIBRARY] [-D PKG_CONFIG=... -D COMPILER=... -D "FLAGS=..."] -P run.cmake
# BUILD_DIR: the build to install, of configuration CONFIG; WORK_DIR: folder to work in, emptied
# first; CACHE: cache entries of the consumer, such as its compiler and flags.
# STATIC: a static library of the objects of that build. A configuration of the project for static
# libraries is then installed with it, which compiles nothing again.
# PKG_CONFIG: that program; a consumer is then compiled by COMPILER with FLAGS and what it tells, without CMake.
cmake_minimum_required (VERSION 3.18)
foreach (variable BUILD_DIR WORK_DIR GENERATOR)
  if (NOT ${variable})
    message (FATAL_ERROR "run.cmake: ${variable} is not set")
  endif ()
endforeach ()

function (run)
  execute_process (COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  list (JOIN ARGV " " command)
  if (NOT result EQUAL 0)
    message (FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif ()
  message (STATUS "${command}: passed")
  set (output "${output}" PARENT_SCOPE)
endfunction ()

set (source "${CMAKE_CURRENT_LIST_DIR}/../..")
set (prefix "${WORK_DIR}/prefix")
set (build "${WORK_DIR}/build")
file (REMOVE_RECURSE "${WORK_DIR}")
set (config_to_install)
if (CONFIG)
  set (config_to_install --config "${CONFIG}")
endif ()
set (with_tools ON)
if (STATIC)
  set (with_tools OFF)
  run ("${CMAKE_COMMAND}" -S "${source}" -B "${WORK_DIR}/static" -G "${GENERATOR}" ${CACHE}
       "-DCMAKE_BUILD_TYPE=${CONFIG}" -DBUILD_SHARED_LIBS=OFF -DPCL_FLOATER_BUILD_TOOLS=OFF
       -DPCL_FLOATER_BUILD_TESTS=OFF)
  file (CREATE_LINK "${STATIC}" "${WORK_DIR}/static/src/libpcl_floater.a" COPY_ON_ERROR)
  set (BUILD_DIR "${WORK_DIR}/static")
endif ()
run ("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${prefix}" ${config_to_install})
run ("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${build}" -G "${GENERATOR}" ${CACHE}
     "-DCMAKE_PREFIX_PATH=${prefix}" "-DWITH_TOOLS=${with_tools}")

# Checks that the installed package was found: CMake may also know a build tree of this project.
file (STRINGS "${build}/CMakeCache.txt" found REGEX "^pcl_floater_DIR:")
string (FIND "${found}" "=${prefix}/" from_prefix)
if (from_prefix EQUAL -1)
  message (FATAL_ERROR "the consumer found another package: ${found}")
endif ()

if (PKG_CONFIG)
  string (REGEX REPLACE "^.*=" "" package_dir "${found}")
  set (ENV{PKG_CONFIG_PATH} "${package_dir}/../../pkgconfig")
  run ("${PKG_CONFIG}" --cflags --libs pcl_floater)
  separate_arguments (told UNIX_COMMAND "${output}")
  separate_arguments (FLAGS UNIX_COMMAND "${FLAGS}")
  run (${COMPILER} ${FLAGS} -std=c++17 "${CMAKE_CURRENT_LIST_DIR}/own_types.cpp" -o "${WORK_DIR}/by_pkg_config"
       ${told} "-Wl,-rpath,${package_dir}/../..")
  run ("${WORK_DIR}/by_pkg_config")
else ()
  # Without optimization, which builds fast and is how users debug.
  run ("${CMAKE_COMMAND}" --build "${build}" --config Debug)
  run ("${CMAKE_CTEST_COMMAND}" --test-dir "${build}" -C Debug --output-on-failure --no-tests=error)
endif ()
