#!/usr/bin/env bash
# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# Formats every tracked C++ file in place; with --check only says which are not formatted. Exit 77: clang-format-19 or the
# git checkout is missing (ctest takes that as skipped).
set -euo pipefail
cd "$(dirname "$0")/.."

if ! command -v clang-format-19 >/dev/null; then
    echo "skipped: clang-format-19 is not installed (scripts/deps.sh test)"
    exit 77
fi
# A checkout that belongs to somebody else, as in a container, is still ours to read.
if ! files=$(git -c safe.directory='*' ls-files -- '*.cpp' '*.hpp'); then
    echo "skipped: not a git checkout, so there is no list of tracked files"
    exit 77
fi
# A file removed but not yet committed is tracked still.
mapfile -t files < <(while read -r file; do [ -e "$file" ] && echo "$file"; done <<<"$files")

if [ "${1:-}" = --check ]; then
    unformatted=0
    for file in "${files[@]}"; do
        if ! clang-format-19 --dry-run -Werror "$file" 2>/dev/null; then
            echo "$file: not as clang-format leaves it"
            unformatted=$((unformatted + 1))
        fi
    done
    echo "$unformatted of ${#files[@]} files are to be formatted (make format)"
    [ "$unformatted" -eq 0 ]
else
    clang-format-19 -i "${files[@]}"
fi
