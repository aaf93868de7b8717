# Builds the lab's kernel once into a cache outside the source tree. Sourced by sim/lab.
# shellcheck shell=bash

cache_dir=${XDG_CACHE_HOME:-${HOME:?}/.cache}/drover/lab

# The saved FPU state of a host with AMX is 11008 bytes; without room for it the kernel dies at
# once with "ptrace set fp regs failed". Hosts without AMX are served by the larger size too.
patch_file=arch/x86/um/user-offsets.c
patch_old='DEFINE_LONGS(HOST_FP_SIZE, 2696);'
patch_new='DEFINE_LONGS(HOST_FP_SIZE, 12288);'

# Make it faster; a kernel without them serves as well.
speed_patches=("$lab_dir"/{clock,floating_point}.patch)

need_packages() {
  echo "sim/lab: this is missing; install it with" >&2
  echo "  apt-get install --no-install-recommends $*" >&2
  exit 3
}

# Exit status 3 means "not on this machine", which test runners report as skipped.
check_host() {
  if [[ $(uname -sm) != 'Linux x86_64' ]]; then
    echo "sim/lab: THE LAB NEEDS LINUX ON x86-64; THIS IS $(uname -sm). NOTHING WAS RUN." >&2
    exit 3
  fi
  local missing=() pair
  for pair in g++:g++ ip:iproute2 flock:util-linux; do
    PATH=$PATH:/usr/sbin:/sbin command -v "${pair%:*}" > /dev/null || missing+=("${pair#*:}")
  done
  [[ ${#missing[@]} == 0 ]] || need_packages "${missing[@]}"
  mkdir -p "$cache_dir"
}

find_source() {
  local candidates=(/usr/src/linux-source-6.*.tar.xz)
  source_tar=${candidates[-1]}
  [[ -e $source_tar ]]
}

# A key from name, size and date of Debian's archive: hashing 138 MB at every start is too slow.
source_id() { stat -c '%n %s %Y' "$source_tar"; }

# Sets $kernel to a kernel that boots on this CPU, building it when there is none.
ensure_kernel() {
  local config_key source_key
  config_key=$({
    cat "$lab_dir/kernel.config" "${speed_patches[@]}"
    echo "$patch_file$patch_old$patch_new"
  } | sha256sum)
  config_key=${config_key:0:12}
  if find_source; then
    source_key=$(source_id | sha256sum)
    kernel_dir=$cache_dir/kernel-$config_key-${source_key:0:12}
  else
    # Without the source package a kernel that was built earlier still serves.
    local built=("$cache_dir/kernel-$config_key"-*)
    kernel_dir=${built[0]}
    [[ -x $kernel_dir/linux ]] || need_packages linux-source-6.1
  fi
  kernel=$kernel_dir/linux
  [[ -e $kernel && -e $kernel_dir/boots-on-$(cpu_id) ]] && return 0
  # Not `(...) || exit`: that would switch off -e inside.
  local status
  set +e
  (set -e; build_under_lock)
  status=$?
  set -e
  [[ $status == 0 ]] || exit "$status"
}

# The kernel of the host and the abilities of its CPU: a cached kernel may fail on another.
cpu_id() {
  local line text=''
  while read -r line && [[ -n $line ]]; do
    case $line in vendor_id* | model* | flags*) text+=$line ;; esac
  done < /proc/cpuinfo
  text+=$(< /proc/sys/kernel/osrelease)
  text=$(sha256sum <<< "$text")
  echo "${text:0:12}"
}

# Callers that come meanwhile wait here and find the finished kernel.
build_under_lock() {
  exec 9> "$cache_dir/kernel.lock"
  flock -n 9 || { say "waiting for another build of the lab kernel"; flock 9; }
  if [[ -e $kernel ]]; then
    [[ ! -e $kernel_dir/boots-on-$(cpu_id) ]] || exit 0
    mark_if_it_boots && exit 0
    say "the cached lab kernel does not boot on this CPU: building it again"
    rm -rf "$kernel_dir"
  fi
  build_kernel
  mark_if_it_boots || die "the new lab kernel does not boot here; it said what is above" 3
  say "the lab kernel is ready in $kernel_dir"
}

say() { echo "sim/lab: $1" >&2; }

mark_if_it_boots() {
  local answer
  answer=$("$supervisor" run "base_dir=$base_dir" "kernel=$kernel" "init=$lab_dir/init" \
    timeout_s=60 "env=PATH=$PATH" -- /bin/echo booted 9>&-) || true
  [[ $answer == booted ]] && touch "$kernel_dir/boots-on-$(cpu_id)"
}

step() { say "building the lab kernel, once, about 4 minutes: $1"; }

build_kernel() {
  local missing=() pair
  for pair in gcc:gcc make:make flex:flex bison:bison bc:bc xz:xz-utils tar:tar patch:patch; do
    command -v "${pair%:*}" > /dev/null || missing+=("${pair#*:}")
  done
  find_source || missing+=(linux-source-6.1)
  [[ ${#missing[@]} == 0 ]] || need_packages "${missing[@]}"
  local free_kB
  free_kB=$(df --output=avail -k "$cache_dir" | tail -1)
  [[ $free_kB -gt 3000000 ]] || die "building the lab kernel needs 3 GB free in $cache_dir" 3

  rm -rf "$cache_dir"/build.*  # of a build that was killed; the lock says none runs
  work=$(mktemp -d "$cache_dir/build.XXXXXX")
  log=$cache_dir/build.log
  trap 'rm -rf "$work"' EXIT
  trap 'exit 130' INT TERM HUP
  : > "$log"
  step "unpacking $source_tar"
  tar -C "$work" --strip-components=1 -xf "$source_tar" 2>> "$log" || build_failed "unpacking"
  cd "$work"
  step "configuring"
  apply_patch
  configure >> "$log" 2>&1 || build_failed "configuring"
  check_config
  step "compiling with $(nproc) processes"
  compile >> "$log" 2>&1 || build_failed "compiling"
  mkdir "$work/done"
  cp linux .config "$work/done/"
  strip "$work/done/linux"
  mv -T "$work/done" "$kernel_dir"
  cd /
}

apply_patch() {
  grep -qF "$patch_old" $patch_file ||
    build_failed "patching (\"$patch_old\" is not in $patch_file of this source)"
  sed -i "s/$patch_old/$patch_new/" $patch_file
  local speed_patch
  for speed_patch in "${speed_patches[@]}"; do
    if patch -p1 -s --dry-run < "$speed_patch" >> "$log" 2>&1; then
      patch -p1 -s < "$speed_patch"
    else
      say "${speed_patch##*/} does not fit this source: the lab will be slower"
    fi
  done
}

configure() {
  make ARCH=um tinyconfig &&
    scripts/kconfig/merge_config.sh -m .config "$lab_dir/kernel.config" &&
    make ARCH=um olddefconfig
}

# Kconfig drops what it does not know or cannot have without a word.
check_config() {
  local line
  while read -r line; do
    grep -qxF "$line" .config || build_failed "configuring ($line was not taken)"
  done < <(grep '^CONFIG.*=[^n]' "$lab_dir/kernel.config")
}

compile() {
  local cc=gcc
  if command -v ccache > /dev/null; then cc='ccache gcc'; fi
  make ARCH=um CC="$cc" "-j$(nproc)" linux
}

build_failed() {
  tail -n 20 "$log" >&2
  die "the lab kernel failed while $1; the whole log is $log" 3
}
