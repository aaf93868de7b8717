#include "sim/scenario/scene_object.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "drover/angle.h"

namespace drover::sim {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct Form {
  const char* name;
  std::size_t sizes;
  int type;  // of SolidPrimitive
};
constexpr std::array<Form, 4> kForms{
    {{"box", 3, 1}, {"sphere", 1, 2}, {"cylinder", 2, 3}, {"cone", 2, 4}}};

const Form& form_of(const std::string& shape) {
  return *std::find_if(kForms.begin(), kForms.end(),
                       [&shape](const Form& form) { return shape == form.name; });
}

std::vector<double> numbers(JsonReader& reader, const json& raw, const char* key,
                            std::size_t count) {
  if (!reader.has(key)) reader.fail(key, "is missing");
  reader.ignore(key);
  const auto& list = raw.at(key);
  if (!list.is_array() || list.size() != count)
    reader.fail(key, "must have " + std::to_string(count) + " numbers");
  std::vector<double> values;
  for (const auto& value : list) {
    if (!value.is_number()) reader.fail(key, "must have numbers only");
    values.push_back(value.get<double>());
  }
  return values;
}

double height_m(const ObjectSpec& spec) {
  return spec.shape == "sphere" ? 2 * spec.sizes_m[0] : spec.sizes_m.back();
}

/// The document has the height first, and then the radius.
std::vector<double> dimensions(const ObjectSpec& spec) {
  if (spec.shape == "cylinder" || spec.shape == "cone") return {spec.sizes_m[1], spec.sizes_m[0]};
  return spec.sizes_m;
}

ordered_json pose_of(const ObjectSpec& spec, const TrackPose& shift) {
  const double half_rad = to_rad(spec.yaw_deg) / 2;
  return {
      {"position",
       {{"x", spec.x_m + shift.x_m},
        {"y", spec.y_m + shift.y_m},
        {"z", spec.z_m.value_or(height_m(spec) / 2)}}},
      {"orientation", {{"x", 0}, {"y", 0}, {"z", std::sin(half_rad)}, {"w", std::cos(half_rad)}}}};
}

std::string words(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    std::array<char, 32> digits{};
    const int n = std::snprintf(digits.data(), digits.size(), " %.6g", value);
    text.append(digits.data(), static_cast<std::size_t>(n));
  }
  return text;
}

bool is_in_map(const ordered_json& object) {
  const auto header = object.find("header");
  if (header == object.end() || !header->is_object()) return false;
  const auto frame = header->value("frame_id", "");
  return frame == "map" || frame == "1";
}

void shift_positions(ordered_json& value, const TrackPose& shift, bool in_map) {
  if (value.is_array())
    for (auto& item : value) shift_positions(item, shift, in_map);
  if (!value.is_object()) return;
  if (value.contains("header")) in_map = is_in_map(value);
  for (auto& [key, member] : value.items()) {
    if (key == "position" && member.is_object() && in_map) {
      member["x"] = member.value("x", 0.0) + shift.x_m;
      member["y"] = member.value("y", 0.0) + shift.y_m;
    } else {
      shift_positions(member, shift, in_map);
    }
  }
}

}  // namespace

ObjectSpec read_object(JsonReader reader, const json& raw) {
  ObjectSpec spec;
  spec.id = reader.text("id");
  if (spec.id.empty() || spec.id.find_first_of(" \t\r\n") != std::string::npos)
    reader.fail("id", "must be one word");
  spec.told = reader.flag("told", true);
  spec.there = reader.flag("there", true);
  if (reader.flag("gone", false)) {
    spec.does = ObjectSpec::Does::goes;
  } else if (reader.has("to")) {
    spec.does = ObjectSpec::Does::moves;
    const auto to = numbers(reader, raw, "to", 2);
    spec.x_m = to[0];
    spec.y_m = to[1];
    spec.speed_mps = reader.number("speed_mps", spec.speed_mps);
    spec.told_Hz = reader.number("told_Hz", spec.told_Hz);
    if (!(spec.speed_mps > 0)) reader.fail("speed_mps", "must be above 0");
    if (!(spec.told_Hz > 0 && spec.told_Hz <= 100)) reader.fail("told_Hz", "must be 0 to 100");
  } else {
    for (const auto& form : kForms) {
      if (!reader.has(form.name)) continue;
      if (!spec.shape.empty()) reader.fail(form.name, "is a second shape");
      spec.shape = form.name;
      spec.sizes_m = numbers(reader, raw, form.name, form.sizes);
    }
    if (spec.shape.empty()) reader.fail("", "must have box, cylinder, sphere, cone, to or gone");
    const auto at = numbers(reader, raw, "at", 2);
    spec.x_m = at[0];
    spec.y_m = at[1];
    spec.yaw_deg = reader.number("yaw_deg", 0);
    if (reader.has("z_m")) spec.z_m = reader.number("z_m");
  }
  reader.done();
  return spec;
}

