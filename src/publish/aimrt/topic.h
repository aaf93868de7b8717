// MQTT topics of AimRT's channel: /channel/<topic>/<type>, both URL-encoded.
#pragma once

#include <string>
#include <string_view>

namespace drover::publish::aimrt {

/// AimRT's encoding: letters, digits and "-_.~" stay, a space is '+', every other byte is %XX in
/// upper case.
std::string url_encoded(std::string_view text);

/// The MQTT topic of a channel topic ("/joint_state") with a protobuf type of
/// aimrt.protocols.sensor ("JointState").
std::string mqtt_topic(std::string_view channel_topic, std::string_view type);

}  // namespace drover::publish::aimrt
