#!/usr/bin/env bash
# What drover says of its command line, and when there is no droverd.
# usage: drover_command_line_test.sh PATH-OF-DROVER
set -uo pipefail

drover=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
export DROVER_SOCKET=$work/no-daemon.sock

verdict() {  # STATUS SENTENCE
  if [[ $1 == 0 ]]; then
    echo "ok - $2"
  else
    echo "not ok - $2:"
    sed 's/^/  /' "$work/out" "$work/err"
    failed=1
  fi
}

# expect SENTENCE STATUS FILE TEXT ARGUMENTS...: status, and a piece of what goes to out or err.
expect() {
  local sentence=$1 status=$2 file=$3 text=$4 got=0
  shift 4
  "$drover" "$@" > "$work/out" 2> "$work/err" || got=$?
  [[ $got == "$status" ]] && grep -qF -- "$text" "$work/$file"
  verdict $? "$sentence"
}

# The verbs as the help lists them: "  name   text".
verbs() { "$drover" "$@" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p'; }

every_verb_has_an_example() {
  local verb inner
  for verb in $(verbs); do
    "$drover" "$verb" --help > "$work/out" 2> "$work/err"
    grep -A1 '^Examples:' "$work/out" | grep -qE "^  drover $verb( |\$)"
    verdict $? "the help of $verb has an example of its own"
    for inner in $(verbs "$verb"); do
      "$drover" "$verb" "$inner" --help > "$work/out" 2> "$work/err"
      grep -A1 '^Examples:' "$work/out" | grep -qE "^  drover $verb $inner( |\$)"
      verdict $? "the help of $verb $inner has an example of its own"
    done
  done
}

every_verb_has_an_example
[[ $(verbs | wc -l) -gt 10 ]]
verdict $? "the help lists the verbs"

expect "the version is printed as droverd prints its own" 0 out "." --version
[[ "drover $("$drover" --version)" == "$("$drover" version 2> /dev/null | head -1)" ]]
verdict $? "it is the one that the verb tells"

expect "an unknown verb is answered with the one that may be meant" 2 err \
  'no verb "statsu"; did you mean "status"?' statsu
expect "so is an unknown verb of a verb" 2 err \
  'no verb "task strat"; did you mean "start"?' task strat 'row 7' --id 1
expect "a verb that is like none is answered with all" 2 err 'there are ' fly
expect "a slip is told from a word that means another thing" 2 err \
  'no verb "unhold"; there are ' unhold
expect "what people call it elsewhere is told" 2 err 'did you mean "bms"?' battery
expect "a verb of a verb is told with the first one" 2 err 'did you mean "task cancel"?' cancel
expect "a verb that wants another one is answered with those that there are" 2 err \
  'drover: "task" wants one of: start, cancel' task
expect "what a verb lacks is told with the verb" 2 err \
  'drover: "task start": --id is required; see: drover task start --help' task start 'row 7'
expect "without any verb it says where they are" 2 err 'see: drover --help'
expect "help is a verb, too" 0 out 'drover stop' help stop
expect "also alone" 0 out 'Examples:' help
expect "the value of --socket is no verb" 3 err 'other.sock' --socket "$work/other.sock" status
for verb in status 'traj list' stop version; do
  status=3 file=err
  [[ $verb == version ]] && status=0 file=out
  # shellcheck disable=SC2086
  expect "--socket stands behind $verb, too" $status $file 'other.sock' \
    $verb --socket "$work/other.sock"
done
expect "also between two verbs" 3 err 'other.sock' traj --socket "$work/other.sock" list
expect "its value is no verb there, either" 2 err 'no verb "traj lsit"' traj --socket list lsit
expect "a second verb is still refused" 2 err 'not expected: stop' status stop
expect "what is no option is answered with the one that may be meant" 2 err \
  'no option "--sped" of "task start"; did you mean "--speed"?' task start x --id 1 --sped 0.5
expect "also before what is missing" 2 err 'did you mean "--id"?' task start x --idd 1
expect "and with a value behind it" 2 err 'did you mean "--file"?' gnss --fil=x
expect "one of all verbs, too" 2 err 'did you mean "--socket"?' status --sockt x
expect "one before the verb" 2 err 'no option "--sockt"; did you mean "--socket"?' --sockt x status
expect "one that is like none is named" 2 err 'no option "--frobnicate" of "status"' \
  status --frobnicate
expect "to programs as JSON" 2 out '{"ok":false,"reason":"no option' status --json --wach
expect "a value may begin with dashes" 2 err '"--wach" is no number' \
  task start x --id 1 --speed --wach
expect "which is told of the right place" 3 err 'no-daemon.sock' traj show -- --x

expect "without droverd the reason is told" 3 err "no-daemon.sock" status
expect "and where to look why it does not run" 3 err \
  'journalctl -u droverd; droverd --check /etc/drover/drover.json' status
expect "also to programs" 3 out 'journalctl -u droverd' traj list --json
expect "and to a program as JSON" 3 out '{"ok":false,"reason":"' status --json
[[ ! -s $work/err ]]
verdict $? "and nothing else is said then"
expect "the help of tracks says how they come" 0 out 'src/publish/README.md' traj --help
expect "who finds a heading is told to watch that the robot goes ahead" 0 out \
  'WATCH THAT IT GOES AHEAD' heading find --help
expect "also before the verb is chosen" 0 out 'watch that it goes ahead' heading --help
expect "a recording in which nothing is says so" 1 err \
  'measurements 0: the recording is empty, or nothing in it is of this device' \
  gnss --driver nmea0183 --file /dev/null
expect "a device's view says so as JSON, too" 3 out '{"ok":false,"reason":"' gnss --json
expect "wrong usage is JSON for programs" 2 out '{"ok":false,"reason":"' \
  task start 'row 7' --json
expect "an unknown verb is JSON for programs" 2 out '{"ok":false,"reason":"no verb' statsu --json
expect "a file that is not there is JSON for programs" 1 out '{"ok":false,"reason":"' \
  gnss --file "$work/none" --json
expect "a speed is a plain number" 2 err '"nan" is no number' task start x --id 1 --speed nan
expect "not a hexadecimal one" 2 err '"0x1p-1" is no number' task start x --id 1 --speed 0x1p-1
yard=$(dirname "$0")/../../../config/zones/keep_in_yard_with_pond.geojson
expect "a zone is kept in or out of" 2 err "say --keep-in when" zone import "$yard"
expect "not both" 2 err "--keep-in" zone import "$yard" --keep-in --keep-out
expect "a name that is empty is none" 2 err "--name is empty" \
  zone import "$yard" --keep-in --name ""
expect "without droverd nothing of a zone is stored" 3 err "no-daemon.sock" \
  zone import "$yard" --keep-in --yes
expect "a file that is no zone is told with its line" 1 err "line 1, column " \
  zone import "$0" --keep-in --yes
expect "to programs as JSON" 1 out '{"ok":false,"reason":"' zone import "$0" --keep-in --json
expect "a scene is asked of droverd" 3 out '{"ok":false,"reason":"' scene list --json
expect "a report is asked of droverd" 3 out '{"ok":false,"reason":"' \
  report --svg "$work/a.svg" --json
[[ ! -e $work/a.svg ]]
verdict $? "and nothing is drawn without it"
expect "a picture is of one report, and not of the list" 2 err "--svg" \
  report --list --svg "$work/a.svg"
expect "a colour is one of a picture" 2 err "--svg" report --colour quality
expect "reports are numbered from one" 2 err "number" report 0
robot=$(dirname "$0")/../../../config/drover.json
log=$work/log.csv
printf 'time_s,vx_mps,wz_radps\n0,0,0\n0.5,0,0\n' > "$log"
expect "a log is estimated as the robot would" 0 out '"no origin"' \
  estimate --config "$robot" --in "$log"
expect "and how much it was is told beside it" 0 err "rows 2, poses " \
  estimate --config "$robot" --in "$log" --out "$work/pose.csv"
[[ $(head -c 18 "$work/pose.csv") == time_s,x_m,y_m,yaw ]]
verdict $? "into a file, if there is one"
expect "a misspelt log leaves the poses of before" 1 err "cannot be read" \
  estimate --config "$robot" --in "$work/lgo.csv" --out "$work/pose.csv"
expect "and a log is not written over by its poses" 1 err "is what is read" \
  estimate --config "$robot" --in "$log" --out "$log"
expect "also when it comes by standard input" 1 err "is what is read" \
  estimate --config "$robot" --in - --out "$work/log.csv" < "$log"
expect "nor is a folder a log" 1 err "cannot be read" \
  estimate --config "$robot" --in "$work" --out "$work/pose.csv"
[[ $(head -c 18 "$work/pose.csv") == time_s,x_m,y_m,yaw && $(wc -l < "$log") == 3 ]]
verdict $? "both are as they were"
expect "by a configuration" 2 err "--config" estimate --in "$log"
expect "which an empty name is not" 2 err "--config" estimate --in "$log" --config ''
expect "of a log or of a recording" 2 err "--in or --recording" estimate --config "$robot"
printf '1,0,zero\n' >> "$log"
expect "what is wrong in a log is told with its place" 1 err 'line 4, column 3 (wz_radps)' \
  estimate --config "$robot" --in "$log"
expect "what is no recording is none" 1 err "$log: " estimate --recording "$log"
printf 'time_s,vx_mps,wz_radps\n0,0,0\n0.5,0,0\n' > "$log"
expect "a robot is not calibrated from a log that shows nothing" 1 err "RTK fix: drive where" \
  calibrate --config "$robot" --in "$log"
expect "which is told to programs, too" 1 out '{"ok":false,"reason":"' \
  calibrate --config "$robot" --in "$log" --json
expect "nor from what is no recording" 1 err "$log: " calibrate --recording "$log"
expect "a log needs the configuration of its robot" 2 err "--config" calibrate --in "$log"
expect "and one of both is needed" 2 err "--in or --recording" calibrate --config "$robot"
expect "what to drive is in the help" 0 out "a left and a right circle" calibrate --help
expect "a verb that gives up what is stored is not guessed" 2 err "there are " scene accept
expect "a point's number is one that there can be" 2 err \
  '--id: 99999999999999999999 is not between 0 and 4294967295' \
  task start x --id 99999999999999999999
expect "and a number" 2 err '--id: "x" is no number' task start x --id x
expect "a whole one" 2 err '--id: "1.5" is no whole number' task start x --id 1.5
expect "as plain as a speed" 2 err '--id: "0x10" is no number' task start x --id 0x10
expect "and none below zero" 2 err '--id: -1 is not between' task start x --id -1
printf '(1.000000) can0 141#0000000008000100\n' > "$work/node10.log"
expect "a node is counted in tens" 0 out 'node 10 ' \
  can --file "$work/node10.log" --driver odrive --node 010
expect "and is a number" 2 err '--node: "x" is no number' \
  can --file "$work/node10.log" --driver odrive --node x
expect "what a recording is read with is of no use without one" 2 err '--file' \
  gnss --option baud=9600
expect "which would be passed over else" 2 err '--file' can --node 3
expect "so are seconds" 2 err '--from: -1 is less than 0' calibrate --from -1
expect "and a rate" 2 err '--rate: 0 is not between 0.01 and 200' estimate --rate 0
expect "a report's number is not another one than was typed" 2 err \
  'number: 99999999999999999999 is not between 1 and 9223372036854775807' \
  report 99999999999999999999
expect "nor is a word one" 2 err 'number: "x" is no number' report x
expect "the version is told to programs, too" 0 out '{"ok":true,"drover":"' version --json
# Root may look into any folder: somebody else asks then.
as_a_user=()
[[ $(id -u) == 0 ]] && as_a_user=(setpriv --reuid 65534 --regid 65534 --clear-groups)
mkdir -m 0700 "$work/closed"
[[ $(id -u) == 0 ]] || chmod 0 "$work/closed"
chmod a+rx "$work"
if "${as_a_user[@]}" "$drover" version > "$work/out" 2> "$work/err"; then
  "${as_a_user[@]}" "$drover" --socket "$work/closed/cli.sock" status > "$work/out" 2> "$work/err"
  [[ $? == 3 ]] &&
    grep -qF 'run this with sudo, or join with: sudo usermod -a -G drover' "$work/err"
  verdict $? "who may not ask is told how to become one who may"
fi
if [[ -w /dev/full ]]; then
  "$drover" version > /dev/full 2> "$work/err"
  [[ $? == 1 ]] && grep -q "cannot write to standard output" "$work/err"
  verdict $? "what cannot be written is a failure"
fi
exit $failed
