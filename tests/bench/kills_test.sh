#!/bin/bash
# tests/bench/kills reads the logs of a kill as they are, and takes for rest only what rests.
set -uo pipefail
kills=$(readlink -f "$(dirname "$0")/kills")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0

zero='base EDDE000002120000000000000000DF01BDBC'

# logs KILLED SLOWS-BY ASIDE TURN: it drives at 0.5 m/s, is killed at 10 s, and slows down from 10.1
# s on; from then on it slides and turns so fast. 20 lines a second until 13 s.
logs() {
  printf '(9.000000000) signal 15 to drover-guard\n(%s) signal 9 to droverd\n' "$1" \
    > "$folder/events.log"
  printf '(%s) %s\n' 9.990000000 "$zero" 10.005000000 \
    'base EDDE000002120000000001000000DF01BDBC' 10.030000000 "$zero" > "$folder/serial.log"
  awk -v by="$2" -v aside="$3" -v turn="$4" 'BEGIN {
    print "time_s,x_m,y_m,yaw_rad,vx_mps,wz_radps,supply"
    for (i = 0; i <= 80; ++i) {
      t = 9 + i / 20
      braking = t > 10.1
      v = 0.5 - (braking ? by * (t - 10.1) : 0)
      if (v < 0) v = 0
      x += v / 20
      if (braking) y += aside / 20
      printf "%.9f,%.6f,%.6f,0,%.6f,%.6f,1\n", t, x, y, v, braking ? turn : 0
    }
  }' > "$folder/truth.csv"
}

# expect STATUS TEXT NAME
expect() {
  local said status
  said=$("$kills" --judge "$folder" 2>&1)
  status=$?
  if [[ $status == "$1" && $said == "$2" ]]; then
    echo "ok - $3"
  else
    echo "not ok - $3: status $status, $said"
    failed=1
  fi
}

logs 10.000000000 1 0 0
expect 0 '30.0 550 0.50' 'a robot that comes to rest'
logs 10.000000000 0.1 0 0
expect 1 '' 'one that does not'
logs 10.000000000 1 0.1 0
expect 1 '' 'one that slides aside'
logs 10.000000000 1 0 -0.2
expect 1 '' 'one that turns'
logs 10.000000000 1 0.01 0.05
expect 0 '30.0 550 0.50' 'one that hardly does'
logs 12.500000000 1 0 0
expect 1 '' 'logs that end too soon, and have no stop message'
logs 10.000000000 1 0 0
sed -i /10.03/d "$folder/serial.log"
expect 1 '' 'no stop message'
logs 10.000000000 1 0 0
sed -i /droverd/d "$folder/events.log"
expect 1 '' 'one that nobody killed'
exit "$failed"
