# The rules of the tree: each function prints one "file:line: what is wrong" per problem.
# Sourced by tests/lint/run, which has changed into the tree: `files` lists what is in it, a line
# in $notes is shown, a line in $skips says that a rule could not be checked.
# shellcheck shell=bash disable=SC2154

# Who may include whom: room, then the prefixes it may include ("<...>" are rule_headers'). Each
# folder of sources is a room, with lines of its own or those of a pattern. ./ is the room itself,
# ../ the folder that it is in.
includes_of_rooms() {
  cat << 'TABLE'
include/drover   drover/
drivers          drover/ drivers/
drivers/*        drover/ ./ drivers/checked_options.h drivers/drives.h drivers/noise.h
drivers/*        drivers/thousandths.h drivers/twin_states.h drivers/canopen/ drivers/mit/
drivers/*/*      drover/ ./ ../ drivers/checked_options.h drivers/drives.h drivers/noise.h
drivers/*/*      drivers/thousandths.h drivers/twin_states.h drivers/canopen/ drivers/mit/
drivers/canopen  drover/ ./
drivers/mit      drover/ ./ drivers/checked_options.h
src/engine       drover/ engine/
src/engine/clearance drover/ engine/config.h engine/clearance/
src/engine/estimate  drover/ engine/config.h engine/still.h engine/base/ engine/estimate/
src/engine/signals   drover/ engine/config.h engine/signals/
src/engine/sensors   drover/ engine/config.h engine/environment.h engine/estimate/ engine/sensors/
src/engine/base      drover/ engine/config.h engine/still.h engine/base/
src/engine/gate      drover/ engine/config.h engine/base/ engine/gate/
src/engine/group     drover/ engine/config.h engine/event_queue.h
src/engine/group     engine/gate/ engine/health/ engine/group/
src/engine/health    drover/ engine/config.h engine/environment.h engine/event_queue.h
src/engine/health    engine/still.h engine/base/ engine/estimate/ engine/health/ engine/sensors/
src/engine/navigate  drover/ engine/config.h engine/event_queue.h engine/still.h
src/engine/navigate  engine/base/ engine/gate/ engine/health/ engine/navigate/ track/
src/engine/own       drover/ engine/config.h engine/event_queue.h engine/still.h
src/engine/own       engine/base/ engine/gate/ engine/health/ engine/navigate/ engine/own/
src/link         drover/ link/
src/scene/message    drover/ text/ scene/message/
src/scene/plane      drover/ track/ scene/message/ scene/plane/
src/scene/sensor     drover/ scene/plane/ scene/sensor/
src/scene/world      drover/ text/ scene/message/ scene/plane/ scene/world/
src/scene/zone       drover/ json/ text/ scene/message/ scene/plane/ scene/world/ scene/zone/
src/scene/constraint drover/ scene/message/ scene/plane/ scene/world/ scene/constraint/
src/scene/look       drover/ scene/plane/ scene/sensor/ scene/constraint/ scene/look/
src/scene/keeper     drover/ text/ track/ scene/
src/json         drover/ json/ text/
src/text         drover/ text/
src/track        drover/ track/
src/calibrate    drover/ calibrate/
src/store        drover/ store/ json/ track/
src/config       drover/ config/ json/ text/ engine/config.h engine/clearance/stop_chain.h
src/gateway      drover/ gateway/ config/ engine/
src/gateway/recording drover/ config/ gateway/
src/publish      drover/ publish/ scene/ store/ json/ text/
src/publish/rtk_navigation  drover/ store/ json/ text/ publish/arrival.h publish/names.h
src/publish/rtk_navigation  publish/spelling.h publish/rtk_navigation/
src/publish/scene    drover/ json/ scene/ publish/arrival.h publish/names.h publish/shown_json.h
src/publish/scene    publish/token_bucket.h publish/scene/ text/
src/publish/report   drover/ store/ publish/command_service.h publish/line_json.h publish/names.h
src/publish/report   publish/report/
src/publish/status   drover/ json/ publish/names.h publish/shown_json.h publish/status/
src/publish/ros2     drover/ json/ text/ scene/sensor/near_things.h publish/names.h
src/publish/ros2     publish/aimrt/messages.h publish/ros2/
src/publish/aimrt    drover/ json/ text/ publish/arrival.h publish/actions.h
src/publish/aimrt    publish/token_bucket.h publish/aimrt/
src/runtime      drover/ runtime/ publish/ store/ json/ config/ link/ engine/ gateway/ scene/ text/
src/guard        drover/ guard/
src/cli          drover/ cli/ json/ text/ config/register_map.h config/fields_map.h
src/cli          gateway/recording/replay.h link/unique_fd.h publish/names.h publish/shown_json.h
src/cli          link/packet_question.h link/unix_address.h
src/cli          scene/zone/ scene/message/shapes.h calibrate/calibrate.h calibrate/recipe.h
src/cli          runtime/clock.h
src/cli          engine/estimate/local_frame.h
src/cli          config/load.h engine/config.h engine/base/kinematics.h engine/estimate/estimator.h
src/ros2         drover/ ros2/ json/ config/config.h config/load.h link/unique_fd.h
src/ros2         link/packet_question.h link/unix_address.h
src/ros2         runtime/back_off.h runtime/clock.h runtime/log.h publish/token_bucket.h text/
src/droverd.cpp  config/ runtime/
sim/plant        drover/ sim/plant/
sim/robot        drover/ link/ text/ sim/plant/ sim/robot/ config/register_map.h
sim/scenario     drover/ link/ text/ sim/robot/ sim/scenario/
sim/relay        link/unique_fd.h
TABLE
}

sources() { files | grep -E '\.(h|cpp)$' | grep -E "^($1)" || true; }

sources_in_rooms() { sources 'include/|drivers/|src/|sim/' | grep -v '^sim/labkit/'; }

rule_include_directions() {
  sources_in_rooms | xargs -r -d '\n' awk -v rooms="$(includes_of_rooms)" '
    # A file may be a room; else its folder is, by its own name or as the pattern says.
    function room_of(file, folder, room, pattern) {
      if (file in allowed) return file
      if (folder in allowed) return folder
      for (room in allowed) {
        pattern = room
        if (gsub(/\*/, "[^/]+", pattern) && folder ~ "^" pattern "$") return room
      }
      return ""
    }
    BEGIN {
      n = split(rooms, lines, "\n")
      for (i = 1; i <= n; ++i) {
        room = lines[i]
        sub(/ .*/, "", room)
        allowed[room] = allowed[room] substr(lines[i], length(room) + 1)
      }
    }
    FNR == 1 {
      folder = parent = FILENAME
      sub(/\/[^\/]*$/, "", folder)
      parent = folder
      sub(/[^\/]*$/, "", parent)
      room = room_of(FILENAME, folder)
      if (room == "")
        print FILENAME ":1: this folder is no room of the table in tests/lint/rules.sh"
      n = split(allowed[room], prefixes, " ")
      for (i = 1; i <= n; ++i) {
        if (prefixes[i] == "./") prefixes[i] = folder "/"
        if (prefixes[i] == "../") prefixes[i] = parent
      }
    }
    room != "" && /^ *# *include *"/ {
      split($0, part, "\"")
      for (i = 1; i <= n; ++i) {
        if (prefixes[i] ~ /\.h$/ ? part[2] == prefixes[i] : index(part[2], prefixes[i]) == 1) next
      }
      print FILENAME ":" FNR ": " folder " may not include \"" part[2] "\""
    }'
}

