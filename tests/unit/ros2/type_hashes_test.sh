#!/bin/bash
# Computes the type hashes of ROS 2 (RIHS01) from src/ros2/idl and compares them with those that
# src/ros2/topics.cpp tells, and with what ROS 2 itself prints where that is known.
#   type_hashes_test.sh SOURCE_FOLDER
set -euo pipefail
cd "$1"

# description PACKAGE/NAME: the type's description with all that it reaches, as it is hashed.
# String, which no topic has, is beside them: its hash is the best known one.
description() {
  awk -v wanted="$1" '
    function primitive(type) { return type in id }
    function field(owner, name, type,    base, size, offset, capacity, nested) {
      offset = capacity = 0
      nested = ""
      base = type
      if (match(type, /^sequence<.*>$/)) {
        base = substr(type, 10, length(type) - 10)
        offset = 144
        if (match(base, /,[0-9]+$/)) {
          capacity = substr(base, RSTART + 1)
          base = substr(base, 1, RSTART - 1)
          offset = 96
        }
      }
      if (match(name, /\[[0-9]+\]$/)) {
        capacity = substr(name, RSTART + 1, RLENGTH - 2)
        name = substr(name, 1, RSTART - 1)
        offset = 48
      }
      sub(/_$/, "", name)
      if (!primitive(base)) {
        sub(/::msg::dds_::/, "/msg/", base)
        sub(/_$/, "", base)
        nested = base
        reached[owner] = reached[owner] " " base
        base = "nested"
      }
      # Of octets the one that ROS calls byte.
      if (owner == "diagnostic_msgs/msg/DiagnosticStatus" && name == "level") base = "byte"
      if (owner == "moveit_msgs/msg/CollisionObject" && name == "operation") base = "byte"
      return sprintf("{\"name\": \"%s\", \"type\": {\"type_id\": %d, \"capacity\": %d, " \
                     "\"string_capacity\": 0, \"nested_type_name\": \"%s\"}}",
                     name, id[base] + offset, capacity, nested)
    }
    function reach(type,    names, n, i) {
      n = split(reached[type], names, " ")
      for (i = 1; i <= n; ++i)
        if (!(names[i] in seen)) {
          seen[names[i]] = 1
          reach(names[i])
        }
    }
    function told(type) {
      return "{\"type_name\": \"" type "\", \"fields\": [" fields[type] "]}"
    }
    BEGIN {
      n = split("nested 1 int8 2 octet 3 short 4 unsigned_short 5 long 6 unsigned_long 7 " \
                "float 10 double 11 boolean 15 byte 16 string 17", pairs, " ")
      for (i = 1; i < n; i += 2) id[pairs[i]] = pairs[i + 1]
    }
    /^module/ { package = $2 }
    /@final struct/ { type = package "/msg/" $3; sub(/_$/, "", type) }
    /;$/ && type != "" && !/}/ {
      sub(/;$/, "")
      sub(/unsigned /, "unsigned_")
      fields[type] = fields[type] (fields[type] == "" ? "" : ", ") field(type, $2, $1)
    }
    /^  }/ { type = "" }
    END {
      sub(/\//, "/msg/", wanted)
      reach(wanted)
      count = 0
      for (type in seen) names[++count] = type
      for (i = 2; i <= count; ++i)  # few: by insertion
        for (j = i; j > 1 && names[j] < names[j - 1]; --j) {
          swap = names[j]; names[j] = names[j - 1]; names[j - 1] = swap
        }
      printf "{\"type_description\": %s, \"referenced_type_descriptions\": [", told(wanted)
      for (i = 1; i <= count; ++i) printf "%s%s", (i > 1 ? ", " : ""), told(names[i])
      printf "]}"
    }' src/ros2/idl/*.idl - <<'IDL'
module std_msgs { module msg { module dds_ {
  @final struct String_ {
    string data_;
  };
}; }; };
IDL
}

computed() { description "$1" | sha256sum | cut -d' ' -f1; }

# What `ros2 topic info -v` prints of the type, or other public programs have as a constant.
published() {
  case $1 in
    sensor_msgs/Imu)
      echo 7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b ;;
    sensor_msgs/JointState)
      echo a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e ;;
    sensor_msgs/NavSatFix)
      echo 62223ab3fe210a15976021da7afddc9e200dc9ec75231c1b6a557fc598a65404 ;;
    sensor_msgs/BatteryState)
      echo 4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741 ;;
    sensor_msgs/LaserScan)
      echo 64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828 ;;
    nav_msgs/Odometry)
      echo 3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0 ;;
    tf2_msgs/TFMessage)
      echo e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087 ;;
    std_msgs/String)
      echo df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18 ;;
    std_msgs/Bool)
      echo feb91e995ff9ebd09c0cb3d2aed18b11077585839fb5db80193b62d74528f6c9 ;;
    diagnostic_msgs/DiagnosticArray)
      echo 5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e ;;
    geometry_msgs/PoseWithCovarianceStamped)
      echo 26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e ;;
    geometry_msgs/Twist)
      echo 9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a ;;
    geometry_msgs/PoseStamped)
      echo 10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8 ;;
    geometry_msgs/TwistStamped)
      echo 5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64 ;;
  esac
}

failed=0
judge() {
  if [[ $2 == "$3" ]]; then echo "ok - $1"; else echo "not ok - $1: $2, not $3"; failed=1; fi
}

for type in sensor_msgs/Imu sensor_msgs/JointState sensor_msgs/NavSatFix sensor_msgs/BatteryState \
  sensor_msgs/LaserScan nav_msgs/Odometry tf2_msgs/TFMessage geometry_msgs/Twist \
  geometry_msgs/TwistStamped geometry_msgs/PoseStamped geometry_msgs/PoseWithCovarianceStamped \
  diagnostic_msgs/DiagnosticArray std_msgs/Bool std_msgs/String; do
  judge "$type is hashed as ROS 2 does" "$(computed "$type")" "$(published "$type")"
done
# Each type that a topic has: "&sensor_msgs_msg_dds__Imu__desc," and its hash.
count=0
while read -r type hash; do
  count=$((count + 1))
  judge "$type has the hash that its topic tells" "$(computed "$type")" "$hash"
done < <(tr '\n' ' ' < src/ros2/topics.cpp |
  grep -oE '&[a-z0-9_]+_msg_dds__[A-Za-z]+__desc, +"[0-9a-f]{64}"' |
  sed -E 's/^&([a-z0-9_]+)_msg_dds__([A-Za-z]+)__desc, +"([0-9a-f]+)"/\1\/\2 \3/')
judge "every topic has a hash" "$count" "$(grep -cE '__desc,' src/ros2/topics.cpp)"
exit "$failed"
