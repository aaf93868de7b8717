#!/bin/bash
# The lab keeps its promises: status, output, clock, links, repeatability, and no traces.
# Prints one line per sentence; exit status 1 when any failed, 3 when the lab cannot run here.
set -uo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
lab=$root/sim/lab
build=$(readlink -m "${DROVER_BUILD:-$root/build}")
work=$(mktemp -d)
# Only the main shell cleans up, not a child that is killed between fork and exec.
trap '[[ $BASHPID != "$$" ]] || rm -rf "$work"' EXIT
failed=0

# check SENTENCE COMMAND...: the command's status says whether the sentence is true.
check() {
  local sentence=$1
  shift
  if "$@" > "$work/check.out" 2>&1; then
    echo "ok - $sentence"
  else
    echo "not ok - $sentence"
    sed 's/^/  # /' "$work/check.out"
    failed=1
  fi
}

equal() {
  [[ $1 == "$2" ]] && return 0
  printf 'got:  %q\nwant: %q\n' "$1" "$2"
  return 1
}

status_of() {
  "$@" > /dev/null 2> "$work/stderr"
  echo $?
}

refuses_wrong_usage() {
  equal "$(status_of "$lab")" 2 &&
    equal "$(status_of "$lab" --no-such-option -- true)" 2 &&
    equal "$(status_of "$lab" --seed x -- true)" 2 &&
    equal "$(status_of "$lab" --host-port 0 -- true)" 2 &&
    equal "$(status_of "$lab" --real-time --second-port 0 -- true)" 2 &&
    equal "$(status_of "$lab" --can ethernet -- true)" 2
}

refuses_a_missing_command() { equal "$(status_of "$lab" -- /no/such/program)" 127; }

reports_a_dead_kernel() {
  # Process 1 cannot survive the removal of its own memory.
  equal "$(status_of "$lab" --memory 4M -- true)" 125 &&
    grep -q 'ended without a status' "$work/stderr"
}

ends_at_the_timeout() {
  local before=$SECONDS
  equal "$(status_of "$lab" --real-time --timeout 2 -- sleep 600)" 124 &&
    [[ $((SECONDS - before)) -lt 60 ]] && grep -q 'timeout' "$work/stderr"
}

carries_the_exit_status() {
  equal "$(status_of "$lab" -- true)" 0 &&
    equal "$(status_of "$lab" -- sh -c 'exit 7')" 7 &&
    equal "$(status_of "$lab" -- sh -c 'kill -KILL $$')" 137
}

carries_output_exactly() {
  local script='printf "a\nb\r\n\tc\001\377"; printf "to stderr\n" >&2'
  "$lab" -- sh -c "$script" > "$work/out" 2> "$work/err"
  sh -c "$script" > "$work/want_out" 2> "$work/want_err"
  cmp "$work/out" "$work/want_out" && cmp "$work/err" "$work/want_err"
}

carries_much_output() {
  local script='seq 300000'
  equal "$("$lab" -- sh -c "$script" | sha256sum)" "$(sh -c "$script" | sha256sum)"
}

keeps_a_shared_stream_in_order() {
  local script='for i in 1 2 3; do echo out$i; echo err$i >&2; done'
  equal "$("$lab" -- sh -c "$script" 2>&1)" "$(sh -c "$script" 2>&1)"
}

is_a_terminal_only_on_a_terminal() {
  equal "$("$lab" -- sh -c '[ -t 1 ] && echo yes || echo no')" no &&
    equal "$(script -qec "'$lab' -- sh -c '[ -t 1 ] && echo yes'" /dev/null < /dev/null |
      tr -d '\r')" yes
}

ends_with_its_command_though_children_stay() {
  equal "$("$lab" --timeout 60 -- sh -c 'sleep 1000000000 & echo ended')" ended
}

exports_the_seed() {
  # shellcheck disable=SC2016
  equal "$("$lab" --seed 42 -- sh -c 'echo $DROVER_SEED')" 42 &&
    equal "$("$lab" -- sh -c 'echo $DROVER_SEED')" 1
}

runs_in_the_callers_folder() {
  mkdir -p "$work/folder" && echo here > "$work/folder/file" &&
    equal "$(cd "$work/folder" && "$lab" -- cat file)" here
}

cannot_write_to_the_host() {
  "$lab" -- sh -c "touch '$work/folder/written' '$root/written'" > /dev/null 2>&1
  [[ ! -e $work/folder/written && ! -e $root/written ]]
}

sleeps_in_virtual_time() {
  local wall_before=$SECONDS out
  out=$("$lab" -- sh -c 'a=$(date +%s%N); sleep 3600; b=$(date +%s%N); echo $((b - a)) $a')
  read -r slept_ns start_ns <<< "$out"
  # Starting a process moves the clock by no more than a few timer ticks.
  [[ $slept_ns -ge 3600000000000 && $slept_ns -lt 3600100000000 ]] &&
    equal "${start_ns:0:9}" 176722560 && [[ $((SECONDS - wall_before)) -lt 60 ]]
}

