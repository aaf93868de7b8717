#!/bin/bash
# What `cmake --install` puts where, and whether the units find it.  CMAKE BUILD_FOLDER
set -euo pipefail
cmake=$1
build=$2

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
DESTDIR=$folder "$cmake" --install "$build" > "$folder/log" || { cat "$folder/log"; exit 1; }

# Whoever reads it on the robot has no sources beside it.
readme=$folder$(find "$folder" -path '*/share/drover/README.md' -printf '/%P\n')
while read -r link; do
  [[ -e $(dirname "$readme")/${link%%#*} ]] || { echo "$readme: a dead link: $link"; exit 1; }
done < <(grep -o '](\([^)]*\))' "$readme" | sed 's/^](//; s/)$//' | grep -v '^#\|^https\?:')

failed=0
expect() {  # WHAT COMMAND...
  local what=$1
  shift
  "$@" || { echo "not so: $what"; failed=1; }
}

units=$folder/usr/lib/systemd/system
programs=(droverd drover-guard)
! grep -q '^DROVER_ROS2:BOOL=ON' "$build/CMakeCache.txt" || programs+=(drover-ros2)
for program in "${programs[@]}"; do
  path=$(sed -n 's/^ExecStart=\([^ ]*\).*/\1/p' "$units/$program.service")
  expect "$program.service starts an installed program ($path)" test -x "$folder$path"
done
expect "droverd.service reads /etc/drover/drover.json" \
  grep -q '^ExecStart=.*--config /etc/drover/drover.json$' "$units/droverd.service"
[[ " ${programs[*]} " != *" drover-ros2 "* ]] ||
  expect "a restart of droverd for a change restarts drover-ros2, which reads the same file" \
    grep -q '^PartOf=droverd.service$' "$units/drover-ros2.service"
expect "drover is installed" test -x "$folder/usr/bin/drover"
# The configuration's own maps, as someone finds them who has copied it to /etc/drover.
grep -o '"maps/[a-z0-9_]*.json"' "$folder/usr/share/drover/drover.json" | tr -d '"' | sort -u |
  while read -r map; do
    test -e "$folder/usr/share/drover/$map" || { echo "not so: $map is installed"; exit 1; }
  done || failed=1
for file in lib/udev/rules.d/70-drover.rules lib/sysusers.d/drover.conf lib/tmpfiles.d/drover.conf \
  lib/sysctl.d/60-drover.conf share/drover/README.md share/drover/network/80-can0.network \
  share/drover/mosquitto/drover.acl share/drover/mosquitto/drover.conf; do
  expect "$file is installed" test -e "$folder/usr/$file"
done
expect "/etc is left alone" test ! -e "$folder/etc"
# Some of it has the name of its source, which a build beside that would write over.
mkdir "$folder/sources"
cp "$(dirname "$0")/../../CMakeLists.txt" "$folder/sources"
said=$("$cmake" -B "$folder/sources" -S "$folder/sources" 2>&1 || true)
expect "a build in the sources' own folder is refused" grep -q 'a folder of its own' <<< "$said"
exit $failed
