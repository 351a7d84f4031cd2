# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# One place for what every translation unit of the house is compiled with.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(CUSP_CCACHE ccache)
if(CUSP_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CUSP_CCACHE}")
endif()

# Same seed, same bytes: no fused multiply-add that one compiler chooses and another does not.
add_compile_options(-ffp-contract=off)

# Debian's PCL is compiled without AVX and without sanitizers. Eigen chooses alignment and allocator by such switches, so
# that a fixed-size matrix built here would differ in layout, or be freed by the wrong function, as soon as a build adds
# -mavx2 or ASan. Held fixed for every translation unit, and handed on to those who use an installed cusp.
set(CUSP_ABI_DEFINITIONS EIGEN_MALLOC_ALREADY_ALIGNED=1 EIGEN_MAX_ALIGN_BYTES=16)
add_compile_definitions(${CUSP_ABI_DEFINITIONS})

# Sanitizers, chosen by the presets, e.g. "address,undefined" or "thread".
set(CUSP_SANITIZE "" CACHE STRING "Sanitizers to build with")
set(CUSP_INSTRUMENT_FLAGS "")
if(CUSP_SANITIZE)
  list(APPEND CUSP_INSTRUMENT_FLAGS -fsanitize=${CUSP_SANITIZE})
  add_compile_options(-fno-sanitize-recover=all -fno-omit-frame-pointer)
  # The library's own checks: an empty optional read, an index out of range.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
option(CUSP_COVERAGE "Instrument for coverage" OFF)
if(CUSP_COVERAGE)
  list(APPEND CUSP_INSTRUMENT_FLAGS --coverage)
endif()
if(CUSP_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "CUSP_FUZZ needs clang (libFuzzer): use the preset 'fuzz', or CMAKE_CXX_COMPILER=clang++-19")
  endif()
  # The rooms need the fuzzer's coverage counters too; its main comes only with the fuzz programs themselves.
  add_compile_options(-fsanitize=fuzzer-no-link)
  add_link_options(-fsanitize=fuzzer-no-link)
endif()
add_compile_options(${CUSP_INSTRUMENT_FLAGS})
add_link_options(${CUSP_INSTRUMENT_FLAGS})

# Linked PRIVATE by every room: warnings are ours to keep, not our users'.
add_library(cusp_warnings INTERFACE)
target_compile_options(cusp_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
  -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 sees overlapping copies in std::string's operator+ (GCC bug 105651) and uninitialised members in a std::variant
  # that is moved (GCC bugs 105562, 105593) that are not there. clang and clang-tidy keep watching for the real ones.
  target_compile_options(cusp_warnings INTERFACE -Wno-restrict -Wno-maybe-uninitialized)
endif()
