// The `trajectory_data` topic: all tracks in one message.
#include "publish/rtk_navigation/trajectory_data.h"

#include "config/json_text.h"

namespace drover::publish {

std::string trajectory_data_text(std::span<const store::Track> tracks) {
  json::JsonText out;
  out.open('[');
  for (const store::Track& track : tracks) {
    out.open('{').key("data").open('[');
    for (const store::TrackPoint& point : track.points) {
      out.open('{');
      out.key("angle").number(point.angle_deg);
      out.key("latitude").number(point.latitude_deg);
      out.key("longitude").number(point.longitude_deg);
      out.key("x").number(point.x_m);
      out.key("y").number(point.y_m);
      out.key("yaw").number(point.yaw_rad);
      out.key("z").number(point.z_m);
      out.close('}');
    }
    out.close(']').key("name").text(track.name).close('}');
  }
  return out.close(']').str();
}

}  // namespace drover::publish
