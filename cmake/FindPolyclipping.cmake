# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# The Clipper library brings no CMake configuration: its pkg-config file as the target Polyclipping::Polyclipping.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(Polyclipping QUIET IMPORTED_TARGET GLOBAL polyclipping)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Polyclipping REQUIRED_VARS Polyclipping_LINK_LIBRARIES VERSION_VAR Polyclipping_VERSION)
if(Polyclipping_FOUND AND NOT TARGET Polyclipping::Polyclipping)
  add_library(Polyclipping::Polyclipping INTERFACE IMPORTED GLOBAL)
  target_link_libraries(Polyclipping::Polyclipping INTERFACE PkgConfig::Polyclipping)
endif()
