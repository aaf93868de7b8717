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
  "links": {"can0": {"can": "can0"}},
  "devices": {"a": {"driver": "odrive", "link": "can1", "options": {"node": 1}}},
  "groups": {"base": {"kind": "skid_steer", "wheel_radius_mm": 165, "track_m": 0.6,
                      "hold": "brake", "left": ["a"], "right": ["b"]}}
}
JSON

expect "an argument nobody knows ends with 2" 2 "--nope" --nope
expect "an option without its value ends with 2" 2 "--check" --check
expect "a file that is not there ends with 2" 2 \
  "$work/none.json: cannot be read: No such file or directory" --check "$work/none.json"
expect "an empty name is a file that is not there" 2 "cannot be read" --check ""
expect "a bad file ends with 2" 2 "4 problems" --check "$work/bad.json"
expect "a problem has file, line, column, path and suggestion" 2 \
  "bad.json:4:45: groups.base.wheel_radius_mm: is no known key (did you mean \"wheel_radius_m\"?)" \
  --check "$work/bad.json"
expect "starting with a bad file ends with 2 and says the same" 2 \
  "$work/bad.json:3:49: devices.a.link: there is no link named \"can1\"" --config "$work/bad.json"
expect "the example is good" 0 "good: 5 link(s), 11 device(s), 4 joint(s)" \
  --check "$(dirname "$0")/../../../config/drover.json"
printf '{"buses": [{"name": "can7", "interface": "can7"}]}\n' > "$work/old.json"
expect "an old section is refused" 2 "old.json:1:2: buses: is no key any more" \
  --check "$work/old.json"
expect "and its new text is printed" 2 '"can7": {"can": "can7"}' --check "$work/old.json"
expect "the schema is printed" 0 "json-schema.org/draft-07" --schema
expect "the version is printed" 0 "." --version
expect "the help is printed" 0 "--check" --help
sed 's|^{|{ "paths": {"run": "'"$work"'/none/run"},|' \
  "$(dirname "$0")/../../../config/examples/two_hub_motors.json" > "$work/no_folder.json"
expect "a folder that is not there is told with who makes it" 2 \
  "$work/none/run: cannot make this folder: No such file or directory (systemd-tmpfiles --create" \
  --config "$work/no_folder.json"
exit "$failed"
