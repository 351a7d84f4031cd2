# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# Pairs of rooms that no arrow may ever join. Declaring an arrow is one line; these lines say which ones would break what
# the house is built on, so that it takes a reviewed change of this file as well.
cmake_minimum_required(VERSION 3.25)
set(walls
  # The independent reader is a witness only while it shares nothing with the chain it testifies about.
  "post_reader kinematics" "post_reader toolpath" "post_reader geometry" "post_reader post_writer"
  "post_writer post_reader" "post_control kinematics" "post_control geometry" "machine geometry"
  # Transports and the protocol carry bytes and know nothing of G-code or machines.
  "comm_link post" "comm_dnc post" "comm_dnc post_control" "comm_dnc machine" "comm_dnc geometry"
  # Measuring must not depend on how the part was made.
  "inspect toolpath" "inspect kinematics"
  # An engine that knows a problem cannot be tested on functions whose optimum is known.
  "optimizer_evolution geometry" "optimizer_evolution toolpath"
  # Heavy foreign code stays out of everyone's way.
  "toolpath geometry_cad" "kinematics geometry_cad" "post geometry_cad" "inspect inspect_scan")

set(broken "")
include("${FOLDER}/room_reaches.cmake")
foreach(wall IN LISTS walls)
  separate_arguments(wall)
  list(GET wall 0 from)
  list(GET wall 1 to)
  foreach(room IN LISTS wall)
    if(NOT room IN_LIST rooms)
      string(APPEND broken "the wall ${from} | ${to} names '${room}', which is not a room\n")
    endif()
  endforeach()
  if(to IN_LIST reaches_${from})
    string(APPEND broken "the arrows of ${from} lead to ${to}\n")
  endif()
endforeach()

# A relative include finds a file without any search path, past every arrow.
foreach(room IN LISTS rooms)
  file(GLOB_RECURSE files "${dir_${room}}/include/*" "${dir_${room}}/src/*")
  foreach(file IN LISTS files)
    file(STRINGS "${file}" includes REGEX "^[ \t]*#[ \t]*include[ \t]*[\"<][^\">]*\\.\\./")
    if(includes)
      string(APPEND broken "${file} includes by a relative path: ${includes}\n")
    endif()
    file(STRINGS "${file}" includes REGEX "^[ \t]*#[ \t]*include[ \t]*[\"<]cusp-rooms/")
    if(includes)
      string(APPEND broken "${file} includes an installed header: ${includes}\n")
    endif()
  endforeach()
endforeach()

if(broken)
  message(FATAL_ERROR "${broken}")
endif()
