#!/bin/bash
# The rights that config/mosquitto/drover.acl gives, at a real broker.  MOSQUITTO SOURCE_FOLDER
# Nobody is told that a message was dropped: a permitted one behind it shows that it was.
set -euo pipefail
mosquitto=$1
acl=$2/config/mosquitto/drover.acl

folder=$(mktemp -d)
broker=
finish() {
  [[ -z $broker ]] || kill "$broker" 2> /dev/null || true
  rm -rf "$folder"
}
trap finish EXIT

for user in droverd operator viewer; do
  touch "$folder/passwd"
  mosquitto_passwd -b "$folder/passwd" "$user" "$user"
done
# The broker gives up its rights when it is started by root.
install -m 644 "$acl" "$folder/acl"
chmod 755 "$folder"
chmod 644 "$folder/passwd"
cat > "$folder/conf" << CONF
listener 0 $folder/sock
allow_anonymous false
password_file $folder/passwd
acl_file $folder/acl
user $(id -un)
CONF
"$mosquitto" -c "$folder/conf" > "$folder/log" 2>&1 &
broker=$!
for ((i = 0; i < 100; ++i)); do
  [[ ! -S $folder/sock ]] || break
  sleep 0.1
done

as() {  # USER PROGRAM ARGUMENT...
  local user=$1 program=$2
  shift 2
  timeout 60 stdbuf -oL "$program" --unix "$folder/sock" -u "$user" -P "$user" "$@"
}

failed=0
# dropped TOPIC READER OWNER STRANGER...: a stranger's message never arrives, the owner's does.
dropped() {
  local topic=$1 reader=$2 owner=$3 heard user
  shift 3
  as "$reader" mosquitto_sub -t "$topic" -C 1 -d > "$folder/heard" 2>&1 &
  local subscriber=$!
  for ((i = 0; i < 100; ++i)); do
    ! grep -q SUBACK "$folder/heard" || break
    sleep 0.1
  done
  for user in "$@"; do as "$user" mosquitto_pub -q 1 -t "$topic" -m "of $user"; done
  as "$owner" mosquitto_pub -q 1 -t "$topic" -m "of $owner"
  wait "$subscriber" || true
  heard=$(grep '^of ' "$folder/heard" || true)
  if [[ $heard == "of $owner" ]]; then
    echo "ok - $reader hears $owner only on $topic"
  else
    echo "not ok - $reader heard '$heard' on $topic"
    failed=1
  fi
}

channel=pb%3Aaimrt.protocols.sensor
for type in JointCommand JointCommandArray; do
  dropped "/channel/%2Fjoint_command/$channel.$type" droverd operator viewer droverd
done
for message in %2Fjoint_state/$channel.JointState %2Fjoint_state/$channel.JointStateArray \
  %2Fimu_state/$channel.ImuState \
  %2Ftouch_state/$channel.TouchState %2Ftouch_state/$channel.TouchSensorStateArray; do
  for reader in operator viewer; do
    dropped "/channel/$message" "$reader" droverd operator viewer
  done
done
for topic in mqtt_control collision_object planning_constraints; do
  dropped "$topic" droverd operator viewer droverd
done
for topic in base_status scene_feedback; do
  dropped "$topic" viewer droverd operator viewer
done
dropped scene_feedback operator droverd operator viewer
exit "$failed"
