# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# The report as JSON, for the tools and for the Python module, which can be built without them.
include_guard (GLOBAL)
add_library (pcl_floater_report_json OBJECT "${CMAKE_CURRENT_LIST_DIR}/report_json.cpp")
target_include_directories (pcl_floater_report_json PRIVATE "${CMAKE_CURRENT_LIST_DIR}/../io")
target_link_libraries (pcl_floater_report_json PRIVATE pcl_floater_core nlohmann_json::nlohmann_json
                                                       pcl_floater_warnings)
