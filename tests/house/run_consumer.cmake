# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# Configures, builds and runs a project that uses the cusp installed in PREFIX; with EXPECT_ERROR, its configuring must
# fail with that text.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${BUILD}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${BUILD}" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${PREFIX}"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
    "-DROOM_HEADERS=${ROOM_HEADERS}"
  OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE status)
if(EXPECT_ERROR)
  # CMake folds long messages.
  string(REGEX REPLACE "[ \n]+" " " folded "${text}")
  string(FIND "${folded}" "${EXPECT_ERROR}" position)
  if(status EQUAL 0 OR position EQUAL -1)
    message(FATAL_ERROR "expected an error that says \"${EXPECT_ERROR}\", got (${status}):\n${text}")
  endif()
  return()
endif()
if(NOT status EQUAL 0)
  message(FATAL_ERROR "configuring failed:\n${text}")
endif()
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${BUILD}"
  OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "building failed:\n${text}")
endif()
execute_process(COMMAND "${BUILD}/consumer" OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE status)
message(STATUS "${text}")
if(NOT status EQUAL 0)
  message(FATAL_ERROR "running failed (${status})")
endif()
