// The `trajectory_data` topic: all tracks in one message.
#include "publish/rtk_navigation/trajectory_data.h"

#include "store/point_texts.h"

namespace drover::publish {

TrajectoryList::TrajectoryList(std::size_t bytes) {
  out_.reserve(bytes);
  out_.open('[');
}

void TrajectoryList::add(const store::Track& track) {
  out_.open('{').key("data").open('[');
  store::PointTexts texts(track);
  for (store::PointText point; texts.next(point);) {
    const auto& [longitude, latitude, angle, x, y, yaw, z] = point;
    out_.open('{');
    out_.key("angle").spelled_number(angle);
    out_.key("latitude").spelled_number(latitude);
    out_.key("longitude").spelled_number(longitude);
    out_.key("x").spelled_number(x);
    out_.key("y").spelled_number(y);
    out_.key("yaw").spelled_number(yaw);
    out_.key("z").spelled_number(z);
    out_.close('}');
  }
  out_.close(']').key("name").text(track.name).close('}');
}

std::string TrajectoryList::take() {
  return out_.close(']').take();
}

std::string trajectory_data_text(std::span<const store::Track> tracks) {
  TrajectoryList list(0);
  for (const store::Track& track : tracks) list.add(track);
  return list.take();
}

}  // namespace drover::publish
