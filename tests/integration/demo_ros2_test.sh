#!/bin/bash
# sim/demo --keep --ros2 as a person uses it: the robot is in the lab, and a ROS 2 program on the
# host hears it by the line that src/ros2/README.md has for it; after Ctrl-C nothing is left.
# BUILD_FOLDER is build, as sim/demo finds it.
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
  if [[ $? == 0 ]]; then echo "ok - $1"; else echo "not ok - $1"; failed=1; fi
}

mkdir "$folder/tmp"
export TMPDIR=$folder/tmp
export ROS_DOMAIN_ID=$((100 + $$ % 100))  # nobody else's
# A process group of its own, which gets the Ctrl-C of a terminal.
set -m
sim/demo --keep --ros2 -y --logs "$folder/logs" two_wheels > "$folder/out" 2>&1 < /dev/null &
demo=$!
set +m

# From the beginning on, too: it need not be over.
for _ in {1..600}; do
  if grep -qs 'tells of the robot' "$folder/logs/drover-ros2.log"; then break; fi
  kill -0 "$demo" 2> /dev/null || break
  sleep 0.5
done
# In a shell that is told no more than the README's line.
(
  line=$(sed -n 's/^    \(export ROS_LOCALHOST_ONLY=1\) .*/\1/p' src/ros2/README.md)
  [[ -n $line ]] && eval "$line" && build/tests/integration/ros2_hear 100
)
check "a ROS 2 program on the host hears the robot in the lab"
for _ in {1..240}; do
  if grep -q 'ros2 topic echo' "$folder/out" || ! kill -0 "$demo" 2> /dev/null; then break; fi
  sleep 0.5
done
grep -q 'ros2 topic echo' "$folder/out"
check "it says after the summary how it is seen"

kill -INT -- "-$demo"
wait "$demo"
[[ $? == 0 || $? == 130 ]]
check "it ends by Ctrl-C"
sleep 1
! pgrep -af "$folder|drover-scenario .*gateway.ros2"
check "no process is left"
[[ -z $(ls -A "$folder/tmp") ]]
check "no folder is left"
if [[ $failed != 0 ]]; then
  tail -n 40 "$folder/out" "$folder/logs/drover-ros2.log" | sed 's/^/   | /'
fi
exit $failed
