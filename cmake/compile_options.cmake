# Flags that every target of this project shares. Never -march=native or AVX: the alignment of Eigen
# objects would differ from that in Debian's PCL libraries.
set (CMAKE_CXX_STANDARD 17)
set (CMAKE_CXX_STANDARD_REQUIRED ON)
set (CMAKE_CXX_EXTENSIONS OFF)
set (CMAKE_CXX_VISIBILITY_PRESET hidden)
set (CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set (CMAKE_POSITION_INDEPENDENT_CODE ON)
set (CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program (CCACHE_PROGRAM ccache)
if (CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set (CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif ()

add_library (pcl_floater_warnings INTERFACE)
target_compile_options (pcl_floater_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow)
if (PCL_FLOATER_WARNINGS_AS_ERRORS)
  target_compile_options (pcl_floater_warnings INTERFACE -Werror)
endif ()
