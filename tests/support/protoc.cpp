#include "support/protoc.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "support/temp_folder.h"

namespace drover::test {

namespace {

constexpr const char* kCommon = R"(syntax = "proto3";
package aimrt.protocols.common;
message Header { uint64 time_stamp = 1; string frame_id = 2; uint64 sequence_num = 3; }
)";
constexpr const char* kGeometry = R"(syntax = "proto3";
package aimrt.protocols.geometry;
message Vector3 { double x = 1; double y = 2; double z = 3; }
message Quaternion { double x = 1; double y = 2; double z = 3; double w = 4; }
)";
constexpr const char* kSensor = R"(syntax = "proto3";
package aimrt.protocols.sensor;
import "common.proto";
import "geometry.proto";
message SingleJointState {
  string name = 1; double position = 2; double velocity = 3; double effort = 4;
}
message JointState {
  aimrt.protocols.common.Header header = 1; repeated SingleJointState joints = 2;
}
message SingleJointCommand {
  string name = 1; double position = 2; double velocity = 3; double effort = 4;
  double stiffness = 5; double damping = 6;
}
message JointCommand {
  aimrt.protocols.common.Header header = 1; repeated SingleJointCommand joints = 2;
}
message ImuState {
  aimrt.protocols.common.Header header = 1;
  aimrt.protocols.geometry.Quaternion orientation = 2;
  repeated double orientation_covariance = 3;
  aimrt.protocols.geometry.Vector3 angular_velocity = 4;
  repeated double angular_velocity_covariance = 5;
  aimrt.protocols.geometry.Vector3 linear_acceleration = 6;
  repeated double linear_acceleration_covariance = 7;
}
message SingleTouchSensorState { repeated int32 pressure = 1; }
message TouchState {
  aimrt.protocols.common.Header header = 1; repeated string names = 2;
  repeated SingleTouchSensorState states = 3;
}
)";

/// The same messages as AimRT 1.x has them, where JointState is one joint.
constexpr const char* kSensorOfAimrt = R"(syntax = "proto3";
package aimrt.protocols.sensor;
import "common.proto";
message JointState { string name = 1; double position = 2; double velocity = 3; double effort = 4; }
message JointStateArray {
  aimrt.protocols.common.Header header = 1; repeated JointState joints = 2;
}
message JointCommand {
  string name = 1; double position = 2; double velocity = 3; double effort = 4;
  double stiffness = 5; double damping = 6;
}
message JointCommandArray {
  aimrt.protocols.common.Header header = 1; repeated JointCommand joints = 2;
}
message TouchSensorState { repeated int32 pressure = 1; }
message TouchSensorStateArray {
  aimrt.protocols.common.Header header = 1; repeated string names = 2;
  repeated TouchSensorState states = 3;
}
)";

/// What a program makes of `input`. In its command line FOLDER and TYPE are replaced.
std::string run(std::string command, std::string_view type, std::string_view input) {
  const TempFolder folder;
  const auto path = [&folder](const char* name) { return folder.path() + "/" + name; };
  std::ofstream(path("common.proto")) << kCommon;
  std::ofstream(path("geometry.proto")) << kGeometry;
  std::ofstream(path("sensor.proto")) << (type.ends_with("Array") ? kSensorOfAimrt : kSensor);
  std::ofstream(path("in"), std::ios::binary) << input;
  const auto replace = [&command](std::string_view word, const std::string& with) {
    for (auto at = command.find(word); at != command.npos;
         at = command.find(word, at + with.size()))
      command.replace(at, word.size(), with);
  };
  replace("FOLDER", folder.path());
  replace("TYPE", "aimrt.protocols.sensor." + std::string(type));
  command += " < " + path("in") + " > " + path("out");
  if (std::system(command.c_str()) != 0) throw std::runtime_error(command + " failed");
  std::ifstream output(path("out"), std::ios::binary);
  return {std::istreambuf_iterator<char>(output), {}};
}

constexpr const char* kDescribe =
    DROVER_PROTOC " --proto_path=FOLDER --include_imports -oFOLDER/types sensor.proto && ";

}  // namespace

std::string protoc_decoded(std::string_view type, std::string_view message) {
  return run(DROVER_PROTOC " --proto_path=FOLDER --decode=TYPE sensor.proto", type, message);
}

std::string protoc_encoded(std::string_view type, std::string_view text) {
  return run(DROVER_PROTOC " --proto_path=FOLDER --encode=TYPE sensor.proto", type, text);
}

std::string protobuf_json(std::string_view type, std::string_view message) {
  return run(std::string(kDescribe) + DROVER_PROTOBUF_JSON " to TYPE FOLDER/types", type, message);
}

std::string protobuf_of_json(std::string_view type, std::string_view json) {
  return run(std::string(kDescribe) + DROVER_PROTOBUF_JSON " from TYPE FOLDER/types", type, json);
}

std::string message_of_packet(std::string_view packet) {
  constexpr std::string_view kStart("\x02pb\0", 4);
  constexpr std::string_view kJson("\x04json\0", 6);
  if (packet.starts_with(kJson)) return std::string(packet.substr(kJson.size()));
  if (!packet.starts_with(kStart)) throw std::runtime_error("no packet of AimRT's mqtt plugin");
  return std::string(packet.substr(kStart.size()));
}

}  // namespace drover::test
