#!/usr/bin/env bash
# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# Proves that a bare Debian 12 is enough: bootstraps one with git, make and certificates and nothing more into FOLDER/root,
# clones this checkout's HEAD into it, and runs the commands there (make demo and make test). Needs root and debootstrap.
#
#   scripts/bare-debian.sh FOLDER [TARGET…]      MIRROR=… chooses another Debian mirror than debootstrap's own default
#
# Times go to FOLDER/times.txt, what each command said to FOLDER/<target>.log. The root is removed at the end unless
# KEEP=1.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: scripts/bare-debian.sh FOLDER [TARGET…]" >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "debootstrap and chroot need root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "debootstrap is not installed" >&2; exit 1; }

source_tree=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
[ $# -gt 0 ] || set -- demo test
root="$folder/root"
[ ! -e "$root" ] || { echo "$root is there already; nothing of it is touched" >&2; exit 1; }

cleanUp() {
    # Only what this script mounted: removing a root with anything mounted in it would be a poor idea.
    local mounted
    for mounted in "$root/dev/pts" "$root/proc"; do
        ! mountpoint -q "$mounted" || umount "$mounted" || { echo "$mounted stays mounted; $root is kept" >&2; return; }
    done
    if [ "${KEEP:-0}" = 1 ]; then echo "kept: $root"; else rm -rf --one-file-system "$root"; fi
}
trap cleanUp EXIT

timed() { # <what> <command…>: the seconds it took, and how it ended
    local what=$1 begin=$SECONDS status=0
    shift
    "$@" || status=$?
    printf '%-10s %6d s   exit %d\n' "$what" $((SECONDS - begin)) "$status" | tee -a "$folder/times.txt"
    return "$status"
}
bootstrapRoot() {
    debootstrap --variant=minbase --include=git,make,ca-certificates bookworm "$root" ${MIRROR:+"$MIRROR"} \
        >"$folder/bootstrap.log"
}
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
    ${NODE_EXTRA_CA_CERTS:+NODE_EXTRA_CA_CERTS=/etc/host-certificates.crt} "$@"; }
logged() { # <target>: make <target> inside, everything it says in a log
    inside make -C /root/cusp "$1" >"$folder/$1.log" 2>&1
}

: >"$folder/times.txt"
timed bootstrap bootstrapRoot
mount -t proc proc "$root/proc"
# Pseudo terminals, as every booted system has them: the tests of serial links open pairs.
mount -t devpts devpts "$root/dev/pts" -o newinstance,ptmxmode=0666
# Names are looked up as the host does it.
cp -L /etc/resolv.conf "$root/etc/resolv.conf"
# Where the host trusts a certificate authority of its own network, node in the root has to trust it as well.
if [ -n "${NODE_EXTRA_CA_CERTS:-}" ]; then cp -L "$NODE_EXTRA_CA_CERTS" "$root/etc/host-certificates.crt"; fi
git -c safe.directory='*' clone -q --no-hardlinks "$source_tree" "$root/root/cusp"
git -C "$root/root/cusp" log -1 --format='commit     %h %s' | tee -a "$folder/times.txt"

failed=0
for target in "$@"; do
    timed "$target" logged "$target" || failed=1
    tail -n 5 "$folder/$target.log"
done
du -sh --one-file-system "$root" | sed 's/^/disk       /' | tee -a "$folder/times.txt"
exit $failed
