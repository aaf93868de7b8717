// The zones on disk, as texts of whoever draws them. What cannot be read is a fence nobody knows.
#include "store/zone_store.h"

#include <algorithm>
#include <utility>

#include "store/kept_marks.h"

namespace drover::store {
namespace {

const std::string kZoneKind = "zone";
const std::string kZones(kZonesFile.file);
constexpr const char* kUnknown = "the stored zones are not known: ";
constexpr const char* kForget = "; forget them and import them again";

}  // namespace

ZoneStore::ZoneStore(Files& files, std::string folder)
    : files_(files), folder_(std::move(folder)) {}

void ZoneStore::load() {
  auto found = load_named_texts(files_, folder_, kZonesFile);
  remove_leftovers(files_, folder_, kZonesFile);
  problem_.clear();
  is_foreign_ = found.is_foreign;
  is_deleted_ = false;
  zones_ = std::move(found.texts);
  if (!found.problem.empty()) {
    problem_ = kUnknown + found.problem;
    if (!found.is_foreign) problem_ += found.is_damaged ? kForget : "; mend the disk";
  } else if (found.is_there) {
    mark_kept(files_, folder_, kZones);
  } else if (was_kept(files_, folder_, kZones)) {
    problem_ = kUnknown + deleted_text(folder_, kZones) + kForget;
    is_deleted_ = true;
  }
}

std::optional<Failure> ZoneStore::save(const std::string& name, std::string text, double wall_s) {
  auto zones = zones_;
  const auto known = std::find_if(zones.begin(), zones.end(),
                                  [&](const NamedText& zone) { return zone.name == name; });
  if (known != zones.end()) zones.erase(known);
  zones.push_back({kZoneKind, name, wall_s, std::move(text)});
  return replace(std::move(zones));
}

std::optional<Failure> ZoneStore::remove(const std::string& name) {
  if (!problem_.empty()) return Failure{problem_};
  auto zones = zones_;
  if (std::erase_if(zones, [&](const NamedText& zone) { return zone.name == name; }) == 0)
    return Failure{"there is no zone of this name"};
  return replace(std::move(zones));
}

std::optional<Failure> ZoneStore::replace(std::vector<NamedText> zones) {
  if (!problem_.empty()) return Failure{problem_};
  if (auto failure = save_named_texts(files_, folder_, kZonesFile, zones)) return failure;
  mark_kept(files_, folder_, kZones);
  zones_ = std::move(zones);
  return std::nullopt;
}

std::optional<Failure> ZoneStore::forget_unreadable() {
  if (problem_.empty()) return Failure{"the stored zones can be read: delete them one by one"};
  if (is_foreign_) return Failure{problem_};  // nothing is lost yet
  if (!is_deleted_) {
    const auto aside = quarantine(files_, folder_, kZones);
    if (!aside.ok()) return aside.error();
  }
  if (auto failure = save_named_texts(files_, folder_, kZonesFile, {})) return failure;
  problem_.clear();
  zones_.clear();
  return std::nullopt;
}

}  // namespace drover::store