# bash reads its clock without entering the kernel, date in a process of its own.
shows_one_clock() {
  equal "$("$lab" -- bash -c 'date -s @2000000000 > /dev/null; sleep 5; echo $EPOCHSECONDS; date +%s
      sleep 0.25; b=${EPOCHREALTIME/./}; sleep 0.5; echo $(((${EPOCHREALTIME/./} - b) / 1000))')" \
    $'2000000005\n2000000005\n500'
}

# A wait by looking: read -t 0 asks select.
moves_the_clock_at_each_look() {
  # shellcheck disable=SC2016
  "$lab" --timeout 60 -- bash -c 'a=$EPOCHREALTIME; while [[ $EPOCHREALTIME == "$a" ]]; do
    read -t 0 || :; done'
}

# Or a program that is built in another way, and makes other calls, goes through other times.
takes_no_time_for_other_calls() {
  # shellcheck disable=SC2016
  equal "$("$lab" --timeout 60 -- bash -c 'printf . > /dev/null; a=$EPOCHREALTIME
      for i in {1..100}; do printf . > /dev/null; umask 022; done
      [[ $EPOCHREALTIME == "$a" ]] && echo none')" none
}

passes_can_frames() {
  equal "$("$lab" -- sh -c 'candump -n 2 can0 & p=$!; sleep 0.1
      cansend can0 123#11223344; cansend can0 1F334455#; wait $p')" \
    $'  can0  123   [4]  11 22 33 44\n  can0  1F334455   [0] '
}

passes_can_fd_frames() {
  "$lab" --can canfd -- sh -c 'candump -n 1 can1 & p=$!; sleep 0.1
    cansend can1 123##100112233445566778899AABB; wait $p' > "$work/fd"
  grep -q '\[12\]  00 11 22 33 44 55 66 77 88 99 AA BB' "$work/fd"
}

makes_no_can_when_told() {
  equal "$("$lab" --can none -- sh -c 'ls /sys/class/net | grep -c can')" 0
}

shows_gpio_edges() {
  # shellcheck disable=SC2016
  "$lab" -- sh -c 'gpiomon -n 2 -F "%o %e %s.%n" $(gpiofind estop) > /tmp/edges & p=$!; sleep 0.1
    cd "$DROVER_GPIO/sim_gpio0"; echo pull-up > pull; sleep 0.01; echo pull-down > pull
    wait $p; cat /tmp/edges; gpioget $(gpiofind bumper)
    gpioset -m time -s 1 $(gpiofind lamp)=1 & sleep 0.5; cat ../sim_gpio5/value' > "$work/g"
  sed 's/ [0-9.]*$//' "$work/g" | tr '\n' ',' > "$work/edges"
  equal "$(< "$work/edges")" '0 1,0 0,0,1,'
}

traffic='candump -ta -n 300 can0 can1 > $DROVER_LOGS/can.log & p=$!; sleep 0.1
  cangen can0 -g 3 -I i -D i -L 8 -n 200 & cangen can1 -g 7.5 -I 7 -D i -L 4 -n 100 & wait $p
  date +%s.%N; cat /proc/uptime'

repeats_itself_to_the_byte() {
  mkdir -p "$work/1" "$work/2"
  "$lab" --keep-logs "$work/1" -- sh -c "$traffic" > "$work/1/out"
  "$lab" --keep-logs "$work/2" -- sh -c "$traffic" > "$work/2/out"
  [[ $(wc -l < "$work/1/can.log") == 300 ]] && cmp "$work/1/can.log" "$work/2/can.log" &&
    cmp "$work/1/out" "$work/2/out"
}

keeps_logs() {
  # shellcheck disable=SC2016
  "$lab" --keep-logs "$work/logs dir" -- sh -c 'mkdir $DROVER_LOGS/a; seq 100000 > $DROVER_LOGS/a/b'
  seq 100000 | cmp - "$work/logs dir/a/b" && grep -q 'Linux version' "$work/logs dir/kernel.log"
}

# Other labs may run at the same time, so only what carries the id of this one counts.
no_trace_of() {
  local folder=/tmp/drover-lab-$EUID/$1
  [[ ! -e $folder ]] || { echo "$folder is still there"; return 1; }
  ! pgrep -af "$folder/init"
}

leaves_nothing() {
  local id
  "$lab" -- true & id=$!
  wait "$id" && no_trace_of "$id" || return 1
  "$lab" --real-time --timeout 1 -- sleep 600 2> /dev/null & id=$!
  wait "$id"
  no_trace_of "$id" || return 1
  "$lab" --real-time -- sleep 601 & id=$!
  sleep 2
  kill -INT "$id"
  wait "$id"
  equal $? 130 && no_trace_of "$id" || return 1
  "$lab" --real-time -- sleep 602 & id=$!
  sleep 2
  kill -KILL "$id"
  wait "$id" 2> /dev/null
  "$lab" -- true  # removes the folder that the killed one could not
  no_trace_of "$id"
}

ends_when_its_reader_leaves() {
  equal "$("$lab" --timeout 60 -- sh -c 'while :; do echo line; done' | head -n 1)" line
}

