// Zones from GeoJSON (RFC 7946): longitude first.
#include "scene/zone/geojson.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "json/located_json.h"
#include "scene/zone/zone_checks.h"
#include "text/number.h"

namespace drover::scene {
namespace {

using json::Node;
using text::number_text;

constexpr std::array<std::string_view, 3> kDegrees = {"urn:ogc:def:crs:OGC:1.3:CRS84",
                                                      "urn:ogc:def:crs:EPSG::4326", "EPSG:4326"};

/// Walks the tree; the first error ends it.
class GeoJsonReader {
 public:
  void read_root(const Node& node) {
    check_crs(node);
    read_thing(node);
  }
  /// Only when nothing is wrong.
  ImportedZone take() {
    zone_.names_differ = !names_agree_;
    if (names_agree_) zone_.name = std::move(name_);
    if (without_place_ > 0)
      zone_.notes.push_back(std::to_string(without_place_) + " features without a geometry");
    return std::move(zone_);
  }
  std::optional<ImportError>& error() { return error_; }

  void check() {
    if (const auto fault = find_fault(zone_.polygons)) fail_at(*fault);
  }

 private:
  void fail(const Node& node, std::string path, std::string what) {
    if (!error_) error_ = ImportError{node.line, node.column, std::move(path), std::move(what)};
  }

  void fail_at(const ZoneFault& fault) {
    const std::size_t polygon = fault.polygon.value_or(0);
    const Node* node = nullptr;
    if (polygon < nodes_.size()) node = nodes_[polygon];
    if (node != nullptr && fault.ring) node = &(*node->list())[*fault.ring];
    if (node != nullptr && fault.point) node = &(*node->list())[*fault.point];
    error_ = ImportError{node == nullptr ? 0 : node->line, node == nullptr ? 0 : node->column,
                         fault.path(), fault.why};
  }

  /// RFC 7946 has done away with it; old files in metres or of another datum still have it.
  void check_crs(const Node& root) {
    const Node* crs = root.find("crs");
    if (crs == nullptr || crs->is_null()) return;
    const Node* properties = crs->find("properties");
    const Node* name = properties == nullptr ? nullptr : properties->find("name");
    const bool known = name != nullptr && name->text() != nullptr &&
                       std::find(kDegrees.begin(), kDegrees.end(), *name->text()) != kDegrees.end();
    if (!known) {
      fail(*crs, "crs",
           "is another system of coordinates: save the file with latitude and longitude of WGS 84");
    }
  }

  void read_thing(const Node& node) {
    const Node* type = node.find("type");
    if (type == nullptr || type->text() == nullptr)
      return fail(node, "", "has no \"type\": this is no GeoJSON");
    if (*type->text() == "FeatureCollection") return read_features(node);
    if (*type->text() == "Feature") return read_feature(node, "");
    read_geometry(node, *type->text(), "");
  }

  void read_features(const Node& node) {
    const Node* features = node.find("features");
    if (features == nullptr || features->list() == nullptr)
      return fail(node, "features", "has to be a list");
    for (std::size_t i = 0; i < features->list()->size() && !error_; ++i) {
      const Node& feature = (*features->list())[i];
      const std::string at = "features[" + std::to_string(i) + "]";
      const Node* type = feature.find("type");
      if (type == nullptr || type->text() == nullptr || *type->text() != "Feature")
        return fail(feature, at, "is no Feature");
      read_feature(feature, at);
    }
  }

  void read_feature(const Node& node, const std::string& path) {
    const std::string at = path.empty() ? "geometry" : path + ".geometry";
    const Node* geometry = node.find("geometry");
    if (geometry == nullptr) return fail(node, at, "is missing");
    if (geometry->is_null()) {
      ++without_place_;
      return;
    }
    note_name(node.find("properties"));
    const Node* type = geometry->find("type");
    if (type == nullptr || type->text() == nullptr) return fail(*geometry, at, "has no \"type\"");
    read_geometry(*geometry, *type->text(), at);
  }

