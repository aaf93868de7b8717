// A file of a person's to a zone that may be stored: the one way in, whatever the format.
#include "scene/zone/import_zone.h"

#include <utility>

#include "scene/zone/geojson.h"
#include "scene/zone/kml.h"
#include "scene/zone/zone_checks.h"

namespace drover::scene {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool begins_like_kml(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  // "PK" begins a KMZ, which the reader of KML refuses by its name.
  return first != text.npos && (text[first] == '<' || text.starts_with("PK"));
}

}  // namespace

Result<NewZone, ImportError> import_zone(std::string_view text, const ZoneOrder& order) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  auto read = begins_like_kml(text) ? read_kml(text) : read_geojson(text);
  if (!read.ok()) return read.error();
  ImportedZone& file = read.value();
  const std::string& name = order.name.empty() ? file.name : order.name;
  if (name.empty()) {
    return ImportError{0, 0, "name",
                       file.names_differ ? "the areas of the file have different names: give one"
                                         : "the file does not name its areas: give one"};
  }
  NewZone made{{name, order.kind, std::move(file.polygons), order.datum, order.source},
               std::move(file.notes)};
  if (const auto refusal = check_zone(made.zone))
    return ImportError{0, 0, refusal->path, refusal->why};
  return made;
}

}  // namespace drover::scene
