// The latched stop on disk: it survives a boot of the computer.
#include "store/stop_store.h"

#include <cerrno>

#include "json/json_text.h"
#include "json/located_json.h"
#include "store/kept_marks.h"

namespace drover::store {
namespace {

constexpr std::string_view kStopFormat = "drover-stop";
constexpr int kStopVersion = 3;
constexpr int kJointsWaitSince = 2;  // before: nothing that joint commands wait for was kept
constexpr int kRanAwaySince = 3;     // before: not that a wheel ran away
const std::string kStopFile = "stop.json";
const std::string kRoomFile = "stop.room";  // given up for a stop when the disk is full
constexpr std::size_t kRoom = 16384;        // bytes: a stop and its folder's entry, in any blocks

std::optional<Remembered> read(const json::Node& root, int version) {
  const auto* stop = root.find("stop");
  const auto* at_robot = root.find("at_robot");
  const auto* power_cut = root.find("power_cut");
  if (stop == nullptr || stop->text() == nullptr || at_robot == nullptr ||
      at_robot->boolean() == nullptr || power_cut == nullptr || power_cut->boolean() == nullptr)
    return std::nullopt;
  Remembered found;
  if (version >= kJointsWaitSince) {
    const auto* joints_wait = root.find("joints_wait");
    if (joints_wait == nullptr || joints_wait->text() == nullptr) return std::nullopt;
    found.joints_wait.assign(*joints_wait->text());
  }
  if (version >= kRanAwaySince) {
    const auto* ran_away = root.find("ran_away");
    if (ran_away == nullptr || ran_away->boolean() == nullptr) return std::nullopt;
    found.ran_away = *ran_away->boolean();
  }
  found.stop.assign(*stop->text());
  found.stop_at_robot = *at_robot->boolean();
  found.power_cut = *power_cut->boolean();
  return found;
}

}  // namespace

Remembered lasting(const Remembered& all) {
  Remembered kept;
  kept.stop = all.stop;
  kept.stop_at_robot = all.stop_at_robot;
  kept.power_cut = all.power_cut;
  kept.joints_wait = all.joints_wait;
  kept.ran_away = all.ran_away;
  return kept;
}

Remembered unreadable_stop() {
  Remembered unknown;
  unknown.stop.assign(kUnreadableStop);
  unknown.stop_at_robot = true;
  return unknown;
}

StopStore::StopStore(Files& files, std::string folder)
    : files_(files), folder_(std::move(folder)) {}

Remembered StopStore::load(std::vector<std::string>& report) const {
  const std::string path = folder_ + "/" + kStopFile;
  std::string content;
  std::string what = "does not tell all of a stop";
  const int error = files_.read(path, 65536, content);
  if (error == ENOENT) {
    if (!was_kept(files_, folder_, kStopFile)) return {};
    report.push_back(deleted_text(folder_, kStopFile));
    return unreadable_stop();
  }
  if (error != 0) {
    report.push_back(failure_text("read", path, error));
  } else {
    int version = 1;
    auto body = unseal(kStopFormat, version, content);
    while (!body.ok() && version < kStopVersion) body = unseal(kStopFormat, ++version, content);
    if (body.ok()) {
      const auto parsed = json::parse(*body);
      const auto found = parsed.ok() ? read(parsed->root, version) : std::nullopt;
      if (found) {
        mark_kept(files_, folder_, kStopFile);
        return *found;
      }
    } else {
      what = body.error().text;
    }
    report.push_back(path + " " + what);
  }
  return unreadable_stop();
}

void StopStore::keep_room() {
  if (!has_room_) has_room_ = !write_durably(files_, folder_, kRoomFile, std::string(kRoom, ' '));
}

std::optional<Failure> StopStore::save(const Remembered& remembered) {
  auto failure = write(remembered);
  if (failure && files_.remove(folder_ + "/" + kRoomFile) == 0) {
    has_room_ = false;
    failure = write(remembered);
  }
  if (failure) return failure;
  keep_room();
  mark_kept(files_, folder_, kStopFile);
  return std::nullopt;
}

std::optional<Failure> StopStore::write(const Remembered& remembered) {
  json::JsonText body;
  body.open('{').key("stop").text(remembered.stop.view());
  body.key("at_robot").boolean(remembered.stop_at_robot);
  body.key("power_cut").boolean(remembered.power_cut);
  body.key("joints_wait").text(remembered.joints_wait.view());
  body.key("ran_away").boolean(remembered.ran_away).close('}');
  return write_durably(files_, folder_, kStopFile, seal(kStopFormat, kStopVersion, body.str()));
}

}  // namespace drover::store
