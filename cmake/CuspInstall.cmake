# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# find_package(cusp COMPONENTS …): one export file per room, loaded with the rooms and packages it depends on.
include(CMakePackageConfigHelpers)

# Which package brings a foreign target. A room is a static library: what it links privately, its users link too.
set(packages
  "tl::expected=tl-expected"
  "fmt::fmt=fmt"
  "Ceres::ceres=Ceres"
  "EXPAT::EXPAT=EXPAT"
  "tomlplusplus::tomlplusplus=tomlplusplus"
  "Eigen3::Eigen=Eigen3 3.4"
  "nlohmann_json::nlohmann_json=nlohmann_json"
  "Threads::Threads=Threads"
  "OpenSSL::Crypto=OpenSSL"
  "TBB::tbb=TBB"
  "Modbus::Modbus=Modbus"
  "SQLite::SQLite3=SQLite3"
  "Clp::Clp=Clp"
  "Polyclipping::Polyclipping=Polyclipping")

set(CUSP_CONFIG_ROOMS "")
get_property(rooms GLOBAL PROPERTY CUSP_ROOMS)
foreach(room IN LISTS rooms)
  get_property(depends GLOBAL PROPERTY CUSP_ROOM_DEPENDS_${room})
  get_property(libraries GLOBAL PROPERTY CUSP_ROOM_LIBRARIES_${room})
  set(finds "")
  foreach(library IN LISTS libraries)
    set(line ${packages})
    list(FILTER line INCLUDE REGEX "^${library}=")
    if(NOT line)
      message(FATAL_ERROR "room ${room} links ${library}: say in cmake/CuspInstall.cmake which package brings it")
    endif()
    string(REGEX REPLACE "^[^=]*=" "" find "${line}")
    list(APPEND finds "${find}")
  endforeach()
  string(APPEND CUSP_CONFIG_ROOMS
    "set(_cusp_rooms_of_${room} \"${depends}\")\nset(_cusp_packages_of_${room} \"${finds}\")\n")
endforeach()
string(JOIN " " CUSP_CONFIG_ROOM_NAMES ${rooms})

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/cusp-config.cmake.in"
  "${PROJECT_BINARY_DIR}/cusp-config.cmake" INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cusp)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/cusp-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/cusp-config.cmake" "${PROJECT_BINARY_DIR}/cusp-config-version.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/FindModbus.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/FindClp.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/FindPolyclipping.cmake"
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cusp)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/cusp)
