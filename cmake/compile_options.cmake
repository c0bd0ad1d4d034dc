# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Flags that every target of this project shares. Never -march=native or AVX: the alignment of Eigen
# objects would differ from that in Debian's PCL libraries.
# C++17 is the least; another project may ask for a later standard.
if (NOT CMAKE_CXX_STANDARD OR CMAKE_CXX_STANDARD LESS 17 OR CMAKE_CXX_STANDARD EQUAL 98)
  set (CMAKE_CXX_STANDARD 17)
endif ()
set (CMAKE_CXX_STANDARD_REQUIRED ON)
set (CMAKE_CXX_EXTENSIONS OFF)
set (CMAKE_CXX_VISIBILITY_PRESET hidden)
set (CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set (CMAKE_POSITION_INDEPENDENT_CODE ON)
set (CMAKE_EXPORT_COMPILE_COMMANDS ON)

if (PCL_FLOATER_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program (CCACHE_PROGRAM ccache)
  mark_as_advanced (CCACHE_PROGRAM)
  if (CCACHE_PROGRAM)
    set (CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
  endif ()
endif ()

add_library (pcl_floater_warnings INTERFACE)
target_compile_options (pcl_floater_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow)
if (PCL_FLOATER_WARNINGS_AS_ERRORS)
  target_compile_options (pcl_floater_warnings INTERFACE -Werror)
endif ()

# pcl_floater_in_batches (<target>)
# Compiles the sources of each folder as one, which takes a third of the time. So what a source keeps in its
# unnamed namespace has a name of its own within its folder.
option (PCL_FLOATER_UNITY "Compile the sources of a folder together: faster, but for small changes" ON)
function (pcl_floater_in_batches target)
  get_target_property (sources ${target} SOURCES)
  foreach (source IN LISTS sources)
    get_filename_component (folder "${source}" DIRECTORY)
    # Small folders of src are with the sources beside them.
    string (REGEX REPLACE "^(options|report|input|pcl_class)$" "" folder "${folder}")
    string (MAKE_C_IDENTIFIER "in_${folder}" group)
    set_source_files_properties ("${source}" PROPERTIES UNITY_GROUP "${group}")
  endforeach ()
  set_target_properties (${target} PROPERTIES UNITY_BUILD ${PCL_FLOATER_UNITY} UNITY_BUILD_MODE GROUP)
endfunction ()
