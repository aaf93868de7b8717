// How a track lies on disk: its file name and its content.
#include "store/track_file.h"

#include <array>
#include <cinttypes>
#include <cstdio>

#include "json/json_text.h"
#include "json/located_json.h"
#include "store/origin_store.h"
#include "store/point_texts.h"

namespace drover::store {
namespace {

constexpr std::string_view kTrackFormat = "drover-track";
constexpr int kTrackVersion = 1;
constexpr std::size_t kMaxEscaped = 100;

bool stays(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

/// A point is a list, in the order of TrackPoint's fields: the file stays small.
bool read_point(const json::Node& node, std::string_view body, Track& track) {
  const auto* items = node.list();
  if (items == nullptr || items->size() != kNumbersPerPoint) return false;
  PointText text;
  std::array<double, kNumbersPerPoint> values{};
  for (std::size_t i = 0; i < kNumbersPerPoint; ++i) {
    const auto number = (*items)[i].number();
    if (!number) return false;
    values[i] = *number;
    text[i] = (*items)[i].spelling(body);
  }
  track.points.push_back(
      {values[0], values[1], values[2], values[3], values[4], values[5], values[6]});
  append_point(track.numbers, text);
  return true;
}

}  // namespace

std::string track_file_name(std::string_view name, int attempt) {
  std::string file = "t-";
  bool whole = true;
  for (const char c : name) {
    if (file.size() + 3 > kMaxEscaped) {
      whole = false;
      break;
    }
    if (stays(c)) {
      file += c;
    } else {
      char escaped[4] = {};
      std::snprintf(escaped, sizeof escaped, "%%%02x", static_cast<unsigned char>(c));
      file += escaped;
    }
  }
  if (!whole) {
    char digits[18] = {};
    std::snprintf(digits, sizeof digits, "~%016" PRIx64, fingerprint(name));
    file += digits;
  }
  if (attempt > 0) file += "~" + std::to_string(attempt);
  return file + std::string(kTrackEnding);
}

std::string encode_track(const Track& track) {
  json::JsonText body;
  body.open('{').key("name").text(track.name).key("origin");
  write_origin(body, track.origin);
  body.key("points").open('[');
  PointTexts texts(track);
  for (PointText point; texts.next(point);) {
    body.newline().open('[');
    for (const auto number : point) body.spelled_number(number);
    body.close(']');
  }
  body.close(']').close('}');
  return seal(kTrackFormat, kTrackVersion, body.str());
}

Result<Track, Failure> decode_track(std::string_view content) {
  const auto body = unseal(kTrackFormat, kTrackVersion, content);
  if (!body.ok()) return body.error();
  const auto parsed = json::parse(*body, {.max_bytes = kMaxTrackFileBytes,
                                          .max_depth = 8,
                                          .max_values = kMaxPointsPerTrack * 8 + 100,
                                          .long_integers = true});
  if (!parsed.ok()) return Failure{"is no JSON: " + parsed.error().text()};
  const json::Node& root = parsed->root;
  const auto* name = root.find("name");
  const auto* origin = root.find("origin");
  const auto* points = root.find("points");
  if (name == nullptr || name->text() == nullptr || origin == nullptr || points == nullptr ||
      points->list() == nullptr) {
    return Failure{"lacks name, origin or points"};
  }
  Track track;
  track.name = *name->text();
  if (!origin->is_null()) {
    track.origin = read_origin(*origin);
    if (!track.origin) return Failure{"has an origin that is none"};
  }
  track.points.reserve(points->list()->size());
  for (const json::Node& point : *points->list()) {
    if (!read_point(point, *body, track)) {
      return Failure{"has no seven numbers in point " + std::to_string(track.points.size() + 1)};
    }
  }
  return track;
}

}  // namespace drover::store