  void note_name(const Node* properties) {
    const Node* name = properties == nullptr ? nullptr : properties->find("name");
    if (name == nullptr || name->text() == nullptr || name->text()->empty()) return;
    if (name_.empty()) name_ = *name->text();
    if (name_ != *name->text()) names_agree_ = false;
  }

  void read_geometry(const Node& node, const std::string& type, const std::string& path) {
    const std::string at = path.empty() ? "coordinates" : path + ".coordinates";
    if (type != "Polygon" && type != "MultiPolygon") {
      return fail(node, path,
                  "is a " + json::shown(type, 40) +
                      ": a zone is made of Polygon and MultiPolygon only, take the rest out");
    }
    const Node* coordinates = node.find("coordinates");
    if (coordinates == nullptr || coordinates->list() == nullptr)
      return fail(node, at, "has to be a list");
    if (type == "Polygon") return read_polygon(*coordinates, at);
    for (std::size_t i = 0; i < coordinates->list()->size() && !error_; ++i)
      read_polygon((*coordinates->list())[i], at + "[" + std::to_string(i) + "]");
  }

  void read_polygon(const Node& node, const std::string& path) {
    if (node.list() == nullptr || node.list()->empty())
      return fail(node, path, "a polygon is a list of rings, the outer one first");
    GeoPolygon polygon;
    for (std::size_t i = 0; i < node.list()->size() && !error_; ++i) {
      GeoRing ring = read_ring((*node.list())[i], path + "[" + std::to_string(i) + "]");
      if (i == 0) {
        polygon.outer = std::move(ring);
      } else {
        polygon.holes.push_back(std::move(ring));
      }
    }
    zone_.polygons.push_back(std::move(polygon));
    nodes_.push_back(&node);
  }

  GeoRing read_ring(const Node& node, const std::string& path) {
    GeoRing ring;
    if (node.list() == nullptr) {
      fail(node, path, "a ring is a list of positions");
      return ring;
    }
    for (std::size_t i = 0; i < node.list()->size() && !error_; ++i)
      read_position((*node.list())[i], path + "[" + std::to_string(i) + "]", ring);
    if (error_) return ring;
    if (ring.size() < 4) {
      fail(node, path, "a ring has at least four positions, of which the last is the first again");
    } else if (!(ring.front() == ring.back())) {
      fail(node, path, "is not closed: its last position has to be its first again");
    } else {
      ring.pop_back();
    }
    return ring;
  }

  void read_position(const Node& node, const std::string& path, GeoRing& ring) {
    const auto* numbers = node.list();
    if (numbers == nullptr || numbers->size() < 2 || numbers->size() > 3)
      return fail(node, path, "a position is [longitude, latitude] or with a height behind");
    for (const Node& number : *numbers) {
      if (!number.number()) return fail(number, path, "has to be numbers");
    }
    // A zero has no sign: what is stored reads back to the bit.
    const double longitude_deg = *(*numbers)[0].number() + 0.0;
    const double latitude_deg = *(*numbers)[1].number() + 0.0;
    if (std::abs(latitude_deg) > 90 && std::abs(latitude_deg) <= 180 &&
        std::abs(longitude_deg) <= 90) {
      return fail(node, path,
                  "latitude " + number_text(latitude_deg) +
                      " is not within -90 to 90 degrees: GeoJSON has the longitude first, these "
                      "two are most likely swapped");
    }
    ring.push_back({latitude_deg, longitude_deg});
  }

  ImportedZone zone_;
  std::vector<const Node*> nodes_;  ///< of zone_.polygons
  std::string name_;
  bool names_agree_ = true;
  std::size_t without_place_ = 0;
  std::optional<ImportError> error_;
};

}  // namespace

Result<ImportedZone, ImportError> read_geojson(std::string_view text) {
  const auto parsed =
      json::parse(text, {.max_bytes = kMaxImportBytes, .max_depth = 16, .max_values = 200'000});
  if (!parsed.ok()) {
    const json::JsonError& e = parsed.error();
    return ImportError{e.line, e.column, e.path, e.message};
  }
  GeoJsonReader reader;
  reader.read_root(parsed->root);
  if (!reader.error()) reader.check();
  if (reader.error()) return *reader.error();
  return reader.take();
}

}  // namespace drover::scene
