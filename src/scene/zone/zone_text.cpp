// A zone as text that is kept on disk: JSON of our own, whose numbers read back to the bit.
#include "scene/zone/zone_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "json/json_text.h"
#include "json/located_json.h"
#include "scene/zone/zone_checks.h"

namespace drover::scene {
namespace {

using json::Node;

constexpr std::string_view kKeepIn = "keep_in";
constexpr std::string_view kKeepOut = "keep_out";
/// Points are lists; this says of what, so that nobody has to guess.
constexpr std::array<std::string_view, 2> kOrder = {"latitude_deg", "longitude_deg"};
constexpr std::array<std::string_view, 6> kKeys = {"name",  "kind",  "source",
                                                   "datum", "order", "polygons"};

std::string quoted(std::string_view text) {
  return json::JsonText().text(text).take();
}

/// A zero has no sign: "-0" would be read as the integer 0.
std::string digits(double value) {
  return json::JsonText().number(value + 0.0).take();
}

template <class Items, class Write>
std::string list_of(const Items& items, Write write) {
  std::string out = "[";
  for (const auto& item : items) {
    if (out.size() > 1) out += ',';
    out += write(item);
  }
  return out + ']';
}

std::string ring_text(const GeoRing& ring) {
  return list_of(ring, [](const GeoPoint& point) {
    return '[' + digits(point.latitude_deg) + ',' + digits(point.longitude_deg) + ']';
  });
}

std::string polygon_text(const GeoPolygon& polygon) {
  return R"({"outer":)" + ring_text(polygon.outer) + R"(,"holes":)" +
         list_of(polygon.holes, ring_text) + '}';
}

std::string datum_text(const std::optional<GeodeticPoint>& datum) {
  if (!datum) return "null";
  return R"({"latitude_deg":)" + digits(datum->latitude_deg) + R"(,"longitude_deg":)" +
         digits(datum->longitude_deg) + R"(,"altitude_m":)" + digits(datum->altitude_m) + '}';
}

const std::string* text_of(const Node& node, std::string_view key) {
  const Node* member = node.find(key);
  return member == nullptr ? nullptr : member->text();
}

std::optional<double> number_of(const Node& node, std::string_view key) {
  const Node* member = node.find(key);
  return member == nullptr ? std::nullopt : member->number();
}

bool has_our_order(const Node& root) {
  const Node* order = root.find("order");
  if (order == nullptr || order->list() == nullptr || order->list()->size() != kOrder.size())
    return false;
  return std::equal(kOrder.begin(), kOrder.end(), order->list()->begin(),
                    [](std::string_view word, const Node& node) {
                      return node.text() != nullptr && *node.text() == word;
                    });
}

bool read_ring(const Node& node, GeoRing& ring) {
  if (node.list() == nullptr) return false;
  for (const Node& point : *node.list()) {
    if (point.list() == nullptr || point.list()->size() != 2) return false;
    const auto latitude_deg = (*point.list())[0].number();
    const auto longitude_deg = (*point.list())[1].number();
    if (!latitude_deg || !longitude_deg) return false;
    ring.push_back({*latitude_deg, *longitude_deg});
  }
  return true;
}

bool read_polygon(const Node& node, GeoPolygon& polygon) {
  const Node* outer = node.find("outer");
  const Node* holes = node.find("holes");
  if (outer == nullptr || !read_ring(*outer, polygon.outer)) return false;
  if (node.object()->size() != 2 || holes == nullptr || holes->list() == nullptr) return false;
  for (const Node& hole : *holes->list()) {
    polygon.holes.emplace_back();
    if (!read_ring(hole, polygon.holes.back())) return false;
  }
  return true;
}

std::optional<Refusal> read_datum(const Node* node, Zone& zone) {
  if (node == nullptr) return Refusal{"datum", "is missing"};
  if (node->is_null()) return std::nullopt;
  const auto latitude_deg = number_of(*node, "latitude_deg");
  const auto longitude_deg = number_of(*node, "longitude_deg");
  const auto altitude_m = number_of(*node, "altitude_m");
  if (!latitude_deg || !longitude_deg || !altitude_m || std::abs(*latitude_deg) > 90)
    return Refusal{"datum", "is no latitude, longitude and altitude"};
  zone.datum = GeodeticPoint{*latitude_deg, *longitude_deg, *altitude_m};
  return std::nullopt;
}

std::optional<Refusal> read_polygons(const Node* node, Zone& zone) {
  if (node == nullptr || node->list() == nullptr) return Refusal{"polygons", "has to be a list"};
  for (const Node& polygon : *node->list()) {
    const std::string path = "polygons[" + std::to_string(zone.polygons.size()) + "]";
    zone.polygons.emplace_back();
    if (!read_polygon(polygon, zone.polygons.back()))
      return Refusal{path, "is no outer ring and holes, all of pairs of numbers"};
  }
  return std::nullopt;
}

std::optional<Refusal> read_words(const Node& root, Zone& zone) {
  for (const json::Member& member : *root.object()) {
    if (std::find(kKeys.begin(), kKeys.end(), member.key) == kKeys.end())
      return Refusal{json::shown(member.key, 40), "is no key of a zone"};
  }
  const auto* name = text_of(root, "name");
  const auto* kind = text_of(root, "kind");
  const auto* source = text_of(root, "source");
  if (name == nullptr || source == nullptr) return Refusal{"", "lacks name or source"};
  if (kind == nullptr || (*kind != kKeepIn && *kind != kKeepOut))
    return Refusal{"kind", "has to be keep_in or keep_out"};
  if (!has_our_order(root)) return Refusal{"order", "has to be latitude_deg, longitude_deg"};
  zone.name = *name;
  zone.kind = *kind == kKeepIn ? Zone::Kind::keep_in : Zone::Kind::keep_out;
  zone.source = *source;
  return std::nullopt;
}

}  // namespace

std::string zone_text(const Zone& zone) {
  const bool keep_in = zone.kind == Zone::Kind::keep_in;
  return R"({"name":)" + quoted(zone.name) + R"(,"kind":)" + quoted(keep_in ? kKeepIn : kKeepOut) +
         R"(,"source":)" + quoted(zone.source) + R"(,"datum":)" + datum_text(zone.datum) +
         R"(,"order":)" + list_of(kOrder, quoted) + R"(,"polygons":)" +
         list_of(zone.polygons, polygon_text) + '}';
}

Result<Zone, Refusal> read_zone_text(std::string_view text) {
  const auto parsed = json::parse(text, {.max_bytes = std::size_t{2} << 20,
                                         .max_depth = 8,
                                         .max_values = 10 * kMaxPointsPerZone + 1000});
  if (!parsed.ok()) return Refusal{"", "is no JSON: " + parsed.error().text()};
  if (parsed->root.object() == nullptr) return Refusal{"", "is no zone"};
  Zone zone;
  if (auto refusal = read_words(parsed->root, zone)) return *std::move(refusal);
  if (auto refusal = read_datum(parsed->root.find("datum"), zone)) return *std::move(refusal);
  if (auto refusal = read_polygons(parsed->root.find("polygons"), zone)) return *std::move(refusal);
  if (auto refusal = check_zone(zone)) return *std::move(refusal);
  return zone;
}

KnownZones read_zone_texts(const std::vector<std::string>& texts) {
  KnownZones found;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    auto zone = read_zone_text(texts[i]);
    if (zone.ok()) {
      found.zones.push_back(std::move(zone.value()));
      continue;
    }
    const Refusal& refusal = zone.error();
    found.problems.push_back("stored zone " + std::to_string(i + 1) + ": " +
                             (refusal.path.empty() ? "" : refusal.path + " ") + refusal.why);
  }
  return found;
}

}  // namespace drover::scene
