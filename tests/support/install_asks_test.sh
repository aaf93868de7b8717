#!/usr/bin/env bash
# Nothing is installed unless somebody said so: -y, CI, or an answer at a terminal.
set -uo pipefail

repo=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
unset CI

# Nothing is there, and what would install is written down.
mkdir "$work/bin"
printf '#!/bin/sh\nexit 1\n' > "$work/bin/dpkg-query"
for name in sudo apt-get env; do
  printf '#!/bin/sh\necho "%s $*" >> "%s/done"\n' "$name" "$work" > "$work/bin/$name"
done
chmod +x "$work"/bin/*

# expect SENTENCE STATUS INSTALLS COMMAND...
expect() {
  local sentence=$1 status=$2 installs=$3 got=0 installed=no
  shift 3
  rm -f "$work/done"
  PATH=$work/bin:$PATH "$@" < /dev/null > "$work/out" 2>&1 || got=$?
  [[ ! -e $work/done ]] || installed=yes
  if [[ $got == "$status" && $installed == "$installs" ]]; then
    echo "ok - $sentence"
  else
    echo "not ok - $sentence: status $got, wanted $status; installed: $installed, wanted $installs"
    sed 's/^/  /' "$work/out"
    failed=1
  fi
}

expect 'without a terminal .ci/install asks nobody and installs nothing' 4 no \
  "$repo/.ci/install" build
grep -q 'start again with -y' "$work/out" || { echo 'not ok - it says what to do'; failed=1; }
expect 'with -y it installs' 0 yes "$repo/.ci/install" -y build
expect 'also all that the tests are run with' 0 yes \
  "$repo/.ci/install" -y build sim tests lint lab bench
expect 'asked for help it tells what there is, and installs nothing' 0 no "$repo/.ci/install" --help
while read -r section; do
  grep -q "^  $section " "$work/out" || { echo "not ok - it tells of $section"; failed=1; }
done < <(sed -n 's/^\[\(.*\)\]$/\1/p' "$repo/.ci/packages")
expect 'a section that there is not is refused' 2 no "$repo/.ci/install" nonsense
grep -q 'no section "nonsense"' "$work/out" || { echo 'not ok - and named'; failed=1; }
expect 'beside one that there is, too' 2 no "$repo/.ci/install" -y build nonsense
expect 'so is an option' 2 no "$repo/.ci/install" --yes build
expect 'and nothing at all' 2 no "$repo/.ci/install"
expect 'so does sim/demo: it ends before it builds' 4 no "$repo/sim/demo"

exit "$failed"
