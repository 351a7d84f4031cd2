# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# libmodbus brings no CMake configuration: its pkg-config file as the target Modbus::Modbus.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(Modbus QUIET IMPORTED_TARGET GLOBAL libmodbus)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Modbus REQUIRED_VARS Modbus_LINK_LIBRARIES VERSION_VAR Modbus_VERSION)
if(Modbus_FOUND AND NOT TARGET Modbus::Modbus)
  add_library(Modbus::Modbus INTERFACE IMPORTED GLOBAL)
  target_link_libraries(Modbus::Modbus INTERFACE PkgConfig::Modbus)
endif()
