#!/usr/bin/env bash
# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# clang-tidy over every source file of the house, or over those whose path matches a pattern.
#
#   scripts/lint.sh [PATTERN]       e.g. scripts/lint.sh toolpath/src
set -euo pipefail
cd "$(dirname "$0")/.."
pattern=${1:-}
build=build/clang-dev
cmake --preset clang-dev >/dev/null
# The generated one-line sources below build/ have nothing to check.
run-clang-tidy-19 -p "$build" -j"$(nproc)" -quiet "^$PWD/(?!build/).*${pattern}.*\.cpp$"
