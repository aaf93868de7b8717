// MQTT topics of AimRT's channel: /channel/<topic>/<type>, both URL-encoded.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace drover::publish::aimrt {

/// What a message is for. Its bytes are the same under both names.
enum class Role : std::uint8_t { joint_state, imu_state, touch_state, joint_command };

/// Two families name the outer messages differently. `JointState` is the outer one of the first
/// and one joint of the second.
enum class Names : std::uint8_t {
  document,  ///< of the protocol's document: JointState, JointCommand, TouchState
  aimrt_1x,  ///< as AimRT 1.x: JointStateArray, JointCommandArray, TouchSensorStateArray
};

/// Type in the package aimrt.protocols.sensor. An ImuState has the same name in both.
std::string_view type_name(Role role, Names names);

/// The MQTT topic of a channel topic ("/joint_state") for a protobuf message.
std::string mqtt_topic(std::string_view channel_topic, Role role, Names names);

}  // namespace drover::publish::aimrt
