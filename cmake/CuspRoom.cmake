# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# cusp_room(<name> [SOURCES …] [DEPENDS <rooms>…] [LIBRARIES <public>…] [PRIVATE_LIBRARIES <private>…])
#
# Declares the room <name> as target cusp_<name> (alias cusp::<name>) in the current folder. DEPENDS lists the rooms its
# arrows point to. A room sees the headers of the rooms it depends on and no others, so a backward include does not
# compile. A room without sources is an interface target: in place, with its arrows, and nothing in it yet.
define_property(GLOBAL PROPERTY CUSP_ROOMS BRIEF_DOCS "Names of all rooms, in the order they were declared")

function(cusp_room name)
  cmake_parse_arguments(PARSE_ARGV 1 room "" "" "SOURCES;DEPENDS;LIBRARIES;PRIVATE_LIBRARIES")
  set(target cusp_${name})
  if(room_SOURCES)
    add_library(${target} STATIC ${room_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:cusp_warnings> ${room_PRIVATE_LIBRARIES})
    target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/src")
    target_compile_features(${target} PUBLIC cxx_std_20)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(cusp::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})

  # Each room installs its headers under a folder of its own: an installed cusp on the compiler's default search path
  # does not open the door for backward includes either.
  if(IS_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/include")
    target_include_directories(${target} ${scope}
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/cusp-rooms/${name}>)
    install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cusp-rooms/${name})
  endif()
  set(links ${room_DEPENDS})
  list(TRANSFORM links PREPEND cusp_)
  target_link_libraries(${target} ${scope} ${links} ${room_LIBRARIES})

  set_property(GLOBAL APPEND PROPERTY CUSP_ROOMS ${name})
  set_property(GLOBAL PROPERTY CUSP_ROOM_DIR_${name} "${CMAKE_CURRENT_SOURCE_DIR}")
  set_property(GLOBAL PROPERTY CUSP_ROOM_DEPENDS_${name} "${room_DEPENDS}")
  install(TARGETS ${target} EXPORT cusp-${name} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT cusp-${name} NAMESPACE cusp:: FILE cusp-${name}.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cusp)
endfunction()
