// Any bytes as a message of mqtt_control: no crash, an answer always, nothing invented.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "json/json_text.h"
#include "json/located_json.h"
#include "publish/command_service.h"
#include "publish/rtk_navigation/control.h"
#include "publish/rtk_navigation/trajectory_data.h"

namespace {

using namespace drover;
using namespace drover::publish;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Whatever is said about a message must itself be JSON.
void check_texts(const Actions& actions) {
  for (const Action& action : actions) {
    const auto* message = std::get_if<PublishText>(&action);
    require(message == nullptr || json::parse(message->text).ok());
  }
}

void check_track(const store::Track& track) {
  for (const store::TrackPoint& point : track.points) {
    require(std::isfinite(point.longitude_deg) && std::isfinite(point.latitude_deg) &&
            std::isfinite(point.angle_deg) && std::isfinite(point.x_m) &&
            std::isfinite(point.y_m) && std::isfinite(point.yaw_rad) && std::isfinite(point.z_m));
  }
  for (const char c : track.name) require(static_cast<unsigned char>(c) >= 0x20);
  const auto again = json::parse(trajectory_data_text({&track, 1}));
  require(again.ok() && *(*again->root.list())[0].find("name")->text() == track.name);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view payload(reinterpret_cast<const char*>(data), size);
  const auto result = parse_control(payload, Retain::no);
  if (!result.ok()) {
    require(!result.error().reason.empty() && result.error().feedback_cmd.ends_with("_failse"));
  } else {
    require(!parse_control(payload, Retain::stored).ok());
    if (const auto* save = std::get_if<SaveTrajectory>(&*result)) check_track(save->track);
    if (const auto* start = std::get_if<StartTaskRequest>(&*result)) {
      require(std::isfinite(start->speed_mps));
    }
  }
  // Exactly one thing becomes of a message, an answer, a job or a command, and nothing of an empty
  // one.
  const GeodeticPoint origin{23, 113, 0};
  CommandService service({}, {{{"13", {{113, 23, 0, 0, 0, 0, 0}}, origin}}, origin, {}});
  Actions actions;
  service.on_control(payload, {}, Time{from_s(1)}, actions);
  check_texts(actions);
  int outcomes = 0;
  for (const Action& action : actions) outcomes += std::holds_alternative<LogLine>(action) ? 0 : 1;
  require(outcomes == (payload.empty() ? 0 : 1));
  for (const Action& action : actions) {
    require(result.ok() || !std::holds_alternative<Command>(action));
  }
  return 0;
}
