#!/bin/bash
# That the line which the least recording of src/publish/README.md keeps is the driven one to the
# centimetre, its corners and its end, too. SOURCE_FOLDER; 77: there is no jq.
set -euo pipefail
command -v jq > /dev/null || exit 77

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# As it is written there, with programs in place of the broker's.
awk '/^mosquitto_sub -h ROBOT -u viewer/ { on = 1 } on && /^```/ { exit } on' \
  "$1/src/publish/README.md" > "$folder/recipe"
[[ -s $folder/recipe ]] || { echo "no recipe in src/publish/README.md" >&2; exit 1; }
printf '#!/bin/sh\ncat "%s"\n' "$folder/told" > "$folder/mosquitto_sub"
printf '#!/bin/sh\ncat > "%s"\n' "$folder/saved" > "$folder/mosquitto_pub"
chmod +x "$folder/mosquitto_sub" "$folder/mosquitto_pub"

# Ten a second at 0.4 m/s: straight, a corner on the spot, straight, a bend of 0.6 m, straight;
# it ends somewhere. At two places it has no fix or no place.
awk 'BEGIN {
  drive(4, 0); drive(0, 1.5707963); drive(3, 0); drive(1.8849556, 3.1415927); drive(2.07, 0)
}
function drive(way, turn,  steps, i) {
  steps = int((way > 0 ? way / 0.04 : turn / 0.05) + 0.5)
  for (i = 0; i < steps; ++i) {
    yaw += turn / steps / 2
    x += way / steps * cos(yaw); y += way / steps * sin(yaw)
    yaw += turn / steps / 2
    tell(4, "LOCATE_TRUE", x, y, yaw)
    if (++told == 30) tell(5, "LOCATE_TRUE", x + 1, y, yaw)
    if (told == 40) tell(4, "LOCATE_FALSE", x, y + 1, yaw)
  }
}
function tell(status, locate, x, y, yaw) {
  printf "{\"rtk\":{\"status\":%d,\"longitude\":1,\"latitude\":2,\"angle\":0},", status
  printf "\"nav\":{\"locate\":\"%s\"},\"pose\":{\"x\":%.6f,\"y\":%.6f,\"yaw\":%.6f}}\n", \
    locate, x, y, atan2(sin(yaw), cos(yaw))
}' > "$folder/told"

PATH=$folder:$PATH bash "$folder/recipe"

jq -r '.data.data[] | "\(.x) \(.y)"' "$folder/saved" > "$folder/kept"
jq -r 'select(.rtk.status == 4 and .nav.locate == "LOCATE_TRUE") | "\(.pose.x) \(.pose.y)"' \
  "$folder/told" |
  awk 'NR == FNR { x[n] = $1; y[n++] = $2; next }
    {
      least = 1e9
      for (i = 0; i + 1 < n; ++i) {
        dx = x[i + 1] - x[i]; dy = y[i + 1] - y[i]; square = dx * dx + dy * dy
        t = square > 0 ? (($1 - x[i]) * dx + ($2 - y[i]) * dy) / square : 0
        t = t < 0 ? 0 : t > 1 ? 1 : t
        off = sqrt(($1 - x[i] - t * dx) ^ 2 + ($2 - y[i] - t * dy) ^ 2)
        if (off < least) least = off
      }
      if (least > worst) { worst = least; at = $0 }
      ++driven
    }
    END {
      printf "%d of %d points are kept; the line moves by %.1f mm, at %s\n", n, driven, \
        1000 * worst, at
      exit !(driven > 250 && n > 20 && n < driven / 3 && worst <= 0.01)
    }' "$folder/kept" -
