// Zones from KML 2.2: `lon,lat[,alt]`, separated by white space.
#include "scene/zone/kml.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "json/located_json.h"
#include "scene/zone/zone_checks.h"

namespace drover::scene {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMaxDepth = 32;
/// The library compares each attribute with all before it: in one element that is quadratic.
constexpr std::ptrdiff_t kMaxEqualSigns = 10'000;
constexpr std::array<std::string_view, 7> kOtherGeometry = {
    "Point", "LineString", "LinearRing", "Model", "Track", "MultiTrack", "NetworkLink"};

/// Without its name space.
std::string_view local_name(const XMLElement& element) {
  const std::string_view name = element.Name();
  const auto colon = name.rfind(':');
  return colon == name.npos ? name : name.substr(colon + 1);
}

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::string_view next_word(std::string_view& text) {
  const auto* const begin = std::find_if_not(text.begin(), text.end(), is_space);
  const auto* const end = std::find_if(begin, text.end(), is_space);
  const std::string_view word(begin, static_cast<std::size_t>(end - begin));
  text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  return word;
}

/// A whole number text, of the part before the next comma.
std::optional<double> next_number(std::string_view& word) {
  const auto comma = word.find(',');
  const std::string_view part = word.substr(0, comma);
  word.remove_prefix(comma == word.npos ? word.size() : comma + 1);
  double value = 0;
  const auto done = std::from_chars(part.data(), part.data() + part.size(), value);
  const bool whole = done.ec == std::errc() && done.ptr == part.data() + part.size();
  // A zero has no sign: what is stored reads back to the bit.
  return whole && std::isfinite(value) ? std::optional(value + 0.0) : std::nullopt;
}

/// "lon,lat" or "lon,lat,alt".
std::optional<GeoPoint> read_point(std::string_view word) {
  const auto commas = std::count(word.begin(), word.end(), ',');
  if (commas < 1 || commas > 2) return std::nullopt;
  const auto longitude_deg = next_number(word);
  const auto latitude_deg = next_number(word);
  if (!longitude_deg || !latitude_deg) return std::nullopt;
  if (commas == 2 && !next_number(word)) return std::nullopt;
  return GeoPoint{*latitude_deg, *longitude_deg};
}

/// Walks the elements; the first error ends it.
class KmlReader {
 public:
  void read_root(const XMLElement& root) {
    if (local_name(root) != "kml") return fail(root, "is no KML: its outermost element is <kml>");
    read_children(root, 0);
    if (error_) return;
    if (const auto fault = find_fault(zone_.polygons)) fail_at(*fault);
  }
  std::optional<ImportError>& error() { return error_; }
  /// Only when nothing is wrong.
  ImportedZone take() {
    zone_.names_differ = !names_agree_;
    if (names_agree_) zone_.name = std::move(name_);
    return std::move(zone_);
  }

 private:
  void fail(const XMLElement& element, std::string what) {
    if (error_) return;
    error_ = ImportError{static_cast<std::size_t>(element.GetLineNum()), 0,
                         "<" + json::shown(local_name(element), 40) + ">", std::move(what)};
  }

  void fail_at(const ZoneFault& fault) {
    std::size_t line = 0;
    if (fault.polygon) line = lines_[*fault.polygon][fault.ring.value_or(0)];
    error_ = ImportError{line, 0, fault.path(), fault.why};
  }

  /// Every element is looked into: an area in one that we do not know is an area all the same.
  void read_children(const XMLElement& parent, std::size_t depth) {
    if (depth > kMaxDepth)
      return fail(parent, "nested deeper than " + std::to_string(kMaxDepth) + " levels");
    for (const auto* child = parent.FirstChildElement(); child != nullptr && !error_;
         child = child->NextSiblingElement()) {
      const std::string_view name = local_name(*child);
      if (name == "Polygon") {
        read_polygon(*child);
      } else if (name == "NetworkLink") {
        fail(*child, "is not followed: save the places themselves");
      } else if (std::find(kOtherGeometry.begin(), kOtherGeometry.end(), name) !=
                 kOtherGeometry.end()) {
        fail(*child, "is no area: a zone is made of polygons only, take the rest out");
      } else {
        if (name == "name" && local_name(parent) == "Placemark") note_name(*child);
        read_children(*child, depth + 1);
      }
    }
  }

  void note_name(const XMLElement& element) {
    const char* text = element.GetText();
    if (text == nullptr) return;
    if (name_.empty()) name_ = text;
    if (name_ != text) names_agree_ = false;
  }

