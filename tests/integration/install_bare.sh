#!/bin/bash
# What README.md says under "On a robot", and config/README.md after it, literally on a bare Debian
# 12: a root made with mmdebstrap, a user with sudo, a copy of this tree, the commands as they stand
# there. No systemd runs in it: bare/systemctl checks the units and runs their ExecStart by hand.
#   tests/integration/install_bare.sh    prints what was run and heard, and "ok - " or "not ok - "
# Root, Debian's packages and the compiler's results are kept in ${XDG_CACHE_HOME:-~/.cache}/drover.
# Exit status 3 and a line "skip - ": no root can be made here.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(cd "$here/../.." && pwd)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/drover/bare
suite=bookworm

skip() { echo "skip - $1"; exit 3; }

# The mirror and the proxy that this machine uses itself; mmdebstrap's own where it has none.
mirror() {
  local found
  # shellcheck disable=SC2016  # apt's words, not the shell's
  found=$(apt-get indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' \
    "Created-By: Packages" "Origin: Debian" 2> /dev/null |
    awk -v suite="$suite" '$1 == suite && $2 == "main" { print $3; exit }' || true)
  echo "${DROVER_DEBIAN_MIRROR:-$found}"
}

make_root() {
  [[ ! -f $cache/$suite.tar ]] || return 0
  local from
  from=$(mirror)
  echo "making a bare Debian ($suite)${from:+ from $from}"
  rm -rf "$cache/$suite.tar"  # whatever stands there is no archive
  # The ending says that an archive is wanted.
  mmdebstrap --quiet --variant=important --include=sudo,ca-certificates "$suite" \
    "$cache/$suite.new.tar" ${from:+"$from"} && mv -T "$cache/$suite.new.tar" "$cache/$suite.tar"
}

if [[ ${1:-} != --inside ]]; then
  command -v mmdebstrap > /dev/null || skip "mmdebstrap is missing"
  [[ $(dpkg --print-architecture) == amd64 ]] || echo "note: on $(dpkg --print-architecture)"
  # Namespaces of its own: mounts and processes end with it, and its network is this machine's only
  # until everything is fetched (bare/inside leaves it then).
  enter=(unshare --mount --pid --fork --kill-child --ipc --uts)
  [[ $EUID == 0 ]] || enter+=(--map-root-user --map-auto)
  "${enter[@]}" true 2> /dev/null || skip "no namespaces for a root of its own"
  mkdir -p "$cache/archives" "$cache/ccache"
  exec 9> "$cache/lock"
  flock 9
  make_root || skip "mmdebstrap cannot make a root, see above"
  exec "${enter[@]}" "${BASH_SOURCE[0]}" --inside
fi

root=$(mktemp -d "${TMPDIR:-/tmp}/drover-bare-XXXXXX")
trap 'umount -l "$root" 2> /dev/null; rmdir "$root" 2> /dev/null' EXIT
trap 'exit 130' INT TERM  # the first process of a namespace hears only what it has asked for
mount --make-rprivate /
mount -t tmpfs -o mode=0755,size=8g bare "$root"
tar -x --numeric-owner --exclude='./dev/*' -f "$cache/$suite.tar" -C "$root"

mount -t proc proc "$root/proc"
mount -t tmpfs -o mode=0755 dev "$root/dev"
for node in null zero full random urandom tty; do
  touch "$root/dev/$node"
  mount --bind "/dev/$node" "$root/dev/$node"
done
mkdir "$root/dev/shm" "$root/dev/pts"
chmod 1777 "$root/dev/shm"
mount -t devpts -o newinstance,ptmxmode=0666,mode=0620 pts "$root/dev/pts"
ln -s pts/ptmx "$root/dev/ptmx"
ln -s /proc/self/fd "$root/dev/fd"
for number in 0:stdin 1:stdout 2:stderr; do
  ln -s "fd/${number%:*}" "$root/dev/${number#*:}"
done
mount -t tmpfs -o mode=0755 run "$root/run"

# Fetched once, built once: neither is what is tested here. Not on a bare machine, but out of sight.
mount --bind "$cache/archives" "$root/var/cache/apt/archives"
mkdir -p "$root/var/cache/ccache"
mount --bind "$cache/ccache" "$root/var/cache/ccache"
rm -f "$root/etc/apt/apt.conf.d/docker-clean"
apt-config dump | grep -iE '^Acquire::[a-z]+::Proxy ' > "$root/etc/apt/apt.conf.d/90proxy" || true
echo "deb $(mirror) $suite main" > "$root/etc/apt/sources.list"
cp /etc/resolv.conf "$root/etc/resolv.conf"
echo "127.0.0.1 localhost $(hostname)" > "$root/etc/hosts"  # sudo asks for it
printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"  # no boot, no services by packages
chmod +x "$root/usr/sbin/policy-rc.d"

mkdir -p "$root/srv/field/drover"
if [[ -e $tree/.git ]]; then
  git -c safe.directory="$tree" -C "$tree" ls-files -zco --exclude-standard
else
  (cd "$tree" && find . -type f -not -path './build*' -print0)
fi | (cd "$tree" && xargs -0 sh -c 'for f; do [ ! -e "$f" ] || printf "%s\0" "$f"; done' sh |
  tar -c --null -T - -f -) | tar -x -C "$root/srv/field/drover"
cp "$here/bare/inside" "$here/bare/block" "$root/usr/local/sbin/"
for name in systemctl udevadm sysctl; do
  cp "$here/bare/$name" "$root/usr/local/sbin/$name"
done
chroot "$root" /usr/local/sbin/inside
