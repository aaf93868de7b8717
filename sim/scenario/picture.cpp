#include "sim/scenario/picture.h"

#include <algorithm>

#include "sim/scenario/map_sketch.h"

namespace drover::sim {
namespace {

const Mark kDriven{"•", Colour::green};
const Mark kWaited{"w", Colour::bold};
const Mark kBox{"█", Colour::yellow};
const Mark kRound{"●", Colour::yellow};
const Mark kKeepOut{"▒", Colour::red};
const Mark kKeepIn{"+", Colour::blue};
const Mark kGoal{"G", Colour::bold};

bool is_box(const ObjectSpec& object) {
  return object.shape == "box";
}

/// Only of what is there.
std::string legend(const Surroundings& around) {
  const auto any_object = [&around](bool box) {
    return std::any_of(around.objects.begin(), around.objects.end(),
                       [box](const auto& one) { return is_box(one.second) == box; });
  };
  const auto any_zone = [&around](bool keep_in) {
    return std::any_of(around.zones.begin(), around.zones.end(),
                       [keep_in](const auto& one) { return one.second.keep_in == keep_in; });
  };
  std::string text = ", north up  · track";
  if (!around.driven.empty()) text += "  " + kDriven.text + " driven";
  if (!around.waited.empty()) text += "  " + kWaited.text + " waited";
  text += "  G goal  ↑ robot";
  const std::string marks = std::string(any_object(true) ? kBox.text : "") +
                            (any_object(false) ? kRound.text : "") +
                            (around.obstacles.empty() ? "" : "#");
  if (!marks.empty()) text += "  " + marks + " object";
  if (any_zone(false)) text += "  " + kKeepOut.text + " keep-out";
  if (any_zone(true)) text += "  " + kKeepIn.text + " keep-in";
  return text;
}

}  // namespace

std::vector<std::string> map_lines(const std::vector<TrackPose>& track, std::size_t goal,
                                   const Surroundings& around,
                                   const std::optional<TrackPose>& robot, bool coloured) {
  MapSketch map(track);
  for (const auto& [name, zone] : around.zones)
    if (zone.keep_in)
      map.put_edge(zone.polygon, kKeepIn);
    else
      map.put_area(zone.polygon, kKeepOut);
  map.put_way(around.driven, kDriven);
  for (const auto& place : around.waited) map.put(place, kWaited);
  for (const auto& [name, place] : around.obstacles) map.put(place, {"#", Colour::yellow});
  for (const auto& [id, object] : around.objects)
    map.put_area(outline(object), is_box(object) ? kBox : kRound);
  if (goal < track.size()) map.put(track[goal], kGoal);
  if (robot) map.put(*robot, {arrow(robot->yaw_rad), Colour::bold});
  // The names come last: they look for room.
  for (const auto& [name, zone] : around.zones)
    map.put_name(zone.polygon, name, zone.keep_in ? kKeepIn.colour : kKeepOut.colour);
  for (const auto& [id, object] : around.objects) map.put_name(outline(object), id, Colour::yellow);
  auto lines = map.rows(coloured);
  lines.push_back(map.scale() + legend(around));
  return lines;
}

std::string fitted(const std::string& text, std::size_t width) {
  auto all = characters(text);
  if (all.size() <= width || width == 0) return text;
  std::string out;
  for (std::size_t i = 0; i + 1 < width; ++i) out += all[i];
  return out + "…";
}

}  // namespace drover::sim
