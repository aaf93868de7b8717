#!/bin/bash
# unit-shard finds a test that hangs, and a program that ends amid its tests.
set -uo pipefail
shard=$(readlink -f "$(dirname "$0")/../unit-shard")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0

# expect STATUS TEXT NAME BODY: what a program that does so comes to.
expect() {
  printf '#!/bin/bash\n%s\n' "$4" > "$folder/program"
  chmod +x "$folder/program"
  local said status
  said=$("$shard" 1 0 "$folder/program" 2>&1)
  status=$?
  if [[ $status == "$1" && $said == *"$2"* ]]; then
    echo "ok - $3"
  else
    echo "not ok - $3: status $status, $said"
    failed=1
  fi
}

run='echo "[ RUN      ] A.Test"'
passes="$run; echo '[       OK ] A.Test (1 ms)'"
expect 0 'OK ] A.Test' 'tests that pass' "$passes; $passes"
expect 0 'SKIPPED' 'a test that is skipped' "$run; echo '[  SKIPPED ] A.Test (1 ms)'"
expect 0 '' 'a shard without tests' ':'
expect 1 'FAILED  ] A.Test' 'a test that fails' "$run; echo '[  FAILED  ] A.Test (1 ms)'; exit 1"
expect 1 'not done after 1 s, in A.Test (1000 ms)' 'a test that hangs' \
  "$passes; $run; exec sleep 30"
expect 1 '2 tests began, 1 ended, exit status 0 (0 ms)' 'a program that ends amid its tests' \
  "$passes; $run; exit 0"
expect 1 '1 tests began, 0 ended, exit status 139 (0 ms)' 'a program that crashes' \
  "$run; exit 139"
exit "$failed"