reaches_a_broker_inside() {
  command -v passt mosquitto mosquitto_pub mosquitto_sub > /dev/null || { echo missing; return 1; }
  printf 'listener 1883\nallow_anonymous true\n' > "$work/mosquitto.conf"
  "$lab" --real-time --host-port 0 --timeout 30 --keep-logs "$work/net" -- sh -c \
    "mosquitto -c '$work/mosquitto.conf' & while :; do sleep 0.2
     mosquitto_pub -i p -t greeting -m hello; done" > /dev/null 2>&1 &
  local running=$! heard=''
  for _ in {1..40}; do
    sleep 0.25
    [[ -s $work/net/host-port ]] || continue
    heard=$(mosquitto_sub -i s -W 2 -C 1 -p "$(< "$work/net/host-port")" -t greeting) && break
  done
  kill "$running"
  wait "$running"
  equal "$heard" hello
}

lets_a_visitor_in() {
  "$lab" --real-time --shell-socket --timeout 30 -- sleep 25 > /dev/null 2> "$work/visit.err" &
  local running=$!
  sleep 2
  grep -q "^$running  real time.*second console: sleep 25" <<< "$("$lab" list)" || return 1
  printf 'echo in""side $((6*7)); cat /proc/1/comm; exit\r' > "$work/keys"
  # The keys come after the prompt, as a person's would.
  { sleep 3; cat "$work/keys"; sleep 3; } |
    script -qec "'$lab' enter $running" /dev/null > "$work/visit"
  kill "$running"
  wait "$running"
  grep -q 'inside 42' "$work/visit" && grep -q '^init' "$work/visit"
}

lets_several_visitors_in() {
  "$lab" --real-time --shell-socket --timeout 40 -- sleep 35 > /dev/null 2>&1 &
  local running=$! visitor visitors=()
  sleep 2
  for visitor in 1 2; do
    # The second comes while the first is inside, and sees a shell of its own.
    { sleep $((2 + visitor))
      # shellcheck disable=SC2016
      printf 'echo in""side $((40+%d))\r' "$visitor"
      sleep 4
      printf 'exit\r'
      sleep 1; } | script -qec "'$lab' enter $running" /dev/null > "$work/visit$visitor" &
    visitors+=($!)
  done
  wait "${visitors[@]}"
  kill "$running"
  wait "$running"
  grep -q 'inside 41' "$work/visit1" || return 1
  grep -q 'inside 42' "$work/visit2" || return 1
  ! grep -q 'inside 42' "$work/visit1"
}

guards_real_can_interfaces() {
  "$lab" --timeout 60 -- "$build/tests/integration/integration_guard" \
    --gtest_filter='GuardInTheLab.*' --gtest_brief=1
}

# A robot, and a person at its terminal, for three minutes.
drives_a_whole_calibration() {
  "$lab" --timeout 900 -- "$build/tests/integration/integration_daemon" \
    --gtest_filter=CalibrationDriveProcess.FindsWhatIsConfiguredWrong > "$work/drive.out" 2>&1 &&
    grep -q '^\[  PASSED  \] 1 test' "$work/drive.out" && return
  cat "$work/drive.out"
  return 1
}

status=$(status_of "$lab" --build)
if [[ $status == 3 ]]; then
  cat "$work/stderr"
  exit 3
fi
check "refuses wrong usage" refuses_wrong_usage
check "refuses a missing command" refuses_a_missing_command
check "reports a kernel that died" reports_a_dead_kernel
check "ends at the timeout" ends_at_the_timeout
check "carries the exit status" carries_the_exit_status
check "carries output exactly" carries_output_exactly
check "carries much output" carries_much_output
check "keeps a shared stream in order" keeps_a_shared_stream_in_order
check "is a terminal only on a terminal" is_a_terminal_only_on_a_terminal
check "ends with its command though children stay" ends_with_its_command_though_children_stay
check "ends when its reader leaves" ends_when_its_reader_leaves
check "exports the seed" exports_the_seed
check "runs in the caller's folder" runs_in_the_callers_folder
check "cannot write to the host" cannot_write_to_the_host
check "sleeps in virtual time" sleeps_in_virtual_time
check "shows one clock, also after it was set" shows_one_clock
check "moves the clock whenever a program looks for input" moves_the_clock_at_each_look
check "takes no time for other calls" takes_no_time_for_other_calls
check "passes CAN frames" passes_can_frames
check "passes CAN FD frames" passes_can_fd_frames
check "makes no CAN when told" makes_no_can_when_told
check "shows GPIO edges" shows_gpio_edges
check "repeats itself to the byte" repeats_itself_to_the_byte
check "keeps logs" keeps_logs
check "gives the guard CAN sockets that hear nothing, and a way to what was down" \
  guards_real_can_interfaces
check "loses no frame of a bus at saturation, on the way to the engine neither" \
  "$root/tests/bench/bus" --check --build "$build"
check "drives a whole calibration at a terminal" drives_a_whole_calibration
check "reaches a broker inside from the host" reaches_a_broker_inside
check "lets a visitor in" lets_a_visitor_in
check "lets several visitors in" lets_several_visitors_in
check "leaves nothing behind" leaves_nothing
exit $failed
