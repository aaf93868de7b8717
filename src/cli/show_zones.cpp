#include "cli/show_zones.h"

#include "cli/layout.h"
#include "cli/scene_lists.h"

namespace drover::cli {

namespace {

using json::Node;

std::string kind_words(const Node& zone) {
  return text(at(zone, "kind")) == "keep_in" ? "keep-in" : "keep-out";
}

std::string sentences(const Node& list, const char* label) {
  std::string out;
  for (std::size_t i = 0; i < count(list); ++i)
    out += std::string("  ") + label + ": " + text(entry(list, i)) + "\n";
  return out;
}

std::string zone_line(const Node& zone) {
  std::string out = padded(text(at(zone, "name")), kNameColumns) + "  ";
  if (const auto why = text(at(zone, "unreadable")); !why.empty())
    return out + "CANNOT BE READ: " + why + "\n";
  out += padded(kind_words(zone), 10) + quantity(at(zone, "area_m2"), "%12.1f m2") +
         quantity(at(zone, "perimeter_m"), "  %8.1f m around");
  const auto distance_m = at(zone, "distance_m").number();
  out += !distance_m          ? "  the robot does not know where it is"
         : *distance_m == 0.0 ? "  the robot is inside"
                              : "  " + distance(at(zone, "distance_m")) + " from the robot";
  if (at(zone, "bearing_deg").number())
    out += quantity(at(zone, "bearing_deg"), ", %.0f deg from north");
  return out + "  " + text(at(zone, "source")) + "\n" + sentences(at(zone, "warnings"), "warning");
}

}  // namespace

std::string show_zones(const Node& answer) {
  std::string out =
      nothing_is_free(answer,
                      "drover zone delete NAME of a zone that cannot be read, or drover zone "
                      "forget-unreadable when the whole file cannot; then import them anew");
  const auto& zones = at(answer, "zones");
  for (std::size_t i = 0; i < count(zones); ++i) out += zone_line(entry(zones, i));
  if (count(zones) == 0) out += "no zone\n";
  return out;
}

std::string bounds_nothing(const Node& answer) {
  const auto& zones = at(answer, "zones");
  if (zones.list() == nullptr) return "";
  for (std::size_t i = 0; i < count(zones); ++i)
    if (text(at(entry(zones, i), "kind")) != "keep_out") return "";  // also what cannot be read
  return count(zones) == 0 ? "NO ZONE IS LEFT: nothing bounds the robot now\n"
                           : "NO KEEP-IN IS LEFT: nothing bounds the robot now but the keep-outs\n";
}

std::string show_imported(const Node& answer) {
  const auto& zone = at(answer, "zone");
  std::string out = "done: the zone " + text(at(zone, "name")) + " is stored as " +
                    kind_words(zone) + ", and counts from now on";
  if (yes(at(answer, "replaced"))) out += ", in the place of the one that had its name";
  return out + "\n" + sentences(at(zone, "warnings"), "warning");
}

}  // namespace drover::cli
