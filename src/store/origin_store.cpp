// The origin of the map frame on disk: it survives a restart.
#include "store/origin_store.h"

#include <cerrno>
#include <cmath>

#include "store/kept_marks.h"

namespace drover::store {
namespace {

constexpr std::string_view kOriginFormat = "drover-origin";
constexpr int kOriginVersion = 1;
const std::string kOriginFile = "origin.json";
constexpr const char* kDamaged =
    "the stored origin was damaged: put the robot where it was and give init_rtk_data";
// One was put aside once, and none was written since, or it was and is not there any more.
constexpr const char* kGone =
    "the stored origin was damaged or deleted: put the robot where it was and give init_rtk_data";
constexpr const char* kDeleted =
    "the stored origin was deleted: put the robot where it was and give init_rtk_data";
constexpr const char* kUnreadable =
    "the stored origin cannot be read: mend the disk, or give init_rtk_data where it was";

}  // namespace

void write_origin(json::JsonText& out, const std::optional<GeodeticPoint>& origin) {
  if (!origin) {
    out.null();
    return;
  }
  out.open('{').key("latitude_deg").number(origin->latitude_deg);
  out.key("longitude_deg").number(origin->longitude_deg);
  out.key("altitude_m").number(origin->altitude_m).close('}');
}

std::optional<GeodeticPoint> read_origin(const json::Node& node) {
  const auto number = [&](std::string_view key) {
    const auto* member = node.find(key);
    return member == nullptr ? std::nullopt : member->number();
  };
  const auto latitude_deg = number("latitude_deg");
  const auto longitude_deg = number("longitude_deg");
  const auto altitude_m = number("altitude_m");
  if (!latitude_deg || !longitude_deg || !altitude_m) return std::nullopt;
  if (std::abs(*latitude_deg) > 90 || std::abs(*longitude_deg) > 360) return std::nullopt;
  return GeodeticPoint{*latitude_deg, *longitude_deg, *altitude_m};
}

OriginStore::OriginStore(Files& files, std::string folder)
    : files_(files), folder_(std::move(folder)) {}

std::optional<GeodeticPoint> OriginStore::load(std::vector<std::string>& report) {
  const std::string path = folder_ + "/" + kOriginFile;
  std::string content;
  problem_.clear();
  if (const int e = files_.read(path, 65536, content); e == ENOENT) {
    if (lies_aside(files_, folder_, kOriginFile)) {  // and nobody has given another since
      problem_ = kGone;
      report.push_back(gone_text(folder_, kOriginFile));
    } else if (was_kept(files_, folder_, kOriginFile)) {
      problem_ = kDeleted;
      report.push_back(deleted_text(folder_, kOriginFile));
    }
    return std::nullopt;
  } else if (e != 0) {
    problem_ = is_foreign(e)
                   ? "the stored origin cannot be read: " + foreign_text(folder_, kOriginFile)
                   : kUnreadable;
    report.push_back(failure_text("read", path, e));
    return std::nullopt;
  }
  std::string what = "has no latitude, longitude and altitude";
  const auto body = unseal(kOriginFormat, kOriginVersion, content);
  if (body.ok()) {
    const auto parsed = json::parse(*body);
    const auto origin = parsed.ok() ? read_origin(parsed->root) : std::nullopt;
    if (origin) {
      mark_kept(files_, folder_, kOriginFile);
      return origin;
    }
  } else {
    what = body.error().text;
  }
  problem_ = kDamaged;
  report.push_back(path + " " + what + "; " + put_aside(files_, folder_, kOriginFile));
  return std::nullopt;
}

std::optional<Failure> OriginStore::save(const GeodeticPoint& origin) {
  json::JsonText body;
  write_origin(body, origin);
  auto failure =
      write_durably(files_, folder_, kOriginFile, seal(kOriginFormat, kOriginVersion, body.str()));
  if (failure) return failure;
  mark_kept(files_, folder_, kOriginFile);
  problem_.clear();
  return std::nullopt;
}

}  // namespace drover::store
