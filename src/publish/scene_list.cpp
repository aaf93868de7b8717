#include "publish/scene_list.h"

#include "publish/line_json.h"

namespace drover::publish {

std::string scene_list_line(const SceneListed& listed, const SceneSaver& saver,
                            const std::optional<scene::Point2>& robot, std::string_view problem) {
  json::JsonText out;
  out.open('{').key("ok").boolean(true).key("objects").open('[');
  for (const SceneRow& row : listed.rows) {
    if (row.kind != store::kObjectKind) continue;
    std::optional<double> distance_m;
    // What is higher or lower than the robot has its place only.
    const auto& there = row.nearest ? row.nearest : row.in_map;
    if (robot && there) distance_m = length_m(*there - *robot);
    out.open('{').key("id").text(row.name);
    out.key("shapes").integer(static_cast<std::int64_t>(row.shapes));
    out.key("triangles").integer(static_cast<std::int64_t>(row.triangles));
    number_or_null(out, "x_m", row.in_map ? std::optional(row.in_map->x_m) : std::nullopt, 3);
    number_or_null(out, "y_m", row.in_map ? std::optional(row.in_map->y_m) : std::nullopt, 3);
    number_or_null(out, "distance_m", distance_m, 2);
    number_or_null(out, "arrived_s", saver.arrived_s(row.kind, row.name), 3);
    out.close('}');
  }
  out.close(']').key("constraints").open('[');
  for (const SceneRow& row : listed.rows) {
    if (row.kind != store::kConstraintKind) continue;
    out.open('{').key("name").text(row.name);
    out.key("joint").integer(static_cast<std::int64_t>(row.joint));
    out.key("position").integer(static_cast<std::int64_t>(row.position));
    out.key("orientation").integer(static_cast<std::int64_t>(row.orientation));
    out.key("visibility").integer(static_cast<std::int64_t>(row.visibility));
    number_or_null(out, "arrived_s", saver.arrived_s(row.kind, row.name), 3);
    out.close('}');
  }
  return out.close(']').key("problem").text(problem).close('}').take();
}

}  // namespace drover::publish
