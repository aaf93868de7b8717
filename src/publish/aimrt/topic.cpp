#include "publish/aimrt/topic.h"

namespace drover::publish::aimrt {

namespace {

// <cctype> follows the locale.
bool stays(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || c == '.' || c == '~';
}

}  // namespace

std::string url_encoded(std::string_view text) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : text) {
    if (stays(c)) {
      encoded += c;
    } else if (c == ' ') {
      encoded += '+';
    } else {
      const auto byte = static_cast<unsigned char>(c);
      encoded += '%';
      encoded += kHex[byte >> 4U];
      encoded += kHex[byte & 0xFU];
    }
  }
  return encoded;
}

std::string_view type_name(Role role, Names names) {
  const bool document = names == Names::document;
  switch (role) {
    case Role::joint_state: return document ? "JointState" : "JointStateArray";
    case Role::imu_state: return "ImuState";
    case Role::touch_state: return document ? "TouchState" : "TouchSensorStateArray";
    case Role::joint_command: return document ? "JointCommand" : "JointCommandArray";
  }
  return "";
}

std::string mqtt_topic(std::string_view channel_topic, Role role, Names names) {
  return "/channel/" + url_encoded(channel_topic) + "/" +
         url_encoded("pb:aimrt.protocols.sensor." + std::string(type_name(role, names)));
}

}  // namespace drover::publish::aimrt
