// What the player does to the planning scene: objects that are told and that stand there, zones
// that are drawn and imported.
#include <ctime>
#include <fstream>

#include "sim/scenario/player.h"

namespace drover::sim {
namespace {

constexpr const char* kObjects = "collision_object";

/// What the stamps of messages are compared with.
Duration wall_time() {
  timespec t{};
  ::clock_gettime(CLOCK_REALTIME, &t);
  return std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec);
}

}  // namespace

void Player::publish_to_scene(const Action& action) {
  auto message = nlohmann::ordered_json::parse(action.text);
  if (action.in_sim_frame)
    message =
        in_map(std::move(message), map_shift(report_.fix(), mission_.origin, mission_.antenna));
  if (action.stamped_s_ago) set_stamps(message, wall_time() - from_s(*action.stamped_s_ago));
  publish(action.topic, message.dump(), action.retain);
}

/// First what stands there, then what is told: nobody is warned of a thing before it comes.
void Player::act_on_object(const ObjectSpec& spec, Time now) {
  const auto shift = map_shift(report_.fix(), mission_.origin, mission_.antenna);
  if (spec.there) tell_simulator(obstacle_command(spec));
  switch (spec.does) {
    case ObjectSpec::Does::appears:
      objects_[spec.id] = spec;
      view_.on_object(spec);
      if (spec.told) publish(kObjects, added_message(spec, shift).dump());
      return;
    case ObjectSpec::Does::moves:
      if (!objects_.contains(spec.id)) {
        broken_ = "object " + spec.id + ": it goes somewhere before it was there";
        return;
      }
      return journeys_.begin(objects_.at(spec.id), spec, now);
    case ObjectSpec::Does::goes:
      journeys_.end(spec.id);
      objects_.erase(spec.id);
      view_.on_object(spec);
      if (spec.told) publish(kObjects, removed_message(spec.id).dump());
  }
}

void Player::tell_journeys(Time now) {
  for (const auto& one : journeys_.due(now)) {
    objects_[one.object.id] = one.object;
    view_.on_object(one.object);
    const auto shift = map_shift(report_.fix(), mission_.origin, mission_.antenna);
    if (one.told) (void)client_->publish(kObjects, moved_message(one.object, shift).dump(), false);
    if (one.arrived) happened("object_arrived");
  }
}

void Player::act_on_zone(const ZoneSpec& zone) {
  const auto file = workplace_.log_folder() + "/" + zone.name + ".geojson";
  if (!zone.deleted) std::ofstream(file) << geojson(zone, mission_.origin);
  view_.on_zone(zone);
  start("drover", zone_words(zone, file));
}

}  // namespace drover::sim
