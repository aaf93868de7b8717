// The slow half of the scene's requests: reading what is large, and writing it out.
#include <utility>

#include "drover/angle.h"
#include "json/located_json.h"
#include "publish/line_json.h"
#include "publish/scene_jobs.h"
#include "scene/zone/import_zone.h"
#include "scene/zone/project.h"
#include "scene/zone/summary.h"
#include "scene/zone/zone_text.h"

namespace drover::publish {
namespace {

/// A file of a zone with every byte escaped at its longest would not fit: such a file is none.
constexpr json::Limits kImportLimits{
    .max_bytes = std::size_t{6} << 20, .max_depth = 2, .max_values = 16};

std::optional<GeodeticPoint> on_earth(const RobotPlace& robot) {
  if (!robot.origin || !robot.in_map) return std::nullopt;
  return scene::place_on_earth(*robot.in_map, *robot.origin);
}

void write_zone(json::JsonText& out, const scene::Zone& zone, const RobotPlace& robot) {
  auto summary = scene::summarise(zone, on_earth(robot));
  if (robot.origin)
    if (auto shift = scene::datum_shift_text(zone, *robot.origin); !shift.empty())
      summary.warnings.push_back(std::move(shift));
  out.open('{').key("name").text(zone.name);
  out.key("kind").text(zone.kind == scene::Zone::Kind::keep_in ? "keep_in" : "keep_out");
  out.key("source").text(zone.source);
  out.key("polygons").integer(static_cast<std::int64_t>(summary.polygons));
  out.key("holes").integer(static_cast<std::int64_t>(summary.holes));
  out.key("points").integer(static_cast<std::int64_t>(summary.points));
  out.key("area_m2").number(summary.area_m2, 1);
  out.key("perimeter_m").number(summary.perimeter_m, 1);
  const auto& near = summary.from_robot;
  const bool outside = near && near->distance_m > 0;
  number_or_null(out, "distance_m", near ? std::optional(near->distance_m) : std::nullopt, 2);
  number_or_null(out, "bearing_deg",
                 outside ? std::optional(to_deg(near->bearing_rad)) : std::nullopt, 1);
  out.key("warnings").open('[');
  for (const std::string& warning : summary.warnings) out.text(warning);
  out.close(']').close('}');
}

Result<ZoneRead, std::string> import_line(std::string_view line, const RobotPlace& robot) {
  const auto parsed = json::parse(line, kImportLimits);
  if (!parsed) return "not understood: " + parsed.error().text();
  const json::Node& request = parsed->root;
  const std::string kind = text_member(request, "kind");
  if (kind != "keep_in" && kind != "keep_out")
    return std::string("kind must be keep_in or keep_out");
  const auto* text = request.find("text");
  if (text == nullptr || text->text() == nullptr) return std::string("text, the file, is missing");
  const scene::ZoneOrder order{
      text_member(request, "name"),
      kind == "keep_in" ? scene::Zone::Kind::keep_in : scene::Zone::Kind::keep_out,
      text_member(request, "source"), robot.origin};
  auto made = scene::import_zone(*text->text(), order);
  if (!made.ok()) return made.error().text();
  ZoneRead read{std::move(made.value().zone), {}, {}, std::move(made.value().notes)};
  read.text = scene::zone_text(read.zone);
  json::JsonText shown;
  write_zone(shown, read.zone, robot);
  read.shown = shown.take();
  return read;
}

std::string zone_list(const ListZones& list) {
  json::JsonText out;
  out.open('{').key("ok").boolean(true).key("zones").open('[');
  for (const scene::Zone& zone : *list.zones) write_zone(out, zone, list.robot);
  for (const auto& [name, why] : list.unreadable)
    out.open('{').key("name").text(name).key("unreadable").text(why).close('}');
  return out.close(']').key("problem").text(list.problem).close('}').take();
}

std::string shown_line(const SceneShown& shown) {
  json::JsonText out;
  out.open('{').key("ok").boolean(true);
  if (shown.object) {
    out.key("object").open('[');
    for (const auto& message : std::get<scene::StoredObject>(*shown.object).messages)
      write_scene(out, message);
    out.close(']');
  }
  if (shown.constraints) {
    out.key("constraints");
    write_scene(out, std::get<scene::StoredSet>(*shown.constraints).message);
  }
  return out.close('}').take();
}

}  // namespace

std::string zones_problem(const std::string& of_file,
                          const std::vector<UnreadableZone>& unreadable) {
  if (!of_file.empty() || unreadable.empty()) return of_file;
  const auto& [name, why] = unreadable.front();
  const std::string all = unreadable.size() == 1
                              ? "a stored zone"
                              : std::to_string(unreadable.size()) + " stored zones";
  return all + " cannot be read, \"" + json::shown(name, 60) + "\": " + why;
}

void do_scene_text_job(SceneTextReply& reply) {
  const auto& payload = reply.job.payload;
  if (const auto* parse = std::get_if<ParseMessages>(&reply.job.what)) {
    if (parse->topic == kTopicCollisionObject) {
      reply.result.emplace(parse_collision_objects(payload, Retain::no));
    } else {
      reply.result.emplace(parse_planning_constraints(payload, Retain::no));
    }
  } else if (const auto* zone = std::get_if<ImportZone>(&reply.job.what)) {
    reply.result.emplace(import_line(payload, zone->robot));
  } else if (const auto* list = std::get_if<ListZones>(&reply.job.what)) {
    reply.result.emplace(zone_list(*list));
  } else if (const auto* shown = std::get_if<WriteShown>(&reply.job.what)) {
    reply.result.emplace(shown_line(shown->shown));
  }
}

}  // namespace drover::publish
