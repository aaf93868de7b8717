# The rules of the tree: each function prints one "file:line: what is wrong" per problem.
# Sourced by tests/lint/run, which has changed into the tree: `files` lists what is in it, a line
# in $notes is shown, a line in $skips says that a rule could not be checked.
# shellcheck shell=bash disable=SC2154

# Who may include whom: room, then the prefixes it may include ("<...>" are rule_headers'). A room
# may have several lines; a folder in it with lines of its own is a room for itself.
includes_of_rooms() {
  cat << 'TABLE'
include/drover   drover/
drivers          drover/ drivers/
src/engine       drover/ engine/
src/engine/clearance drover/ engine/config.h engine/clearance/
src/engine/estimate  drover/ engine/config.h engine/still.h engine/base/ engine/estimate/
src/engine/signals   drover/ engine/config.h engine/signals/
src/engine/base      drover/ engine/config.h engine/still.h engine/base/
src/engine/gate      drover/ engine/config.h engine/base/ engine/gate/
src/engine/health    drover/ engine/config.h engine/environment.h engine/event_queue.h
src/engine/health    engine/still.h engine/base/ engine/estimate/ engine/health/ engine/sensors/
src/engine/navigate  drover/ engine/config.h engine/event_queue.h engine/still.h
src/engine/navigate  engine/base/ engine/gate/ engine/health/ engine/navigate/ track/
src/engine/own       drover/ engine/config.h engine/event_queue.h engine/still.h
src/engine/own       engine/base/ engine/gate/ engine/health/ engine/navigate/ engine/own/
src/link         drover/ link/
src/scene        drover/ scene/ text/ track/
src/scene/zone   drover/ json/ text/ scene/
src/json         drover/ json/ text/
src/text         drover/ text/
src/track        drover/ track/
src/calibrate    drover/ calibrate/
src/store        drover/ store/ json/ track/
src/config       drover/ config/ json/ text/ engine/config.h engine/clearance/stop_chain.h
src/gateway      drover/ gateway/ config/ engine/
src/publish      drover/ publish/ scene/ store/ json/ text/
src/publish/rtk_navigation  drover/ store/ json/ text/ publish/arrival.h publish/names.h
src/publish/rtk_navigation  publish/rtk_navigation/
src/publish/scene    drover/ json/ scene/ publish/arrival.h publish/names.h publish/shown_json.h
src/publish/scene    publish/token_bucket.h publish/scene/ text/
src/publish/status   drover/ json/ publish/names.h publish/rtk_navigation/spelling.h
src/publish/status   publish/shown_json.h publish/status/
src/publish/ros2     drover/ json/ text/ scene/sensor/near_things.h publish/names.h
src/publish/ros2     publish/aimrt/messages.h publish/ros2/
src/publish/aimrt    drover/ json/ text/ publish/arrival.h publish/actions.h
src/publish/aimrt    publish/token_bucket.h publish/aimrt/
src/runtime      drover/ runtime/ publish/ store/ json/ config/ link/ engine/ gateway/ scene/ text/
src/guard        drover/ guard/
src/cli          drover/ cli/ json/ text/ config/register_map.h config/fields_map.h
src/cli          gateway/recording/replay.h link/unique_fd.h publish/names.h publish/shown_json.h
src/cli          link/packet_question.h
src/cli          scene/zone/ scene/message/shapes.h calibrate/calibrate.h calibrate/recipe.h
src/cli          runtime/clock.h
src/cli          engine/estimate/local_frame.h
src/cli          config/load.h engine/config.h engine/base/kinematics.h engine/estimate/estimator.h
src/ros2         drover/ ros2/ json/ config/config.h config/load.h link/unique_fd.h
src/ros2         link/packet_question.h
src/ros2         runtime/back_off.h runtime/clock.h runtime/log.h publish/token_bucket.h text/
src/droverd.cpp  config/ runtime/
sim/plant        drover/ sim/plant/
sim/robot        drover/ link/ text/ sim/plant/ sim/robot/ config/register_map.h
sim/scenario     drover/ link/ text/ sim/robot/ sim/scenario/
sim/relay        link/unique_fd.h
TABLE
}

sources() { files | grep -E '\.(h|cpp)$' | grep -E "^($1)" || true; }

rule_include_directions() {
  local rooms
  rooms=$(includes_of_rooms)
  sources 'include/|drivers/|src/|sim/' | grep -v '^sim/labkit/' | while read -r file; do
    awk -v file="$file" -v rooms="$rooms" '
      BEGIN {
        n = split(rooms, lines, "\n")
        for (i = 1; i <= n; ++i) {
          m = split(lines[i], w, / +/)
          if (file == w[1] || index(file, w[1] "/") == 1) {
            if (length(w[1]) < length(room)) continue
            if (w[1] != room) delete allowed
            room = w[1]
            for (j = 2; j <= m; ++j) allowed[w[j]] = 1
          }
        }
        if (room == "") print file ":1: this folder is no room of the table in tests/lint/rules.sh"
      }
      room != "" && /^ *# *include *"/ {
        split($0, part, "\"")
        good = 0
        for (prefix in allowed) {
          whole = prefix ~ /\.h$/
          if (whole ? part[2] == prefix : index(part[2], prefix) == 1) good = 1
        }
        if (!good) print file ":" NR ": " room " may not include \"" part[2] "\""
      }' "$file"
  done
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
  # canopen and mit are shared; of gt01 there are only the codecs yet.
  local folder shared=' canopen gt01 mit '
  files | grep -oE '^drivers/[^/]+/' | sort -u | while read -r folder; do
    [[ -s ${folder}README.md ]] || echo "${folder}README.md:1: missing: source document and frames"
    # A driver without a codec has levels, not bytes.
    [[ ! -e ${folder}codec.h ]] || grep -q "^${folder}golden/" <<< "$(files)" ||
      echo "${folder}golden:1: missing: captured or documented bytes"
    [[ $shared != *" $(basename "$folder") "* ]] || continue
    grep -q "$(basename "$folder")" drivers/registry.cpp 2> /dev/null ||
      echo "drivers/registry.cpp:1: no line for $folder"
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
