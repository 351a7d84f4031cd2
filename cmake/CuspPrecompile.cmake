# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# Precompiled headers: most of a fresh build goes into reading the standard library, Eigen and GoogleTest again for every
# file. A compiler cache does better and cannot share what depends on a precompiled header, so that they exclude each other.
if(CUSP_CCACHE)
  set(precompile OFF)
else()
  set(precompile ON)
endif()
option(CUSP_PRECOMPILE "Precompile foreign headers that are included all over the house" ${precompile})
if(CUSP_PRECOMPILE)
  # A precompiled header is read with the macros it was written with; fmt's is the one that only some targets define.
  add_compile_definitions(FMT_SHARED)
endif()

# cusp_precompile(<target> PLAIN|EIGEN|TEST): the foreign headers that <target> would read for most of its files.
#
# One precompiled header each for all rooms without Eigen, all rooms with it, and all test programs. Their flags must be
# the same then, or the compiler reads the headers after all; programs differ from libraries (-fPIE, -fPIC).
function(cusp_precompile target kind)
  if(NOT CUSP_PRECOMPILE)
    return()
  endif()
  set(headers <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numbers> <optional>
    <span> <sstream> <string> <string_view> <unordered_map> <utility> <variant> <vector> <fmt/format.h> <tl/expected.hpp>)
  if(NOT kind STREQUAL "PLAIN")
    find_package(Eigen3 3.4 REQUIRED NO_MODULE)
    list(APPEND headers <Eigen/Core> <Eigen/Geometry>)
    set(libraries Eigen3::Eigen)
  endif()
  if(kind STREQUAL "TEST")
    list(APPEND headers <gtest/gtest.h>)
    list(APPEND libraries GTest::gtest_main)
  endif()
  set(shared cusp_precompiled_${kind})
  if(NOT TARGET ${shared})
    find_package(fmt REQUIRED)
    file(WRITE "${PROJECT_BINARY_DIR}/${shared}.cpp" "")
    if(kind STREQUAL "TEST")
      add_executable(${shared} EXCLUDE_FROM_ALL "${PROJECT_BINARY_DIR}/${shared}.cpp")
    else()
      add_library(${shared} OBJECT EXCLUDE_FROM_ALL "${PROJECT_BINARY_DIR}/${shared}.cpp")
    endif()
    target_link_libraries(${shared} PRIVATE cusp_warnings fmt::fmt ${libraries})
    target_compile_features(${shared} PRIVATE cxx_std_20)
    target_precompile_headers(${shared} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${shared})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # g++ 12 forgets that a precompiled header came from the system, and reports what it suppresses there otherwise.
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
endfunction()
