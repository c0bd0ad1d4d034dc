# Installs a build into an empty prefix, builds the consumer against that and runs its programs.
#   cmake -D BUILD_DIR=... -D WORK_DIR=... -D GENERATOR=... [-D CONFIG=...] [-D "CACHE=-DNAME=VALUE;..."] -P run.cmake
# BUILD_DIR: the build to install, of configuration CONFIG; WORK_DIR: folder to work in, emptied
# first; CACHE: cache entries of the consumer, such as its compiler and flags.
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
endfunction ()

set (prefix "${WORK_DIR}/prefix")
set (build "${WORK_DIR}/build")
file (REMOVE_RECURSE "${WORK_DIR}")
set (config_to_install)
if (CONFIG)
  set (config_to_install --config "${CONFIG}")
endif ()
run ("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${prefix}" ${config_to_install})
run ("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${build}" -G "${GENERATOR}" ${CACHE}
     "-DCMAKE_PREFIX_PATH=${prefix}")

# Checks that the installed package was found: CMake may also know a build tree of this project.
file (STRINGS "${build}/CMakeCache.txt" found REGEX "^pcl_floater_DIR:")
string (FIND "${found}" "=${prefix}/" from_prefix)
if (from_prefix EQUAL -1)
  message (FATAL_ERROR "the consumer found another package: ${found}")
endif ()

# Without optimization, which builds fast and is how users debug.
run ("${CMAKE_COMMAND}" --build "${build}" --config Debug)
run ("${CMAKE_CTEST_COMMAND}" --test-dir "${build}" -C Debug --output-on-failure --no-tests=error)
