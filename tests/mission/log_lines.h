// Lines of a mission's logs as values. Every parser throws std::runtime_error that says what is
// wrong.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/can_frame.h"
#include "drover/time.h"

namespace drover::mission {

struct CanLine {
  Time time = kNever;
  std::string bus;
  CanFrame frame;
};
struct MqttLine {
  Time time = kNever;
  std::string topic;
  bool retained = false;
  std::string payload;
};
struct EventLine {
  Time time = kNever;
  std::string text;
};
/// Electrical level of an output's wire from then on; nothing: its chip is away.
struct LevelLine {
  Time time = kNever;
  std::string name;
  std::optional<bool> high;
};
/// Of base_link in the simulator's frame: x east, y north, yaw counter-clockwise from east.
struct TruthLine {
  Time time = kNever;
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double yaw_rad = 0;
  double vx_mps = 0;
  double free_ahead_m = 0;
  double wz_radps = 0;
  // Of its joints outside the base, in the world's order.
  std::vector<double> arm_rad;
  std::vector<double> arm_Nm;  ///< that its motors give
};

/// "(12.345678901) can0 00D#00000000", as `candump -L` writes it but with nanoseconds.
CanLine parse_can_line(std::string_view line);
/// "(12.345678901) base_status 0 {...}"; a topic has no blanks.
MqttLine parse_mqtt_line(std::string_view line);
/// "(12.345678901) signal 9 to droverd"
EventLine parse_event_line(std::string_view line);

/// "(12.345000000) lamp 1", or "-" for the level.
LevelLine parse_level_line(std::string_view line);

/// Finds its columns by the names in the header.
class TruthColumns final {
 public:
  explicit TruthColumns(std::string_view header);
  TruthLine parse(std::string_view line) const;

 private:
  std::vector<std::size_t> columns_;
  std::vector<std::size_t> arm_;
  std::vector<std::size_t> arm_torques_;
  std::size_t count_ = 0;
};

}  // namespace drover::mission
