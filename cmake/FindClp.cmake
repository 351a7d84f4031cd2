# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# COIN-OR's linear programming solver brings no CMake configuration: its pkg-config file as the target Clp::Clp.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(Clp QUIET IMPORTED_TARGET GLOBAL clp)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Clp REQUIRED_VARS Clp_LINK_LIBRARIES VERSION_VAR Clp_VERSION)
if(Clp_FOUND AND NOT TARGET Clp::Clp)
  add_library(Clp::Clp INTERFACE IMPORTED GLOBAL)
  target_link_libraries(Clp::Clp INTERFACE PkgConfig::Clp)
endif()