  void read_polygon(const XMLElement& element) {
    GeoPolygon polygon;
    std::vector<std::size_t> lines(1);
    std::size_t outer_rings = 0;
    for (const auto* child = element.FirstChildElement(); child != nullptr && !error_;
         child = child->NextSiblingElement()) {
      const std::string_view name = local_name(*child);
      if (name != "outerBoundaryIs" && name != "innerBoundaryIs") continue;
      for (const auto* ring = child->FirstChildElement(); ring != nullptr && !error_;
           ring = ring->NextSiblingElement()) {
        if (local_name(*ring) != "LinearRing") return fail(*ring, "is no LinearRing");
        if (name == "outerBoundaryIs") {
          ++outer_rings;
          lines[0] = static_cast<std::size_t>(ring->GetLineNum());
          polygon.outer = read_ring(*ring);
        } else {
          lines.push_back(static_cast<std::size_t>(ring->GetLineNum()));
          polygon.holes.push_back(read_ring(*ring));
        }
      }
    }
    if (error_) return;
    if (outer_rings != 1) return fail(element, "needs one LinearRing in outerBoundaryIs");
    zone_.polygons.push_back(std::move(polygon));
    lines_.push_back(std::move(lines));
  }

  GeoRing read_ring(const XMLElement& element) {
    const XMLElement* coordinates = nullptr;
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      if (local_name(*child) != "coordinates") continue;
      if (coordinates != nullptr) fail(element, "has coordinates twice");
      coordinates = child;
    }
    if (coordinates == nullptr) fail(element, "has no coordinates");
    return error_ ? GeoRing{} : read_coordinates(*coordinates);
  }

  GeoRing read_coordinates(const XMLElement& element) {
    GeoRing ring;
    std::string text;
    for (const auto* node = element.FirstChild(); node != nullptr; node = node->NextSibling()) {
      if (node->ToText() != nullptr) {
        text += node->Value();
      } else if (node->ToComment() == nullptr) {
        fail(element, "has to be text");
      }
    }
    std::string_view rest = text;
    for (auto word = next_word(rest); !word.empty() && !error_; word = next_word(rest)) {
      const auto point = read_point(word);
      if (!point) {
        fail(element, "point " + std::to_string(ring.size()) + " is \"" + json::shown(word, 40) +
                          "\": a point is lon,lat or lon,lat,alt without white space in it");
      } else {
        ring.push_back(*point);
      }
    }
    if (error_) return ring;
    if (ring.size() < 4) {
      fail(element, "a ring has at least four points, of which the last is the first again");
    } else if (!(ring.front() == ring.back())) {
      fail(element, "is not closed: its last point has to be its first again");
    } else {
      ring.pop_back();
    }
    return ring;
  }

  ImportedZone zone_;
  std::vector<std::vector<std::size_t>> lines_;  ///< of the rings of zone_.polygons
  std::string name_;
  bool names_agree_ = true;
  std::optional<ImportError> error_;
};

/// What the library would read past, or too slowly.
std::optional<ImportError> check_file(std::string_view text) {
  const auto refuse = [](std::string what) { return ImportError{0, 0, "", std::move(what)}; };
  if (text.size() > kMaxImportBytes) {
    return refuse(std::to_string(text.size()) + " bytes are more than the limit of " +
                  std::to_string(kMaxImportBytes));
  }
  if (text.starts_with("PK\x03\x04"))
    return refuse("is a KMZ (a zip archive): unpack it, and import the .kml in it");
  if (text.find('\0') != text.npos) return refuse("has a NUL byte: save it as UTF-8");
  if (text.find("<!DOCTYPE") != text.npos || text.find("<!ENTITY") != text.npos)
    return refuse("declares a document type or entities: they are not read, take them out");
  if (std::count(text.begin(), text.end(), '=') > kMaxEqualSigns) {
    return refuse("has more than " + std::to_string(kMaxEqualSigns) +
                  " attributes: save the places alone");
  }
  return std::nullopt;
}

}  // namespace

Result<ImportedZone, ImportError> read_kml(std::string_view text) {
  if (auto refused = check_file(text)) return *std::move(refused);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    return ImportError{static_cast<std::size_t>(std::max(document.ErrorLineNum(), 0)), 0, "",
                       std::string("is no XML: ") + document.ErrorName()};
  }
  KmlReader reader;
  const XMLElement* root = document.RootElement();
  if (root == nullptr || root->NextSiblingElement() != nullptr)
    return ImportError{0, 0, "", "is no KML: it has one outermost element, <kml>"};
  reader.read_root(*root);
  if (reader.error()) return *reader.error();
  return reader.take();
}

}  // namespace drover::scene
