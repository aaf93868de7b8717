# For scripts in which network namespaces play computers, sourced at their beginning with what they
# were called with: they go on in a network of their own.
if [[ ${!#} != --inside ]]; then
  for enter in -n -rn; do
    ! unshare "$enter" true 2> /dev/null || exec unshare "$enter" "$0" "$@" --inside
  done
  echo "not ok - no network namespaces can be made here"
  exit 1
fi

folder=$(mktemp -d)
children=()
finish() {
  for child in "${children[@]}"; do kill "$child" 2> /dev/null || true; done
  rm -rf "$folder"
}
trap finish EXIT

failed=0
judge() { if [[ $1 == 0 ]]; then echo "ok - $2"; else echo "not ok - $2"; failed=1; fi; }

within() {  # SECONDS COMMAND...
  local until=$((SECONDS + $1))
  shift
  until "$@" 2> /dev/null; do
    ((SECONDS < until)) || return 1
    sleep 0.1
  done
}