std::string obstacle_command(const ObjectSpec& spec) {
  std::string text = "obstacle " + spec.id;
  if (spec.does == ObjectSpec::Does::goes) return text + " remove";
  if (spec.does == ObjectSpec::Does::moves)
    return text + " move" + words({spec.x_m, spec.y_m, spec.speed_mps});
  text += " " + spec.shape + words({spec.x_m, spec.y_m});
  if (spec.shape == "box") text += words({spec.yaw_deg});
  for (const double size_m : spec.sizes_m) text += words({size_m});
  if (spec.z_m) text += words({*spec.z_m});
  return text;
}

std::vector<TrackPose> outline(const ObjectSpec& spec) {
  std::vector<TrackPose> corners;
  const double c = std::cos(to_rad(spec.yaw_deg));
  const double s = std::sin(to_rad(spec.yaw_deg));
  const auto add = [&](double x_m, double y_m) {
    corners.push_back({spec.x_m + c * x_m - s * y_m, spec.y_m + s * x_m + c * y_m, 0});
  };
  if (spec.shape == "box") {
    const double x_m = spec.sizes_m[0] / 2;
    const double y_m = spec.sizes_m[1] / 2;
    add(x_m, y_m), add(-x_m, y_m), add(-x_m, -y_m), add(x_m, -y_m);
  } else {
    for (int i = 0; i < 12; ++i)
      add(spec.sizes_m[0] * std::cos(kPi * i / 6), spec.sizes_m[0] * std::sin(kPi * i / 6));
  }
  return corners;
}

ordered_json added_message(const ObjectSpec& spec, const TrackPose& shift) {
  const ordered_json primitive{{"type", form_of(spec.shape).type},
                               {"dimensions", dimensions(spec)}};
  return {{"header", {{"frame_id", "map"}}},
          {"id", spec.id},
          {"primitives", ordered_json::array({primitive})},
          {"primitive_poses", ordered_json::array({pose_of(spec, shift)})},
          {"operation", 0}};
}

ordered_json moved_message(const ObjectSpec& spec, const TrackPose& shift) {
  return {{"header", {{"frame_id", "map"}}},
          {"id", spec.id},
          {"primitive_poses", ordered_json::array({pose_of(spec, shift)})},
          {"operation", 3}};
}

ordered_json removed_message(const std::string& id) {
  return {{"id", id}, {"operation", 1}};
}

ordered_json in_map(ordered_json message, const TrackPose& shift) {
  shift_positions(message, shift, false);
  return message;
}

void set_stamps(ordered_json& message, Duration since_epoch) {
  if (message.is_array())
    for (auto& item : message) set_stamps(item, since_epoch);
  if (!message.is_object()) return;
  const auto ns = since_epoch.count();
  for (auto& [key, member] : message.items()) {
    if (key == "header" && member.is_object()) {
      member["stamp"] = {{"sec", ns / 1'000'000'000}, {"nsec", ns % 1'000'000'000}};
    } else {
      set_stamps(member, since_epoch);
    }
  }
}

void Journeys::begin(const ObjectSpec& object, const ObjectSpec& journey, Time now) {
  end(object.id);
  journeys_.push_back({object, journey, now, now});
}

void Journeys::end(const std::string& id) {
  std::erase_if(journeys_, [&id](const Journey& one) { return one.object.id == id; });
}

std::vector<Journeys::Arrival> Journeys::due(Time now) {
  std::vector<Arrival> due;
  for (auto& journey : journeys_) {
    if (now < journey.next) continue;
    journey.next = std::max(journey.next + from_s(1 / journey.to.told_Hz), now);
    const double dx_m = journey.to.x_m - journey.object.x_m;
    const double dy_m = journey.to.y_m - journey.object.y_m;
    const double way_m = std::hypot(dx_m, dy_m);
    const double gone_m = journey.to.speed_mps * to_s(now - journey.begin);
    const bool arrived = !(gone_m < way_m);
    ObjectSpec at = journey.object;
    at.x_m = arrived ? journey.to.x_m : at.x_m + dx_m / way_m * gone_m;
    at.y_m = arrived ? journey.to.y_m : at.y_m + dy_m / way_m * gone_m;
    due.push_back({at, journey.to.told, arrived});
  }
  for (const auto& one : due)
    if (one.arrived) end(one.object.id);
  return due;
}

Time Journeys::next() const {
  Time next = Time::max();
  for (const auto& journey : journeys_) next = std::min(next, journey.next);
  return next;
}

}  // namespace drover::sim
