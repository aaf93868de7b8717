#!/usr/bin/env bash
# What droverd says and with which status it ends when only its command line is used.
# usage: droverd_command_line_test.sh PATH-OF-DROVERD
set -uo pipefail

droverd=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# expect SENTENCE STATUS TEXT ARGUMENTS...: status and a piece of the output.
expect() {
  local sentence=$1 status=$2 text=$3 got=0
  shift 3
  "$droverd" "$@" > "$work/out" 2>&1 || got=$?
  if [[ $got == "$status" ]] && grep -qF -- "$text" "$work/out"; then
    echo "ok - $sentence"
  else
    echo "not ok - $sentence: status $got, wanted $status and \"$text\" in:"
    sed 's/^/  /' "$work/out"
    failed=1
  fi
}

cat > "$work/bad.json" <<'JSON'
{
  "buses": [{"name": "can0", "interface": "can0"}],
  "drives": [{"joint": "a", "driver": "odrive", "bus": "can1", "options": {"node": 1}}],
  "base": {"wheel_radius_mm": 165, "track_m": 0.6, "hold": "brake", "left": ["a"], "right": ["b"]}
}
JSON

expect "an argument nobody knows ends with 2" 2 "--nope" --nope
expect "an option without its value ends with 2" 2 "--check" --check
expect "a file that is not there ends with 2" 2 \
  "$work/none.json: cannot be read: No such file or directory" --check "$work/none.json"
expect "an empty name is a file that is not there" 2 "cannot be read" --check ""
expect "a bad file ends with 2" 2 "4 problems" --check "$work/bad.json"
expect "a problem has file, line, column, path and suggestion" 2 \
  "$work/bad.json:4:12: base.wheel_radius_mm: is no known key (did you mean \"wheel_radius_m\"?)" \
  --check "$work/bad.json"
expect "starting with a bad file ends with 2 and says the same" 2 \
  "$work/bad.json:3:56: drives[0].bus: there is no bus named \"can1\"" --config "$work/bad.json"
expect "the example is good" 0 "good: 1 bus(es), 4 drive(s)" \
  --check "$(dirname "$0")/../../../config/drover.json"
expect "the schema is printed" 0 "json-schema.org/draft-07" --schema
expect "the version is printed" 0 "." --version
expect "the help is printed" 0 "--check" --help
exit "$failed"
