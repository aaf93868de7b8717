#include "cli/zone_preview.h"

#include <GeographicLib/LocalCartesian.hpp>

#include "cli/layout.h"
#include "cli/reply.h"
#include "drover/angle.h"
#include "scene/zone/summary.h"
#include "text/number.h"

namespace drover::cli {

namespace {

using text::counted;
using text::formed;

std::string shape_text(const scene::ZoneSummary& summary) {
  return counted(summary.polygons, "polygon", "polygons") +
         (summary.holes > 0 ? ", " + counted(summary.holes, "hole", "holes") : "") + ", " +
         counted(summary.points, "point", "points");
}

std::string robot_text(const scene::ZoneSummary& summary) {
  if (!summary.from_robot) return "does not know where it is: look twice that this is the place";
  if (summary.from_robot->distance_m == 0) return "inside of it";
  return formed("%.2f m from it", summary.from_robot->distance_m) +
         formed(", which lies %.0f deg from north, clockwise",
                to_deg(summary.from_robot->bearing_rad));
}

/// One that cannot be read has neither kind nor area.
std::string old_text(const json::Node& old) {
  const auto area_m2 = at(old, "area_m2").number();
  if (!area_m2) return "the zone that has this name now";
  return std::string("the ") + (text(at(old, "kind")) == "keep_in" ? "keep-in" : "keep-out") +
         formed(" of this name (%.0f m2)", *area_m2);
}

bool is_other_kind(const json::Node& old, bool keeps_in) {
  const std::string was = text(at(old, "kind"));
  return !was.empty() && (was == "keep_in") != keeps_in;
}

}  // namespace

Whereabouts whereabouts_of(const json::Node& status) {
  Whereabouts found;
  const auto& origin = at(status, "origin");
  const auto latitude_deg = at(origin, "latitude_deg").number();
  const auto longitude_deg = at(origin, "longitude_deg").number();
  const auto altitude_m = at(origin, "altitude_m").number();
  if (!latitude_deg || !longitude_deg || !altitude_m) return found;
  found.origin = GeodeticPoint{*latitude_deg, *longitude_deg, *altitude_m};
  // Without a sigma the pose counts from where droverd was started: that is no place.
  const auto& pose = at(status, "pose");
  const auto x_m = at(pose, "x_m").number();
  const auto y_m = at(pose, "y_m").number();
  if (!x_m || !y_m || !at(pose, "position_sigma_m").number()) return found;
  const GeographicLib::LocalCartesian map(*latitude_deg, *longitude_deg, *altitude_m);
  GeodeticPoint robot;
  map.Reverse(*x_m, *y_m, 0, robot.latitude_deg, robot.longitude_deg, robot.altitude_m);
  found.robot = robot;
  return found;
}

std::string preview_text(const scene::NewZone& zone, const Whereabouts& from,
                         const json::Node* old) {
  const auto summary = scene::summarise(zone.zone, from.robot);
  const bool keeps_in = zone.zone.kind == scene::Zone::Kind::keep_in;
  std::string out;
  line(out, "zone", zone.zone.name);
  line(out, "kind",
       keeps_in ? "keep-in: the whole robot stays inside"
                : "keep-out: nothing of the robot comes into it");
  line(out, "shape", shape_text(summary));
  line(
      out, "area",
      formed("%.1f m2", summary.area_m2) +
          (summary.polygons > 1 ? ", the sum of " + counted(summary.polygons, "polygon", "polygons")
                                : ""));
  line(out, "perimeter", formed("%.1f m", summary.perimeter_m));
  line(out, "robot", robot_text(summary));
  if (old != nullptr) line(out, "replaces", old_text(*old));
  for (const auto& note : zone.notes) line(out, "note", note);
  if (old != nullptr && is_other_kind(*old, keeps_in))
    line(out, "warning",
         keeps_in ? "what was a keep-out of this name becomes a keep-in"
                  : "what was a keep-in of this name becomes a keep-out: THE FENCE IS GONE");
  for (const auto& warning : summary.warnings) line(out, "warning", warning);
  return out;
}

}  // namespace drover::cli
