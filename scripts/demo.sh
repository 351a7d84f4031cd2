#!/usr/bin/env bash
# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# Five-axis CL files become 840D programs, and an independent reader proves them; then the loop is closed once.
#
#   scripts/demo.sh CUSP OUTPUT-FOLDER [CL-FILE…]
set -euo pipefail

cusp=$1
out=$2
shift 2
root=$(cd "$(dirname "$0")/.." && pwd)
[ $# -gt 0 ] || set -- "$root/examples/benchmark/surface_finish.cls"
machine=fooke-endura-ca
mkdir -p "$out"

step() { printf '\n\033[1m$ cusp %s\033[0m\n' "$*"; }
run() {
    step "$@"
    "$cusp" "$@"
}

run machine check "$machine"
for cl in "$@"; do
    name=$(basename "$cl")
    program="$out/${name%.*}.MPF"
    run post "$cl" -m "$machine" -o "$program"
    run verify "$program" -m "$machine" --against "$cl"
    printf '\nThe first blocks of %s:\n' "$program"
    head -n 28 "$program"
done

# Beside the programs: surface, path, program, parts measured before and after, and the page of it all.
run demo -o "$out"
