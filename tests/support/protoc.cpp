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

std::string protoc(const std::string& mode, std::string_view type, std::string_view input) {
  const TempFolder folder;
  const auto path = [&folder](const char* name) { return folder.path() + "/" + name; };
  std::ofstream(path("common.proto")) << kCommon;
  std::ofstream(path("geometry.proto")) << kGeometry;
  std::ofstream(path("sensor.proto")) << kSensor;
  std::ofstream(path("in"), std::ios::binary) << input;
  const auto command = std::string(DROVER_PROTOC) + " --proto_path=" + folder.path() + " --" +
                       mode + "=aimrt.protocols.sensor." + std::string(type) + " sensor.proto < " +
                       path("in") + " > " + path("out");
  if (std::system(command.c_str()) != 0) throw std::runtime_error(command + " failed");
  std::ifstream output(path("out"), std::ios::binary);
  return {std::istreambuf_iterator<char>(output), {}};
}

}  // namespace

std::string protoc_decoded(std::string_view type, std::string_view message) {
  return protoc("decode", type, message);
}

std::string protoc_encoded(std::string_view type, std::string_view text) {
  return protoc("encode", type, text);
}

std::string message_of_packet(std::string_view packet) {
  constexpr std::string_view kStart("\x02pb\0", 4);
  if (!packet.starts_with(kStart)) throw std::runtime_error("no packet of AimRT's mqtt plugin");
  return std::string(packet.substr(kStart.size()));
}

}  // namespace drover::test
