# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# What find_package says where something is missing, and the project as a part of another one. Nothing
# is compiled.
#   cmake -D BUILD_DIR=... -D WORK_DIR=... -D GENERATOR=... [-D CONFIG=...] [-D "CACHE=..."] -P messages.cmake
# The arguments are those of run.cmake.
cmake_minimum_required (VERSION 3.18)

function (configure result_variable output_variable)
  execute_process (COMMAND "${CMAKE_COMMAND}" -G "${GENERATOR}" ${ARGN}
                   RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string (REGEX REPLACE "[ \n]+" " " output "${output}") # CMake breaks the lines of messages
  set (${result_variable} "${result}" PARENT_SCOPE)
  set (${output_variable} "${output}" PARENT_SCOPE)
endfunction ()

# expect (<text> <argument>...): the configuration fails, and its message has the text.
function (expect text)
  file (REMOVE_RECURSE "${WORK_DIR}/missing")
  configure (result output -S "${WORK_DIR}/source" -B "${WORK_DIR}/missing" "-Dpcl_floater_DIR=${package_dir}" ${ARGN})
  string (FIND "${output}" "${text}" place)
  if (result EQUAL 0 OR place EQUAL -1)
    message (FATAL_ERROR "find_package ended with ${result} and does not say '${text}': ${output}")
  endif ()
  message (STATUS "${text}: passed")
endfunction ()

file (REMOVE_RECURSE "${WORK_DIR}")
file (WRITE "${WORK_DIR}/source/CMakeLists.txt"
      "cmake_minimum_required (VERSION 3.18)\nproject (pcl_floater_missing LANGUAGES NONE)\n"
      "find_package (pcl_floater \${VERSION} REQUIRED COMPONENTS \${COMPONENTS})\n")
# A PCL of another minor version.
file (WRITE "${WORK_DIR}/source/PCLConfig.cmake" "set (PCL_FOUND TRUE)\n")
file (WRITE "${WORK_DIR}/source/PCLConfigVersion.cmake"
      "set (PACKAGE_VERSION 1.99.0)\nset (PACKAGE_VERSION_COMPATIBLE TRUE)\n")
set (config_to_install)
if (CONFIG)
  set (config_to_install --config "${CONFIG}")
endif ()
foreach (component library development)
  execute_process (COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix"
                           --component ${component} ${config_to_install}
                   RESULT_VARIABLE result OUTPUT_QUIET)
  if (NOT result EQUAL 0)
    message (FATAL_ERROR "the component ${component} cannot be installed")
  endif ()
endforeach ()
file (GLOB_RECURSE config_file "${WORK_DIR}/prefix/pcl_floaterConfig.cmake")
get_filename_component (package_dir "${config_file}" DIRECTORY)

expect ("the component tools of pcl_floater is not installed" -DCOMPONENTS=tools)
expect ("pcl_floater has no component viewer" "-DCOMPONENTS=viewer")
expect ("compatible with requested version \"0.1\"" -DCOMPONENTS=library -DVERSION=0.1) # of another major version
expect ("but PCL 1.99.0 was found in" -DCOMPONENTS=library "-DPCL_DIR=${WORK_DIR}/source")

configure (result output -S "${CMAKE_CURRENT_LIST_DIR}/parent" -B "${WORK_DIR}/parent" ${CACHE})
if (NOT result EQUAL 0)
  message (FATAL_ERROR "as a part of another project: ${output}")
endif ()
