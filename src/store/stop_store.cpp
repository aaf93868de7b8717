// The latched stop on disk: it survives a boot of the computer.
#include "store/stop_store.h"

#include <cerrno>

#include "json/json_text.h"
#include "json/located_json.h"

namespace drover::store {
namespace {

constexpr std::string_view kStopFormat = "drover-stop";
constexpr int kStopVersion = 1;
const std::string kStopFile = "stop.json";

std::optional<Remembered> read(const json::Node& root) {
  const auto* stop = root.find("stop");
  const auto* at_robot = root.find("at_robot");
  const auto* power_cut = root.find("power_cut");
  if (stop == nullptr || stop->text() == nullptr || at_robot == nullptr ||
      at_robot->boolean() == nullptr || power_cut == nullptr || power_cut->boolean() == nullptr)
    return std::nullopt;
  Remembered found;
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
  std::string what = "has no stop, at_robot and power_cut";
  const int error = files_.read(path, 65536, content);
  if (error == ENOENT) return {};
  if (error != 0) {
    report.push_back(failure_text("read", path, error));
  } else {
    const auto body = unseal(kStopFormat, kStopVersion, content);
    if (body.ok()) {
      const auto parsed = json::parse(*body);
      const auto found = parsed.ok() ? read(parsed->root) : std::nullopt;
      if (found) return *found;
    } else {
      what = body.error().text;
    }
    report.push_back(path + " " + what);
  }
  return unreadable_stop();
}

std::optional<Failure> StopStore::save(const Remembered& remembered) {
  json::JsonText body;
  body.open('{').key("stop").text(remembered.stop.view());
  body.key("at_robot").boolean(remembered.stop_at_robot);
  body.key("power_cut").boolean(remembered.power_cut).close('}');
  return write_durably(files_, folder_, kStopFile, seal(kStopFormat, kStopVersion, body.str()));
}

}  // namespace drover::store
