# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# Preprocesses, as the room ROOM, an include of every other room: it must succeed where the arrows lead and fail, for the
# reason that there is no such file, where they do not. All of it once more with an installed cusp on the search path.
# Whether a header that is found compiles as well is what the targets headers_<room> show.
cmake_minimum_required(VERSION 3.25)
include("${FOLDER}/room_headers.cmake")
include("${FOLDER}/arrows_${ROOM}.cmake")
set(units "${FOLDER}/arrows_${ROOM}")
file(MAKE_DIRECTORY "${units}")

set(flags -std=c++20 -E -o /dev/null -DEIGEN_MALLOC_ALREADY_ALIGNED=1 -DEIGEN_MAX_ALIGN_BYTES=16)
# /usr/include, named explicitly, would come before the C++ library's own folder and break it; CMake leaves it out too.
list(REMOVE_ITEM include_folders "" ${implicit_folders})
foreach(folder IN LISTS include_folders)
  list(APPEND flags -isystem "${folder}")
endforeach()

# Sets `error` to what the compiler says about a unit of these includes; empty if it compiles.
function(compile_includes name headers installed error)
  list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>\n")
  string(JOIN "" text ${headers})
  file(WRITE "${units}/${name}.cpp" "${text}")
  set(search "")
  if(installed)
    set(search -isystem "${STAGING}")
  endif()
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env LC_ALL=C "${COMPILER}" ${flags} ${search} "${units}/${name}.cpp"
    ERROR_VARIABLE text RESULT_VARIABLE status)
  if(status EQUAL 0)
    set(text "")
  elseif(text STREQUAL "")
    set(text "the compiler failed without a word (${status})")
  endif()
  set(${error} "${text}" PARENT_SCOPE)
endfunction()

set(broken "")
set(reachable 0)
set(forbidden 0)

# The staged install must be in effect, or its half of the test would pass for nothing.
compile_includes(installed "cusp-rooms/base/cusp/base/units.hpp" TRUE error)
if(error)
  string(APPEND broken "an installed header is not found below ${STAGING}:\n${error}\n")
endif()

set(all_reachable "")
foreach(other IN LISTS rooms)
  if(NOT headers_${other})
    continue()
  endif()
  if(other IN_LIST reaches)
    list(APPEND all_reachable ${headers_${other}})
    math(EXPR reachable "${reachable} + 1")
    continue()
  endif()
  list(GET headers_${other} 0 header)
  foreach(installed FALSE TRUE)
    compile_includes("forbidden_${other}" "${header}" ${installed} error)
    if(NOT error)
      string(APPEND broken "${ROOM} can include <${header}>, but no arrow leads to ${other} (installed: ${installed})\n")
    elseif(NOT error MATCHES "${header}: No such file|'${header}' file not found")
      string(APPEND broken "<${header}> in ${ROOM} fails for another reason than a missing file:\n${error}\n")
    endif()
    math(EXPR forbidden "${forbidden} + 1")
  endforeach()
endforeach()

if(all_reachable)
  compile_includes(reachable "${all_reachable}" FALSE error)
  if(error)
    string(APPEND broken "${ROOM} cannot include what its arrows lead to:\n${error}\n")
  endif()
endif()

message(STATUS "${ROOM}: ${reachable} rooms within reach, ${forbidden} includes refused")
if(reachable EQUAL 0 AND forbidden EQUAL 0)
  string(APPEND broken "nothing was included")
endif()
if(broken)
  message(FATAL_ERROR "${broken}")
endif()
