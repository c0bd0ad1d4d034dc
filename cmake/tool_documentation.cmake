# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# A man page of each tool, made of its --help, so that neither can say what the other does not; and the
# completion of its options by bash, which asks --help at run time.

find_program (AWK_PROGRAM NAMES awk mawk gawk)
mark_as_advanced (AWK_PROGRAM)
set (makes_man_pages ON)
# A tool that is made for another machine does not run here, and one with a sanitizer not everywhere.
if (NOT AWK_PROGRAM OR (CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    OR CMAKE_CXX_FLAGS MATCHES "-fsanitize=")
  set (makes_man_pages OFF)
  message (STATUS "The man pages are not made: they need awk, and tools that run here without a sanitizer")
endif ()

set (makes_man_pages ${makes_man_pages} PARENT_SCOPE)

# Installs a tool and its documentation:
# pcl_floater_document_tool (<tool> SUMMARY <text> EXAMPLE <command|command...> [COLUMN <width>]
#                            [COMPONENT <name>])
# COLUMN: width of the column of names in its --help. COMPONENT: of the installation, by default tools.
function (pcl_floater_document_tool tool)
  cmake_parse_arguments (PARSE_ARGV 1 arg "" "SUMMARY;EXAMPLE;COLUMN;COMPONENT" "")
  if (NOT arg_COMPONENT)
    set (arg_COMPONENT tools)
  endif ()
  if (NOT arg_COLUMN)
    set (arg_COLUMN 30)
  endif ()
  set (script "${PROJECT_SOURCE_DIR}/cmake/man_page.awk")
  set (help "${CMAKE_CURRENT_BINARY_DIR}/${tool}.txt")
  set (page "${CMAKE_CURRENT_BINARY_DIR}/${tool}.1")
  if (makes_man_pages)
    add_custom_command (OUTPUT "${page}"
      COMMAND ${tool} --help > "${help}"
      COMMAND "${AWK_PROGRAM}" -v "name=${tool}" -v "summary=${arg_SUMMARY}" -v "example=${arg_EXAMPLE}"
              -v "version=${PROJECT_VERSION}" -v "column=${arg_COLUMN}" -f "${script}" "${help}" > "${page}"
      DEPENDS ${tool} "${script}"
      COMMENT "Making the man page of ${tool}"
      VERBATIM)
    add_custom_target (${tool}_man_page ALL DEPENDS "${page}")
  endif ()
  if (PCL_FLOATER_INSTALL)
    install (TARGETS ${tool} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT ${arg_COMPONENT})
    install (FILES "${PROJECT_SOURCE_DIR}/tools/completion.bash" RENAME "${tool}"
             DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT ${arg_COMPONENT})
    if (makes_man_pages AND NOT PCL_FLOATER_PACKAGES) # which have compressed ones
      install (FILES "${page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT ${arg_COMPONENT})
    endif ()
  endif ()
endfunction ()
