#!/bin/bash
# Who reaches drover-ros2: in "localhost" no datagram from another computer is heard, on no port,
# also when a network appears later; in "network" they are. Two network namespaces with a wire
# between play two computers.
#   ros2_closed_test.sh DROVER_ROS2 SOURCE_FOLDER    prints "ok - " or "not ok - "
set -euo pipefail

program=$1
source=$2
# shellcheck source=tests/integration/namespaces.sh
. "$(dirname "$0")/namespaces.sh" "$@"

configuration() {  # MODE
  local ros2="\"ros2\": {\"mode\": \"$1\", \"network_inputs\": true"
  ros2+=", \"inputs\": {\"e_stop\": true}}"
  local paths="\"paths\": {\"run\": \"$folder\", \"state\": \"$folder\"}"
  sed "0,/^{/s||{ $ros2, $paths,|" "$source/config/examples/two_hub_motors.json" > "$folder/$1.json"
}

# The other computer.
unshare -n sleep 300 &
other=$!
children+=("$other")
there() { nsenter -n -t "$other" "$@"; }
ip link set lo up
echo 0 > /proc/sys/net/ipv4/icmp_ratelimit  # each refusal is told
within 5 ip link add wire type veth peer name wire netns "$other"
there ip address add 10.9.0.2/24 dev wire
there ip link set wire up

# How many datagrams to this port were dropped.
dropped() {  # PORT
  awk -v port="$(printf :%04X "$1")" '$2 ~ port "$" { n += $NF } END { print n + 0 }' /proc/net/udp
}
# Whether a datagram that comes over the wire reaches a socket: the second one to a port without one
# the kernel refuses, and what a socket's filter does not let in it counts as dropped.
hears() {  # PORT
  local before
  before=$(dropped "$1")
  there bash -c '
    exec 3<> "/dev/udp/10.9.0.1/$0"
    for i in 1 2 3; do echo x >&3 || exit 1; sleep 0.02; done' "$1" 2> /dev/null || return 1
  (($(dropped "$1") - before < 3))
}
# Every one that is open in this computer: there is no other program.
ports() { awk 'NR > 1 { split($2, at, ":"); print at[2] }' /proc/net/udp | sort -u; }
heard_ports() {
  local port
  for port in $(ports); do ! hears $((16#$port)) || echo $((16#$port)); done
}
# A line of standard error, so many times at least.
said() { [[ $(grep -c "$2" "$folder/$1.log" || true) -ge ${3:-1} ]]; }
start() {
  configuration "$1"
  "$program" --config "$folder/$1.json" 2> "$folder/$1.log" &
  running=$!
  children+=("$running")
}

start localhost
within 10 said localhost "programs on this computer"
judge $? "a domain is made without a network"
ip address add 10.9.0.1/24 dev wire
ip link set wire up
within 10 said localhost "the networks have changed: wire 10.9.0.1" &&
  within 10 said localhost "programs on this computer" 2
judge $? "a network that appears later is picked up"
judge "$([[ $(ports | wc -l) -ge 2 ]]; echo $?)" "it has sockets: $(ports | wc -l)"
heard=$(heard_ports)
judge "$([[ -z $heard ]]; echo $?)" \
  "in localhost nothing from another computer is heard${heard:+, but on $heard}"
kill "$running"
wait "$running" || true

start network
within 10 said network "whoever reaches wire 10.9.0.1 sees this robot"
judge $? "in network it says who sees the robot"
judge "$(said network "whoever reaches this network may stop this robot"; echo $?)" \
  "and who may stop it"
heard=$(heard_ports | wc -l)
judge "$([[ $heard -ge 2 ]]; echo $?)" "in network the other computer is heard, on $heard ports"
kill "$running"
wait "$running"
judge $? "it ends as asked"
exit "$failed"
