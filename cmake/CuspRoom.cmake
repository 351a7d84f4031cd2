# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# cusp_room(<name> [SOURCES …] [DEPENDS <rooms>…] [LIBRARIES <public>…] [PRIVATE_LIBRARIES <private>…])
#
# Declares the room <name> as target cusp_<name> (alias cusp::<name>) in the current folder. DEPENDS lists the rooms its
# arrows point to; they must have been declared before, so that arrows cannot close a circle. A room sees the headers of
# the rooms its arrows reach and no others, so a backward include does not compile. LIBRARIES and PRIVATE_LIBRARIES are
# foreign. A room without sources is an interface target: in place, with its arrows, and nothing in it yet.
#
# Global properties for whoever walks the rooms (install, tests): CUSP_ROOMS, and for each room CUSP_ROOM_DIR_<name>,
# CUSP_ROOM_DEPENDS_<name>, CUSP_ROOM_REACHES_<name> (its arrows followed to the end, itself included) and
# CUSP_ROOM_LIBRARIES_<name> (foreign targets, public and private).
define_property(GLOBAL PROPERTY CUSP_ROOMS BRIEF_DOCS "Names of all rooms, in the order they were declared")

function(cusp_room name)
  cmake_parse_arguments(PARSE_ARGV 1 room "" "" "SOURCES;DEPENDS;LIBRARIES;PRIVATE_LIBRARIES")
  if(room_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "cusp_room(${name}): does not know '${room_UNPARSED_ARGUMENTS}'")
  endif()
  _cusp_check_arrows(${name} "${room_DEPENDS}" "${room_LIBRARIES};${room_PRIVATE_LIBRARIES}")

  set(target cusp_${name})
  if(room_SOURCES)
    add_library(${target} STATIC ${room_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:cusp_warnings> ${room_PRIVATE_LIBRARIES})
    target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/src")
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(cusp::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_compile_definitions(${target} INTERFACE "$<INSTALL_INTERFACE:${CUSP_ABI_DEFINITIONS}>")

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

  set(reaches ${name})
  foreach(depend IN LISTS room_DEPENDS)
    get_property(further GLOBAL PROPERTY CUSP_ROOM_REACHES_${depend})
    list(APPEND reaches ${further})
  endforeach()
  list(REMOVE_DUPLICATES reaches)
  if(room_SOURCES)
    if("geometry" IN_LIST reaches)
      cusp_precompile(${target} EIGEN)
    else()
      cusp_precompile(${target} PLAIN)
    endif()
  endif()
  set_property(GLOBAL APPEND PROPERTY CUSP_ROOMS ${name})
  set_property(GLOBAL PROPERTY CUSP_ROOM_DIR_${name} "${CMAKE_CURRENT_SOURCE_DIR}")
  set_property(GLOBAL PROPERTY CUSP_ROOM_DEPENDS_${name} "${room_DEPENDS}")
  set_property(GLOBAL PROPERTY CUSP_ROOM_REACHES_${name} "${reaches}")
  set_property(GLOBAL PROPERTY CUSP_ROOM_LIBRARIES_${name} ${room_LIBRARIES} ${room_PRIVATE_LIBRARIES})
  install(TARGETS ${target} EXPORT cusp-${name} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT cusp-${name} NAMESPACE cusp:: FILE cusp-${name}.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cusp)
endfunction()

# Arrows point only to rooms declared before, and no room slips in as a foreign library.
function(_cusp_check_arrows name depends libraries)
  get_property(declared GLOBAL PROPERTY CUSP_ROOMS)
  foreach(depend IN LISTS depends)
    if(NOT depend IN_LIST declared)
      message(FATAL_ERROR "cusp_room(${name}): its arrow points to '${depend}', which is not a room declared before it")
    endif()
  endforeach()
  foreach(library IN LISTS libraries)
    if(library MATCHES "^cusp(_|::)")
      message(FATAL_ERROR "cusp_room(${name}): '${library}' is a room; name it in DEPENDS")
    endif()
  endforeach()
endfunction()

# The public headers of a room as one writes them in an include: cusp/base/result.hpp.
function(cusp_room_headers name result)
  get_property(dir GLOBAL PROPERTY CUSP_ROOM_DIR_${name})
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE "${dir}/include" "${dir}/include/*.hpp")
  set(${result} "${headers}" PARENT_SCOPE)
endfunction()
