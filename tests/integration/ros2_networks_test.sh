#!/bin/bash
# Which networks meet drover-ros2 in "network", where the robot has two: network namespaces with a
# wire each play the computers behind them.
#   ros2_networks_test.sh DROVER_ROS2 ROS2_VISIT DROVERD DROVER SOURCE_FOLDER
# prints "ok - " or "not ok - "
set -euo pipefail

program=$1
visit=$2
droverd=$3
drover=$4
source=$5
# shellcheck source=tests/integration/namespaces.sh
. "$(dirname "$0")/namespaces.sh" "$@"

sleeps() { [[ $(< "/proc/$1/comm") == sleep ]]; }  # in the network of its own
declare -A computer
connect() {  # NAME NUMBER: a computer behind an interface of the robot's
  unshare -n sleep 600 &
  computer[$1]=$!
  children+=("$!")
  within 30 sleeps "${computer[$1]}"
  ip link add "$1" type veth peer name wire netns "${computer[$1]}"
  nsenter -n -t "${computer[$1]}" bash -c \
    "ip link set lo up; ip address add 10.9.$2.2/24 dev wire; ip link set wire up"
  ip address add "10.9.$2.1/24" dev "$1"
}

# A line of standard error, so many times at least.
said() { [[ $(grep -c "$1" "$folder/log" || true) -ge ${2:-1} ]]; }
tells() {  # WHAT IS JUDGED, LINE [TIMES]: soon
  judge "$(within 10 said "${@:2}"; echo $?)" "$1"
}
start() {  # MORE [MODE]
  local ros2="\"ros2\": {\"mode\": \"${2:-network}\", \"network_inputs\": true$1"
  ros2+=", \"inputs\": {\"e_stop\": true}}"
  local paths="\"paths\": {\"run\": \"$folder\", \"state\": \"$folder\"}"
  sed "0,/^{/s||{ $ros2, $paths,|" "$source/config/examples/two_hub_motors.json" \
    > "$folder/drover.json"
  "$program" --config "$folder/drover.json" 2> "$folder/log" &
  running=$!
  children+=("$running")
  within 10 said "domain 0: "
}
end() {
  kill "$running"
  wait "$running" || true
}

visits() {  # WHERE USER SECONDS: a program that sees the robot and says stop
  local run=("$visit" "$2" "$3")
  [[ $1 == here ]] || run=(nsenter -n -t "${computer[$1]}" "${run[@]}")
  "${run[@]}" 2> /dev/null
}
# Who sees the robot is also heard, and nobody else is.
meets() {  # CONFIGURATION WHERE USER SECONDS
  start "$1"
  local seen=0 heard=0
  visits "${@:2}" || seen=1
  within 1 said "an emergency stop was asked for" || heard=1
  end
  [[ $seen$heard == 00 ]] && return 0
  [[ $seen$heard == 11 ]] && return 1
  return 2
}
met() { judge "$(meets "$1" "$2" "$3" 20 > /dev/null; echo $?)" "$4 sees the robot and stops it"; }
not_met() {
  judge "$([[ $(meets "$1" "$2" "$3" 3 > /dev/null; echo $?) == 1 ]]; echo $?)" \
    "$4 neither sees the robot nor stops it"
}

ip link set lo up
connect one 1
connect two 2

start ""
tells "without a network it says so" \
  "domain 0: no network is there yet: programs on this computer see this robot"
tells "and who may stop it" "programs on this computer may stop this robot"
ip link set one up
tells "a network that appears later is used" \
  "domain 0: whoever reaches one 10.9.1.1 sees this robot"
ip link set two up
tells "a second one is named as one that is not" \
  "not used: two 10.9.2.1: nobody there sees this robot or stops it"
ip link set two down
tells "when it goes that is said" \
  "the networks have changed: one 10.9.1.1$" 2
judge "$([[ $(grep -c "domain 0: " "$folder/log") == 2 ]]; echo $?)" \
  "for its sake the domain is not made anew"

# droverd hears of it: without drives and receiver, which it waits for.
"$droverd" --config "$folder/drover.json" 2> "$folder/droverd.log" &
children+=("$!")
shows() { "$drover" --socket "$folder/drover.sock" status | grep -qE "^ros2 +network +$1\$"; }
shown() {  # WHAT IS JUDGED, PATTERN
  judge "$(within 20 shows "$2"; echo $?)" "drover status shows $1"
}
shown "the network in use" "one 10\.9\.1\.1 +0 readers"
ip link set two up
shown "one that is not used" "one 10\.9\.1\.1 +0 readers +NOT ON two 10\.9\.2\.1"
ip link set one down
ip link set two down
shown "that none is there" "NONE IS THERE: this computer only +0 readers"
ip link set one up
end

ip link set two up
sleep 0.5
met "" one defaults "a program on the network in use"
met "" here humble "one on this computer, on loopback"
met "" here jazzy "one on this computer, told to stay there as Jazzy does"
met "" here defaults "one on this computer with its defaults"
not_met "" two defaults "a program on the other network"

choice=', "interface": "two"'
met "$choice" two defaults "with the other network chosen, a program there"
met "$choice" here humble "then one on this computer, on loopback,"
not_met "$choice" one defaults "then a program on the first network"

start ', "interface": "three"'
tells "a chosen network that is not there is waited for" \
  "the network of ros2.interface, three, is not there yet: programs on this computer"
connect three 3
ip link set three up
tells "and used when it comes" \
  "domain 0: whoever reaches three 10.9.3.1 sees this robot"
visits three defaults 20 && within 1 said "an emergency stop was asked for"
judge $? "and a program there sees the robot and stops it"
end

# In localhost a network that appears later is one that programs here may be told to use.
for name in one two three; do ip link set "$name" down; done
start "" localhost
ip link set one up
tells "in localhost, too, a network that appears later is picked up" \
  "the networks have changed: one 10.9.1.1"
visits here jazzy 20 && within 1 said "an emergency stop was asked for"
judge $? "and a program here that is told to stay here as Jazzy does sees the robot and stops it"
end
exit "$failed"
