# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# One place for what every translation unit of the house is compiled with.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(CUSP_CCACHE ccache)
if(CUSP_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CUSP_CCACHE}")
endif()

# Same seed, same bytes: no fused multiply-add that one compiler chooses and another does not.
add_compile_options(-ffp-contract=off)

# Sanitizers, chosen by the presets, e.g. "address,undefined" or "thread".
set(CUSP_SANITIZE "" CACHE STRING "Sanitizers to build with")
if(CUSP_SANITIZE)
  add_compile_options(-fsanitize=${CUSP_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${CUSP_SANITIZE})
endif()
option(CUSP_COVERAGE "Instrument for coverage" OFF)
if(CUSP_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()

# Linked PRIVATE by every room: warnings are ours to keep, not our users'.
add_library(cusp_warnings INTERFACE)
target_compile_options(cusp_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
  -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Wnull-dereference -Wdouble-promotion -Werror)
