# Compiles the lab's supervisor into the cache when its sources changed. Sourced by sim/lab.
# shellcheck shell=bash

# Sets $supervisor.
ensure_supervisor() {
  local sources=("$lab_dir"/host/*.cpp) key target
  key=$(cat "$lab_dir"/host/*.cpp "$lab_dir"/host/*.h | sha256sum)
  target=$cache_dir/supervisor-${key:0:16}
  supervisor=$target/drover-lab
  [[ ! -x $supervisor ]] || return 0
  set +e
  (
    set -e
    exec 9> "$cache_dir/supervisor.lock"
    flock 9
    [[ ! -x $supervisor ]] || exit 0
    rm -rf "$cache_dir"/supervisor.new
    mkdir "$cache_dir/supervisor.new"
    g++ -std=c++20 -O1 -Wall -Wextra -o "$cache_dir/supervisor.new/drover-lab" "${sources[@]}"
    # Older ones may still run for somebody; those of last week do not.
    find "$cache_dir" -maxdepth 1 -name 'supervisor-*' -mtime +7 -exec rm -rf {} +
    mv -T "$cache_dir/supervisor.new" "$target"
  )
  # shellcheck disable=SC2181  # testing the group directly would switch off -e inside it
  [[ $? == 0 ]] || die "the lab's supervisor does not compile" 3
  set -e
}
