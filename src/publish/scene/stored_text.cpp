#include "publish/scene/stored_text.h"

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "json/located_json.h"
#include "publish/scene/messages.h"

namespace drover::publish {
namespace {

constexpr std::string_view kPlaceSigma = "place_sigma_m";
constexpr json::Limits kPlaceLimits{.max_bytes = 1000, .max_depth = 2, .max_values = 10};

template <class Message>
std::string text_of(std::span<const Message> messages, const GeodeticPoint& origin,
                    double place_sigma_m) {
  json::JsonText out;
  out.open('{').key("latitude_deg").number(origin.latitude_deg);
  out.key("longitude_deg").number(origin.longitude_deg);
  out.key("altitude_m").number(origin.altitude_m);
  if (place_sigma_m != 0) out.key(kPlaceSigma).number(place_sigma_m);
  out.close('}');
  std::string text = out.take() + "\n";
  out = {};
  out.open('[');
  for (const Message& message : messages) write_scene(out, message);
  return text + out.close(']').take();
}

struct StoredPlace {
  GeodeticPoint origin;
  double sigma_m = 0;
};

/// Texts of before the sigma was kept have none.
std::optional<StoredPlace> read_place(std::string_view line) {
  const auto parsed = json::parse(line, kPlaceLimits);
  if (!parsed) return std::nullopt;
  StoredPlace place;
  GeodeticPoint& origin = place.origin;
  const std::pair<std::string_view, double*> members[] = {{"latitude_deg", &origin.latitude_deg},
                                                          {"longitude_deg", &origin.longitude_deg},
                                                          {"altitude_m", &origin.altitude_m}};
  for (const auto& [name, value] : members) {
    const auto* node = parsed->root.find(name);
    const auto number = node == nullptr ? std::nullopt : node->number();
    if (!number) return std::nullopt;
    *value = *number;
  }
  const auto* sigma = parsed->root.find(kPlaceSigma);
  if (sigma == nullptr) return place;
  const auto number = sigma->number();
  if (!number || !(*number >= 0)) return std::nullopt;
  place.sigma_m = *number;
  return place;
}

template <class Message>
struct Stored {
  std::vector<Message> messages;
  StoredPlace place;
};

template <class Message, class Parse>
Result<Stored<Message>, scene::Refusal> read_stored(std::string_view text, Parse parse) {
  const auto end = text.find('\n');
  const auto place = read_place(text.substr(0, end));
  if (end == std::string_view::npos || !place)
    return scene::Refusal{"", "the first line is no origin"};
  auto read = parse(text.substr(end + 1), Retain::no, kStoredSceneLimits);
  if (!read.ok()) return read.error();
  if (read->messages.empty()) return scene::Refusal{"", "there is no message"};
  Stored<Message> stored{{}, *place};
  for (auto& message : read.value().messages) {
    if (!message.result.ok()) return message.result.error();
    stored.messages.push_back(std::move(message.result.value().message));
  }
  return stored;
}

}  // namespace

std::string stored_text(const scene::StoredObject& object) {
  return text_of<scene::CollisionObject>(object.messages, object.origin, object.place_sigma_m);
}

std::string stored_text(const scene::StoredSet& set) {
  return text_of<scene::Constraints>({&set.message, 1}, set.origin, 0);
}

Result<scene::StoredObject, scene::Refusal> read_stored_object(std::string_view text) {
  auto read = read_stored<scene::CollisionObject>(text, parse_collision_objects);
  if (!read.ok()) return read.error();
  return scene::StoredObject{std::move(read.value().messages), read->place.origin,
                             read->place.sigma_m};
}

Result<scene::StoredSet, scene::Refusal> read_stored_set(std::string_view text) {
  auto read = read_stored<scene::Constraints>(text, parse_planning_constraints);
  if (!read.ok()) return read.error();
  if (read->messages.size() != 1) return scene::Refusal{"", "there is more than one message"};
  return scene::StoredSet{std::move(read.value().messages.front()), read->place.origin};
}

}  // namespace drover::publish
