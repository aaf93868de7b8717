#include "publish/aimrt/topic.h"

#include "text/url.h"

namespace drover::publish::aimrt {

using text::url_encoded;

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
