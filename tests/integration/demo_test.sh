#!/bin/bash
# The README's first command as a person uses it: drives to the summary, goes on while looked at,
# and leaves nothing behind after Ctrl-C.  BUILD_FOLDER is build, as sim/demo finds it.
set -uo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." || exit 1

folder=$(mktemp -d -p "$([[ -w /dev/shm ]] && echo /dev/shm || echo /tmp)")
demo=
finish() {
  [[ -z $demo ]] || kill -KILL -- "-$demo" 2> /dev/null
  rm -rf "$folder"
}
trap finish EXIT

failed=0
check() {  # WHAT: the last command's status decides
  if [[ $? == 0 ]]; then echo "ok   $1"; else echo "FAIL $1"; failed=1; fi
}
number() { sed -n "s/.*\"$1\": *\([-0-9.e]*\).*/\1/p" "$folder/logs/summary.json"; }
below() { awk -v value="$1" -v limit="$2" 'BEGIN { exit !(value != "" && value < limit) }'; }

mkdir "$folder/tmp"
export TMPDIR=$folder/tmp
# A process group of its own, which gets the Ctrl-C of a terminal.
set -m
sim/demo --keep -y --logs "$folder/logs" > "$folder/out" 2>&1 < /dev/null &
demo=$!
set +m

port=
for _ in {1..300}; do
  port=$(sed -n 's/.*mosquitto_sub -h 127.0.0.1 -p \([0-9]*\) .*/\1/p' "$folder/out")
  if [[ -n $port ]] || ! kill -0 "$demo" 2> /dev/null; then break; fi
  sleep 1
done
grep -q '^NAV_SUCCESS$' "$folder/out"
check "the mission ends in NAV_SUCCESS"
grep -A 6 '^demo$' "$folder/out"
below "$(number cross_track_rms_m)" 0.05
check "cross-track RMS is under 5 cm"
below "$(number goal_distance_m)" 0.10
check "the goal is nearer than 10 cm"

# The map after the drive: what it came past, by its names.
shown() { grep -q -- "$1" "$folder/out"; }
shown '█  box' && shown '▒pond▒' && shown '●  person' && shown '•ww*•'
check "the map shows the box, the keep-out, the person and where the robot waited"
shown '^ *the robot waits: person is in the way, .* m' && shown '^ *the robot goes on after'
check "it tells that it waits for the person and that it goes on"
waited=$(number time_s | sed -n 2p)
below 1 "$waited" && below "$waited" 10
check "it waited for a few seconds: ${waited:-never}"
grep -q 'watching' "$folder/logs/objects.log" && ! grep -w 'touch' "$folder/logs/objects.log" &&
  shown '^  touched  *nothing$'
check "it touched nothing, says the mechanics"

timeout 60 mosquitto_sub -h 127.0.0.1 -p "${port:-1}" -i demo-test -t base_status -C 201 -F %U \
  > "$folder/times"
rate=$(awk 'NR == 1 { first = $1 } { last = $1 }
            END { if (NR == 201) printf "%.3f", 200 / (last - first) }' "$folder/times")
echo "base_status as seen from outside: ${rate:-nothing} a second"
awk -v rate="${rate:-0}" 'BEGIN { exit !(rate >= 9.9 && rate <= 10.1) }'
check "base_status comes 10 times a second, within 1 %"

# What sim/README.md shows: another program tells of a crate, and that it is gone.
tell() { mosquitto_pub -h 127.0.0.1 -p "${port:-1}" -q 1 -t collision_object "$@"; }
timeout 30 mosquitto_sub -h 127.0.0.1 -p "${port:-1}" -q 1 -t scene_feedback -C 2 \
  > "$folder/answers" &
listener=$!
sleep 1
tell -f config/scene/object_box.json
tell -m '{"id": "crate", "operation": 1}'
wait "$listener"
diff - "$folder/answers" << 'TEXT'
{"topic":"collision_object","id":"crate","seq":1,"operation":"ADD","result":"done"}
{"topic":"collision_object","id":"crate","operation":"REMOVE","result":"done"}
TEXT
check "other programs tell of objects and are answered"

kill -INT -- "-$demo"
wait "$demo"
[[ $? == 0 || $? == 130 ]]
check "it ends by Ctrl-C"
sleep 1
! pgrep -af "$folder/logs|drover-scenario .*--keep"
check "no process is left"
[[ -z $(ls -A "$folder/tmp") ]] && ! grep -ls -- "$folder" "/tmp/drover-lab-$EUID"/*/info
check "no folder is left"
[[ $failed == 0 ]] || tail -n 40 "$folder/out" | sed 's/^/   | /'
exit $failed
