#!/usr/bin/env bash
# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# Runs a command where SocketCAN is: on this kernel, or in a small machine (QEMU) with Debian's kernel when this one has
# no CAN.
#   can_machine.sh CACHE COMMAND [ARGUMENT…]
# The machine sees this file system read-only, so that the command needs no copying; it has vcan0 (CAN FD too), and where
# iproute2 is installed the pair vx0 and vx1, on which netem does harm (on vcan it has no effect). The kernel
# is Debian's linux-image-amd64, fetched once as a package into the folder CACHE and not installed. Exit code: that of the
# command; 77 when neither way exists here, with the reason.
set -euo pipefail

skip() { echo "skipped: $*" >&2; exit 77; }

cache=$1
shift
if ip link show vcan0 >/dev/null 2>&1; then exec "$@"; fi

for program in qemu-system-x86_64 cpio dpkg-deb; do
  command -v "$program" >/dev/null || skip "this kernel has no CAN interface vcan0, and $program is not installed"
done
busybox=$(command -v busybox) || skip "busybox-static is not installed"

# In the order in which they need each other.
modules="virtio_ring virtio virtio_pci_modern_dev virtio_pci_legacy_dev virtio_pci netfs fscache 9pnet 9pnet_virtio 9p
  can can-dev can-raw can-isotp vcan vxcan sch_netem"

fetch_kernel() {
  local package
  package=$(apt-cache depends linux-image-amd64 2>/dev/null | sed -n 's/.*Depends: \(linux-image-[^ ]*\).*/\1/p' | head -n 1)
  [ -n "$package" ] || skip "apt knows no linux-image-amd64"
  rm -rf "$cache" && mkdir -p "$cache/unpacked"
  (cd "$cache" && apt-get -qq download "$package" >/dev/null 2>&1) || skip "$package could not be fetched"
  dpkg-deb --fsys-tarfile "$cache"/linux-image-*.deb | tar -x -C "$cache/unpacked" --wildcards './boot/vmlinuz-*' '*/net/can/*' \
    '*/net/9p/*' '*/sched/sch_netem.ko' '*/fs/9p/*' '*/fs/netfs/*' '*/fs/fscache/*' '*/drivers/virtio/*'
  mkdir "$cache/modules"
  local module
  for module in $modules; do
    find "$cache/unpacked" -name "$module.ko" -exec cp {} "$cache/modules/" \;
  done
  mv "$cache"/unpacked/boot/vmlinuz-* "$cache/vmlinuz"
  rm -rf "$cache/unpacked" "$cache"/linux-image-*.deb
  touch "$cache/complete-2"
}
[ -e "$cache/complete-2" ] || fetch_kernel

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/root
mkdir -p "$root"/{bin,proc,host} "$root/modules"
cp "$busybox" "$root/bin/busybox"
cp "$cache"/modules/*.ko "$root/modules/"
{
  printf 'cd %q\n' "$PWD"
  printf 'export LC_ALL=C.UTF-8 TMPDIR=/dev/shm PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin\n'
  echo 'ip link add vx0 type vxcan peer name vx1 2>/dev/null && for i in 0 1; do ip link set vx$i mtu 72 up; done'
  printf '%q ' "$@"
  echo
} >"$root/command"
cat >"$root/init" <<INIT
#!/bin/busybox sh
b=/bin/busybox
\$b mount -t proc none /proc
for m in $(echo $modules); do \$b insmod /modules/\$m.ko; done
\$b mount -t 9p -o ro,trans=virtio,version=9p2000.L,msize=262144,cache=loose root /host
\$b mount -t proc none /host/proc
\$b mount -t sysfs none /host/sys
\$b mount -t devtmpfs none /host/dev
\$b mkdir -p /host/dev/shm
\$b mount -t tmpfs none /host/dev/shm
\$b cp /command /host/dev/shm/command
\$b ip link set lo up
\$b ip link add vcan0 type vcan
\$b ip link set vcan0 mtu 72
\$b ip link set vcan0 up
\$b chroot /host /bin/bash /dev/shm/command
code=\$?
\$b printf "\\\\\$(\$b printf %03o \$code)" | \$b dd of=/host/dev/port bs=1 seek=244 2>/dev/null
\$b poweroff -f
INIT
chmod +x "$root/init"
(cd "$root" && find . | cpio -o -H newc --quiet) >"$work/initrd"

# The port 0xF4 ends the machine, with twice the command's exit code and one.
set +e
timeout -k 5 150 qemu-system-x86_64 -machine q35 -accel tcg -cpu max -m 512 -nodefaults -no-user-config -display none \
  -serial stdio -no-reboot -device isa-debug-exit,iobase=0xf4,iosize=4 -kernel "$cache/vmlinuz" -initrd "$work/initrd" \
  -append "console=ttyS0 quiet loglevel=1 panic=-1 mitigations=off" \
  -fsdev local,id=root,path=/,security_model=none,readonly=on,multidevs=remap \
  -device virtio-9p-pci,fsdev=root,mount_tag=root </dev/null
ended=$?
[ $((ended & 1)) -eq 1 ] || { echo "the machine ended by itself ($ended)" >&2; exit 1; }
exit $((ended >> 1))