# No arrow between rooms runs back, by whatever way. A room with rooms below it (src/engine) holds
# both what those share and what puts them together: there each header with its .cpp is looked at
# by itself, and a circle among them alone is their own affair.
rule_include_circles() {
  local names
  mapfile -t names < <(sources_in_rooms)
  [[ ${#names[@]} -gt 0 ]] || return 0
  awk '
    function folder_of(path) { sub(/\/[^\/]*$/, "", path); return path }
    function node_of(path) {
      if (!(folder_of(path) in holds_rooms)) return folder_of(path)
      sub(/\.[a-z]+$/, "", path)
      return path
    }
    function find_file(name, here) {
      if (("include/" name) in there) return "include/" name
      if (("src/" name) in there) return "src/" name
      if (name in there) return name
      return (here "/" name) in there ? here "/" name : ""
    }
    # Everything that is reached from a node, breadth first.
    function reach_from(start, queue, first, last, i, m, next_ones) {
      queue[last = 1] = start
      for (first = 1; first <= last; ++first) {
        m = split(arrows[queue[first]], next_ones, " ")
        for (i = 1; i <= m; ++i)
          if (!((start, next_ones[i]) in reached)) {
            reached[start, next_ones[i]] = 1
            queue[++last] = next_ones[i]
          }
      }
      known[start] = 1
    }
    BEGIN {
      for (i = 1; i < ARGC; ++i) {
        there[ARGV[i]] = 1
        above = folder_of(ARGV[i])
        while (above ~ /\//) holds_rooms[above = folder_of(above)] = 1
      }
    }
    /^ *# *include *"/ {
      split($0, part, "\"")
      target = find_file(part[2], folder_of(FILENAME))
      if (target == "") next
      from = node_of(FILENAME)
      to = node_of(target)
      if (from == to) next
      if (!((from, to) in arrow)) arrows[from] = arrows[from] " " to
      arrow[from, to] = 1
      if (folder_of(FILENAME) == folder_of(target)) next
      place[++count] = FILENAME ":" FNR
      from_of[count] = from
      to_of[count] = to
    }
    END {
      for (i = 1; i <= count; ++i) {
        if (!(to_of[i] in known)) reach_from(to_of[i])
        if ((to_of[i], from_of[i]) in reached)
          print place[i] ": " from_of[i] " includes " to_of[i] ", from which one comes back to it"
      }
    }' "${names[@]}"
}

# The rooms without I/O know the standard library only; the engine also GeographicLib.
rule_headers() {
  sources 'include/|drivers/|src/(calibrate|engine|track)/' | while read -r file; do
    awk -v file="$file" '
      /^ *# *include *</ {
        name = $0
        gsub(/.*<|>.*/, "", name)
        if (name ~ /^(thread|mutex|shared_mutex|condition_variable|future|ctime)$/ ||
            name ~ /^(iostream|fstream|filesystem|random)$/)
          print file ":" NR ": <" name "> has no place here"
        else if (name !~ /^[a-z_]+$/ && !(file ~ /^src\/engine\// && name ~ /^GeographicLib\//))
          print file ":" NR ": only the standard library here, not <" name ">"
      }' "$file"
  done
}

# code FILE...: "file:line:text" without comments and strings.
code() {
  awk '{
    text = $0
    gsub(/\\./, "", text)
    gsub(/"[^"]*"/, "\"\"", text)
    sub(/\/\/.*/, "", text)
    if (text ~ /[^ ]/) print FILENAME ":" FNR ":" text
  }' "$@"
}

# matches PATTERN MESSAGE < names of files
matches() {
  local names
  mapfile -t names
  [[ ${#names[@]} -gt 0 ]] || return 0
  code "${names[@]}" | grep -E "^[^:]+:[0-9]+:.*($1)" |
    sed -E "s|^([^:]+:[0-9]+):.*|\1: $2|" || true
}

rule_pure_rooms() {
  sources 'drivers/|src/(calibrate|engine|gateway|scene|track)/' | matches \
    '\<now\(|_clock\>|clock_gettime|sleep|std::thread|\<mutex\>|lock_guard|getenv|std::async' \
    'no clock, thread, lock or environment in a pure room: time is an argument'
  sources 'drivers/|src/(calibrate|engine|gateway|scene|track)/' | matches \
    '\<f?open\(|\<socket\(|[^A-Za-z0-9_>]::(read|write|send|recv|ioctl|poll)\(' \
    'no I/O in a pure room'
  sources 'drivers/|src/(calibrate|engine|gateway|scene|track)/' | matches \
    '\<f?printf\(|\<f?puts\(|std::c(out|err|log)\>|\<[io]?fstream\>' \
    'no I/O in a pure room'
  # spsc_ring and triple_buffer are the only exchange; the vocabulary has no clock either.
  sources 'include/' | matches '\<now\(|_clock::now|clock_gettime|std::mutex|std::thread|sleep' \
    'the vocabulary has no clock, thread or lock'
}

rule_no_own_mutex() {
  sources 'include/|drivers/|src/' | matches \
    'std::(recursive_|shared_|timed_)?mutex|pthread_mutex|condition_variable' \
    'no mutex of our own: triple buffer and rings'
}

# Descriptors belong to the links, the loop, the programs and the file store.
rule_descriptors() {
  sources 'src/' |
    grep -vE '^src/(link|runtime|guard|cli|ros2)/|^src/(store/posix_files|config/load)\.cpp$' |
    matches \
      '[^A-Za-z0-9_>]::(open(at)?|socket|read|write|send|recv|ioctl|poll|epoll_[a-z0-9]+|close)\(' \
      'descriptors belong to src/link, src/runtime and the file readers'
}

rule_clocks() {
  sources 'src/|include/|drivers/' | grep -v '^src/runtime/clock\.h$' |
    matches 'system_clock|CLOCK_REALTIME|gettimeofday|\<time\(NULL|\<time\(nullptr' \
      'wall time is read in src/runtime/clock.h only'
  sources 'src/' | grep -vE '^src/(runtime/clock\.h|guard/clock\.h)$' |
    matches 'steady_clock|clock_gettime' 'the clock is read in src/runtime/clock.h only'
}

# `*_failse` and the topics are spelled in publish/ only.
rule_spellings() {
  local file
  sources 'include/|drivers/|src/' | grep -v '^src/publish/' | while read -r file; do
    # Code only: comments may name what they explain.
    sed -E 's|//.*||' "$file" | grep -nE '_failse|LOCATE_TRUE|NAV_RUN' |
      sed -E "s|^([0-9]+):.*|$file:\1: wire spellings live in src/publish only|" || true
  done
}

rule_file_length() {
  local file lines
  while read -r lines file; do
    if [[ $lines -gt 500 ]]; then
      echo "$file:500: $lines lines; split it"
    elif [[ $lines -gt 300 ]]; then
      echo "$file: $lines lines, is it still one thing?" >> "$notes"
    fi
  done < <(files | grep -E '\.(h|cpp|sh)$|^sim/(lab|demo)$|^sim/labkit/init$|^tests/(.*/)?run$' |
    xargs -r -d '\n' wc -l | grep -v ' total$')
}

rule_line_length() {
  files | grep -E '\.(h|cpp|sh)$|CMakeLists\.txt$' |
    LC_ALL=C.UTF-8 xargs -r -d '\n' grep -nHE '^.{101,}' |
    sed -E 's|^([^:]+:[0-9]+):.*|\1: more than 100 columns|' || true
}

rule_headers_begin_well() {
  local file
  sources 'include/|drivers/|src/|sim/|tests/' | while read -r file; do
    [[ $file != *.h ]] || grep -q '^#pragma once' "$file" || echo "$file:1: no #pragma once"
    case $file in
      tests/*_test.cpp | */entry.cpp) ;;
      *.h) [[ $(head -c 2 "$file") == // ]] || echo "$file:1: no purpose sentence on top" ;;
    esac
  done
}

rule_top_level() {
  files | cut -d/ -f1 | sort -u |
    grep -vE '^(CMakeLists\.txt|README\.md|LICENSE|\..*)$' |
    grep -vxE 'src|drivers|include|config|udev|tests|sim' |
    sed 's|$|:1: the top level is fixed|' || true
}

# A machine's own paths, generated files, and words about how the work was done.
rule_no_machine_paths() {
  files | grep -vE '^(LICENSE|tests/lint/)' | xargs -r -d '\n' \
    grep -nHIE '(^|[^A-Za-z0-9_.}*-])/(work|root|home/[a-z]+)(/|\>)' |
    sed -E 's|^([^:]+:[0-9]+):.*|\1: a path of one machine|' || true
  files | grep -E '^(include|drivers|src|config|udev)/' | xargs -r -d '\n' grep -nHI '/tmp/' |
    sed -E 's|^([^:]+:[0-9]+):.*|\1: /tmp in the product|' || true
  local file
  files | grep -vE '^(LICENSE|README\.md|tests/fuzz/corpus/.*|.*/golden/.*)$' |
    xargs -r -d '\n' grep -LI . | while read -r file; do
    [[ ! -s $file ]] || echo "$file:1: a binary file"
  done
  files | grep -E '\.(orig|rej|bak)$|~$' | sed 's|$|:1: left over by an editor or a patch|' || true
}

# What several drivers share has a folder, too, and no line in the registry.
rule_driver_folders() {
  local folder entry name shared=' canopen mit ' table=drivers/registry.cpp
  files | grep -oE '^drivers/[^/]+/' | sort -u | while read -r folder; do
    [[ -s ${folder}README.md ]] || echo "${folder}README.md:1: missing: source document and frames"
    [[ $shared == *" $(basename "$folder") "* ]] ||
      grep -qE "^$folder(.*/)?entry\.h$" <<< "$(files)" ||
      echo "${folder}entry.h:1: missing: what the registry includes"
  done
  # A driver without a codec has levels, not bytes.
  files | grep -E '^drivers/.*/codec\.h$' | while read -r entry; do
    grep -q "^${entry%codec.h}golden/" <<< "$(files)" ||
      echo "${entry%codec.h}golden:1: missing: captured or documented bytes"
  done
  files | grep -E '^drivers/.*/entry\.h$' | while read -r entry; do
    grep -qF "#include \"$entry\"" "$table" 2> /dev/null ||
      echo "$table:1: no line for ${entry%entry.h}"
    name=$(sed -n 's/^extern const DriverEntry \(\w*\);$/\1/p' "$entry")
    [[ -n $name ]] || echo "$entry:1: declares no DriverEntry"
    grep -qE "^ +(.* )?$name," "$table" 2> /dev/null || echo "$table:1: $name is not in its table"
  done
}

# Every package that a README names in an apt-get line is in the list.
rule_packages() {
  [[ -e .ci/packages ]] || { echo ".ci/packages:1: missing"; return; }
  [[ -e README.md ]] || { echo "README.md:1: missing"; return; }
  local readmes
  mapfile -t readmes < <(files | grep -E '(^|/)README\.md$')
  awk '
    FILENAME == ".ci/packages" { if (NF && $1 !~ /^[#[]/) known[$1] = 1; next }
    /apt(-get)? install/ { on = 1; sub(/.*install/, "") }
    on {
      text = $0
      gsub(/[`\\|]/, " ", text)
      n = split(text, words, " ")
      for (i = 1; i <= n; ++i)
        if (words[i] ~ /^[a-z0-9][a-z0-9.+-]+$/ && !(words[i] in known))
          print FILENAME ":" FNR ": " words[i] " is not in .ci/packages"
      if ($0 !~ /\\$/) on = 0
    }' .ci/packages "${readmes[@]}"
  awk 'NF && $1 !~ /^[#[]/ { print $1 }' .ci/packages | while read -r package; do
    grep -qF "\`$package\`" README.md || echo "README.md:1: does not name the package $package"
  done
  awk 'NF && $1 !~ /^[#[]/ {
    if (seen[$1]++) print FILENAME ":" FNR ": " $1 " stands twice"
    if ($0 !~ /# [^ ]/) print FILENAME ":" FNR ": " $1 ": say what it is used for"
  }' .ci/packages
}

# "Message field" and "Message CONSTANT=value", as the planning messages' document has them.
fields_of_document() {
  awk '
    BEGIN {
      type = "u?int8|u?int32|byte|float64|string|time|Header|[a-z_]+/[A-Za-z]+|[A-Za-z]+Constraint"
      declared = "^(" type ")(\\[\\])? [A-Za-z_]+(=[0-9]+)?( |$)"
    }
    { gsub(/[`\r]/, "") }
    /^### / { message = $NF }
    { sub(/^[>* ]+/, "") }
    $0 ~ declared { print message, $2 }
    /^stamp\.n?sec:/ { sub(/:.*/, ""); print message, $0 }' "$1"
}

# Each field and constant of the planning messages is a row of the scene's table with tests that
# are there, and is spelled in the sources. The list is the document's, where that is at hand.
rule_document_fields() {
  local fields=tests/unit/scene/document_fields.txt table=src/scene/README.md
  local document=../shared/seeds/ros-message-types.md
  local source message name number=0 wire values rows tests
  [[ -n $(sources 'src/scene/') ]] || return 0
  [[ -e $fields ]] || { echo "$fields:1: missing"; return; }
  [[ -e $table ]] || { echo "$table:1: missing"; return; }
  wire=$(sources 'src/publish/scene/' | xargs -r cat)
  values=$(sources 'src/scene/message/' | xargs -r cat)
  rows=$(grep '^| `' "$table")
  while read -r source message name; do
    number=$((number + 1))
    [[ $source == document || $source == ros1 ]] || continue
    [[ $rows == *"| \`$message.$name\` |"* ]] ||
      echo "$table:1: has no row for \`$message.$name\`"
    if [[ $name == *=* ]]; then
      [[ $values =~ [^A-Z_]${name%=*}\ =\ ${name#*=}[^0-9] ]] ||
        echo "$fields:$number: src/scene/message has no ${name/=/ = }"
    else
      [[ $wire == *"\"${name##*.}\""* ]] ||
        echo "$fields:$number: src/publish/scene does not spell \"${name##*.}\""
    fi
  done < "$fields"
  # The names of the tests first: as an argument they would be too long.
  sources 'tests/unit/' | xargs -r sed -nE 's/^TEST(_F|_P)?\((\w+), (\w+)\).*/\2.\3/p' | awk -F'|' '
    FILENAME == "-" { there[$0] = 1; next }
    /^\|.*\| tests \|$/ { on = 1; next }
    !/^\|/ { on = 0 }
    on && !/^\|[-|]+\|$/ {
      if ($(NF - 1) !~ /`[A-Z]/) print FILENAME ":" FNR ": this row names no test"
      m = split($(NF - 1), part, "`")
      for (i = 2; i <= m; i += 2)
        if (!(part[i] in there)) print FILENAME ":" FNR ": there is no test " part[i]
    }' - "$table"
  [[ -e $document ]] || return 0
  diff <(fields_of_document "$document" | sort -u) <(sed -n 's/^document //p' "$fields" | sort -u) |
    sed -n "s|^< |$fields:1: the document has |p; s|^> |$fields:1: the document has no |p"
}

# Programs only: what they source is followed.
scripts() {
  local file first
  files | grep -vE '\.(h|cpp|md|json|xml|txt)$' | while read -r file; do
    [[ -s $file ]] || continue
    IFS= read -rn 40 first < "$file" || true
    [[ $first =~ ^'#!'.*(bash|/sh) ]] && echo "$file"
  done
}

rule_shellcheck() {
  command -v shellcheck > /dev/null || { echo 'shellcheck is missing' >> "$skips"; return 0; }
  local names
  mapfile -t names < <(scripts)
  [[ ${#names[@]} -gt 0 ]] || return 0
  # SC2317: functions that are called by their name in a variable. SC2016: text for another shell.
  shellcheck -x -e SC2317,SC2016 -f gcc "${names[@]}" || true
}

rule_format() {
  command -v clang-format > /dev/null || { echo 'clang-format is missing' >> "$skips"; return 0; }
  # Many files for each start of it, which costs more than looking at one.
  sources '' | xargs -r -P "$(nproc)" -n 50 clang-format --dry-run -Werror 2>&1 |
    sed -nE 's/^([^ :]+:[0-9]+):[0-9]+: error: .*/\1: clang-format would change this/p' |
    LC_ALL=C sort -u -t : -k 1,1
}
