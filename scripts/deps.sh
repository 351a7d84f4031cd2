#!/usr/bin/env bash
# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages of the named sections of packages.txt that are absent, and touches nothing else.
#
#   scripts/deps.sh SECTION…        e.g. scripts/deps.sh build test
set -euo pipefail
list="$(dirname "$0")/packages.txt"

[ $# -gt 0 ] || { echo "usage: scripts/deps.sh SECTION…  (sections: $(sed -n 's/^\[\(.*\)\]$/\1/p' "$list" | xargs))" >&2; exit 2; }
for section in "$@"; do
    grep -qxF "[$section]" "$list" || { echo "scripts/packages.txt has no section [$section]" >&2; exit 2; }
done
if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "Not a Debian system: install what $list lists under: $*" >&2
    exit 0
fi

wanted=$(awk -v sections=" $* " '
    /^\[.*\]$/ { inside = index(sections, " " substr($0, 2, length($0) - 2) " ") > 0; next }
    inside && NF && $1 !~ /^#/ { print $1 ~ /^command:/ ? $1 "=" $2 : $1 }' "$list" | sort -u)
missing=()
for entry in $wanted; do
    package=${entry#command:*=}
    if [ "$package" != "$entry" ]; then
        name=${entry#command:}
        ! command -v "${name%%=*}" >/dev/null || continue
    fi
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
    echo "Debian packages ($*): all present"
    exit 0
fi

echo "Debian packages ($*) to install: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    # -n: a build must fail with a clear text rather than wait for a password nobody sees it ask for.
    if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
        echo "Root is needed for that. Run this, then start again:" >&2
        echo "  apt-get update && apt-get install -y --no-install-recommends ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo -n)
fi
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=600 "$@"; }
apt update
apt install -y --no-install-recommends "${missing[@]}"
