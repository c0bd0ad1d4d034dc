# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later

# find_optional (<name> <package> [<argument>...])
# find_package, as the cache entry PCL_FLOATER_WITH_<name> asks for: ON: the package is required; AUTO:
# it is used if it is there; OFF: it is not looked for.
macro (find_optional name package)
  if (PCL_FLOATER_WITH_${name} STREQUAL "AUTO")
    find_package (${package} ${ARGN} QUIET)
  elseif (PCL_FLOATER_WITH_${name})
    find_package (${package} ${ARGN} REQUIRED)
  endif ()
endmacro ()
